// A leaf of a machine: everything that one of its processes can reach, as an explicit graph.
//
// Rows are kept as the step rules give them, with repeated edges, because FDR's counts of
// transitions include repetitions (CSPM reference 6.3.2).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "perentie/base/limits.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/lts/runs.hpp"
#include "perentie/semantics/machine.hpp"
#include "perentie/semantics/step.hpp"

namespace perentie::semantics {

/// The initial state is 0.
struct LeafGraph {
  lts::Runs<lts::Edge> rows;   ///< by state
  std::vector<ProcId> states;  ///< their terms; of a compressed leaf one of several
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;  ///< of all terms: their states

  std::uint64_t edge_count() const;
  std::uint32_t state_count() const { return static_cast<std::uint32_t>(states.size()); }
  std::span<const lts::Edge> edges(std::uint32_t state) const { return rows[state]; }
  /// The labels on edges, τ and ✓ among them, ascending.
  std::vector<lts::Label> labels() const;
};

/// Why a leaf could not be made.
enum class LeafFailure : std::uint8_t {
  too_many_states,
  other,  ///< a budget, or its steps cannot be computed: the step rules may never come so far
};

struct LeafResult {
  std::optional<LeafGraph> graph;
  LeafFailure failure = LeafFailure::other;
};

/// The quotient by a bisimulation; the leaf itself if that is not smaller, or costs too much.
LeafGraph compress_leaf(LeafGraph leaf, LeafCompression compression, const base::Limits& limits);

LeafResult explore_leaf(StepRules& rules, ProcId initial, std::uint64_t max_states,
                        const base::Budget& budget);

}  // namespace perentie::semantics

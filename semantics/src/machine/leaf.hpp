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
  /// By state: whether τ, but to itself, only choose an acceptance, as in a generalised LTS. Empty:
  /// of none.
  std::vector<bool> generalised;

  bool is_generalised() const { return !generalised.empty(); }
  /// Whether an edge of a state only chooses an acceptance.
  bool is_choice(std::uint32_t state, const lts::Edge& edge) const {
    return is_generalised() && generalised[state] && edge.label == lts::tau &&
           edge.target.value != state;
  }
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

/// Finds the states that are those of generalised LTSs, which compressions are known to make.
void find_generalised(LeafGraph& leaf, const ProcStore& processes, CompressionRules compressions);
/// Whether such a graph stands for a term.
bool is_generalised(ProcId term, const ProcStore& processes, CompressionRules compressions);

}  // namespace perentie::semantics

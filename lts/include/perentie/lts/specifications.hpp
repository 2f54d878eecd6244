// What an implementation is checked against: specifications as deterministic automata whose nodes
// say which acceptances and divergences are allowed.
//
// A `Specification` has nodes, numbered from 0, the initial one. `next` follows an event or ✓;
// if it gives none, the event is an error. `accepts` is asked of stable states with the labels
// that they offer, ascending; `allows_divergence` of states that diverge.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "perentie/lts/normalise.hpp"

namespace perentie::lts {

/// Refinement of a normal form: each acceptance must include a minimal one (CSPM reference 5.2.2).
/// The normal form must outlive it, and has acceptances unless only traces are compared.
class NormalSpecification {
 public:
  explicit NormalSpecification(const NormalLts& normal) : normal_(&normal) {
    const std::uint64_t cells =
        std::uint64_t{normal.lts.state_count()} * normal.lts.label_names().size();
    if (cells > max_cells) return;
    label_count_ = normal.lts.label_names().size();
    table_.resize(cells);
    for (std::uint32_t node = 0; node < normal.lts.state_count(); ++node) {
      for (const Edge& edge : normal.lts.edges(State{node})) {
        table_[node * label_count_ + edge.label.value] = edge.target;
      }
    }
  }

  State next(State node, Label label) const {
    if (label.value < label_count_) return table_[node.value * label_count_ + label.value];
    const auto edges = normal_->lts.edges(node, label);
    return edges.empty() ? State{} : edges.front().target;
  }
  bool accepts(State node, std::span<const Label> offered) const {
    return std::ranges::any_of(normal_->acceptances->of(node), [&](AcceptanceId id) {
      return std::ranges::includes(offered, normal_->acceptances->labels(id));
    });
  }
  bool allows_divergence(State node) const { return normal_->divergent[node.value]; }

 private:
  static constexpr std::uint64_t max_cells = 1U << 22U;

  const NormalLts* normal_;
  // Successors by node and label, where these are not too many. Labels that came later are looked
  // up, and not found.
  std::size_t label_count_ = 0;
  std::vector<State> table_;
};

/// Determinism as a refinement: what is possible after a trace must not be refused after it, and
/// nothing may diverge (5.3.6). The normal form is that of the implementation itself, or of its
/// deterministic extraction, where what is not possible after a trace must not be possible in the
/// implementation. Where the normal form diverges, so does the implementation: it is searched on.
class DeterministicSpecification {
 public:
  explicit DeterministicSpecification(const NormalLts& normal) : normal_(&normal), edges_(normal) {}

  State next(State node, Label label) const {
    const State found = edges_.next(node, label);
    return found || !normal_->divergent[node.value] ? found : node;
  }
  bool accepts(State node, std::span<const Label> offered) const {
    return std::ranges::all_of(normal_->lts.edges(node), [&](const Edge& edge) {
      return std::ranges::binary_search(offered, edge.label);
    });
  }
  static bool allows_divergence(State) { return false; }

 private:
  const NormalLts* normal_;
  NormalSpecification edges_;
};

/// Deadlock freedom: every stable state offers something; termination is a deadlock (5.3.1, 5.3.2).
struct DeadlockFreedom {
  static State next(State node, Label) { return node; }
  static bool accepts(State, std::span<const Label> offered) { return !offered.empty(); }
  static bool allows_divergence(State) { return false; }
};

/// Divergence freedom: everything else is allowed (5.3.3).
struct DivergenceFreedom {
  static State next(State node, Label) { return node; }
  static bool accepts(State, std::span<const Label>) { return true; }
  static bool allows_divergence(State) { return false; }
};

}  // namespace perentie::lts

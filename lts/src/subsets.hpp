// The τ-closed subset construction, node by node.
//
// A node is the set of states that an Lts may be in after some trace: closed under τ, sorted, and
// numbered in order of discovery, node 0 being the set after the empty trace. The normal form and
// the determinism check walk the nodes in that order, which is breadth first with labels ascending:
// the first trace to a node is the shortest, and the least of the shortest.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "perentie/base/limits.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/lts/runs.hpp"
#include "perentie/lts/watch.hpp"
#include "tau_closure.hpp"

namespace perentie::lts {

class Subsets {
 public:
  /// Keeps a reference: the Lts must outlive the construction. `max_states` limits the nodes, but
  /// node 0 is always there.
  Subsets(const Lts& lts, const base::Limits& limits);

  std::size_t size() const { return nodes_.size(); }
  /// The states of a node, ascending. Not valid after the next `successors`.
  std::span<const State> members(State node) const { return nodes_[node]; }

  /// The edges other than τ out of the members of a node, sorted and without duplicates. Valid
  /// until the next call.
  std::span<const Edge> visible_edges(State node);
  /// Appends the edges of a node, one a label, given its visible edges; finds new nodes on the way.
  /// On a limit the edges appended are not all. `other_bytes` is what the caller holds besides, for
  /// the memory limit.
  std::optional<base::LimitReached> successors(std::span<const Edge> visible_edges,
                                               std::uint64_t other_bytes, std::vector<Edge>& out);

  Runs<State> take_members() && { return std::move(nodes_).take(); }

 private:
  void close();

  const Lts& lts_;
  Watch watch_;
  std::uint64_t max_nodes_;
  UniqueRuns<State, State> nodes_;
  std::vector<Edge> gathered_;
  std::vector<State> set_;  // the set in hand
  TauClosure closure_;
};

}  // namespace perentie::lts

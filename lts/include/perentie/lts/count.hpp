// count: the size of a transition system, without its edges.
//
// Input: a `TransitionSystem` and a budget. Output: how many states and transitions breadth-first
// search finds. It is the search of `explore`, with the same counts, but only the states are kept,
// so far larger systems can be counted than explored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "perentie/lts/explore.hpp"

namespace perentie::lts {

struct Count {
  std::uint64_t states = 0;       ///< found
  std::uint64_t expanded = 0;     ///< states whose transitions are counted
  std::uint64_t transitions = 0;  ///< as the system gave them, duplicates included
  std::uint64_t plies = 0;        ///< levels of the search that were finished
  std::uint64_t bytes = 0;        ///< held at the end
  double seconds = 0;
  std::optional<base::LimitReached> limit = {};  ///< the budget that ran out, if one did
  bool failed = false;  ///< some successors could not be computed; the system has reported why

  bool complete() const { return expanded == states; }
};

/// Takes rows and forgets them.
class RowCounter {
 public:
  void add_row(std::span<const Edge>) { ++rows_; }
  std::size_t row_count() const { return rows_; }
  std::uint64_t peak_bytes(std::size_t) const { return 0; }

 private:
  std::size_t rows_ = 0;
};

/// Counts everything that can be reached from `system.initial()`.
template <TransitionSystem System>
Count count(System& system, const ExploreOptions& options = {}) {
  Explorer<System, RowCounter> explorer(system, options);
  explorer.run();
  const ExploreProgress end = explorer.progress();
  return {.states = end.states,
          .expanded = end.states - end.frontier,
          .transitions = end.transitions,
          .plies = end.ply,
          .bytes = end.bytes,
          .seconds = end.seconds,
          .limit = explorer.limit(),
          .failed = explorer.failed()};
}

}  // namespace perentie::lts

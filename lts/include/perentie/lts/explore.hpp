// explore: any transition system to an explicit Lts, breadth first.
//
// Input: a `TransitionSystem` and a budget. Output: the graph of its reachable states, numbered in
// the order in which breadth-first search finds them (successors in the system's order), so the
// numbering depends on nothing else. States live once, in an array that is also the queue; the
// visited set holds only their indices. When a budget runs out, what is known so far is the result.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "perentie/base/limits.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/lts/successor_block.hpp"
#include "perentie/lts/transition_system.hpp"
#include "perentie/lts/visited_states.hpp"
#include "perentie/lts/watch.hpp"

namespace perentie::lts {

struct ExploreProgress {
  std::uint64_t states = 0;       ///< found so far
  std::uint64_t transitions = 0;  ///< computed so far, duplicates included
  std::uint64_t ply = 0;          ///< distance of the states in work from the initial state
  std::uint64_t frontier = 0;     ///< states found whose transitions are still to be computed
  std::uint64_t bytes = 0;        ///< held by the exploration
  double seconds = 0;             ///< since it began
};

struct ExploreOptions {
  /// `max_states` counts the states found (the initial one is always kept). `max_memory_bytes`
  /// counts the states (not heap memory that they own), the visited set, the edges, and what the
  /// system says that it holds itself. `workers` are used where the system is a
  /// `SharedTransitionSystem`.
  base::Limits limits = {};
  /// Called about every 100 ms while exploration lasts.
  std::function<void(const ExploreProgress&)> progress = {};
};

template <class S>
struct Exploration {
  Lts lts;                ///< its states are indices into `states`
  std::vector<S> states;  ///< in breadth-first order; the initial state first
  /// The first `expanded` states have all their edges, the others none.
  std::size_t expanded = 0;
  /// Transitions of the expanded states as the system gave them, duplicates included: FDR's count
  /// of transitions is one more (CSPM reference 6.3.2).
  std::uint64_t transitions_fired = 0;
  std::optional<base::LimitReached> limit;  ///< the budget that ran out, if one did
  /// Some successors could not be computed; the system has reported why. A limit may have come
  /// first.
  bool failed = false;

  bool complete() const { return expanded == states.size(); }
};

/// The search itself. `Rows` takes the rows of one state after the other, as `LtsRowBuilder` does.
template <TransitionSystem System, class Rows>
class Explorer {
 public:
  using S = typename System::State;

  Explorer(System& system, const ExploreOptions& options)
      : system_(system),
        options_(options),
        watch_(options.limits),
        max_states_(std::clamp<std::uint64_t>(options.limits.max_states.value_or(State::none_value),
                                              1, State::none_value)),
        visited_(system),
        block_(system, visited_, options.limits.workers) {}

  void run() {
    visited_.add(system_.initial());
    while (rows_.row_count() < visited_.size() && expand_block()) {
    }
  }

  Exploration<S> exploration() && {
    const std::size_t expanded = rows_.row_count();
    const std::size_t found = state_count();
    Lts lts = std::move(rows_).finish(State{0}, found, system_.label_names());
    return {std::move(lts), std::move(visited_).take(found), expanded, fired_, limit_, failed_};
  }

  /// What there is to say so far.
  ExploreProgress progress() const {
    return {state_count(), fired_,
            ply_,          state_count() - rows_.row_count(),
            peak_bytes(0), watch_.budget().elapsed_seconds()};
  }
  std::optional<base::LimitReached> limit() const { return limit_; }
  bool failed() const { return failed_; }

 private:
  std::uint64_t state_count() const {
    return std::min<std::uint64_t>(visited_.size(), max_states_);
  }

  bool goes_on() {
    if (!watch_.due()) return true;
    limit_ = watch_.look();
    if (!limit_ && options_.progress && watch_.report_due()) options_.progress(progress());
    return !limit_;
  }

  /// Computes the rows of the next few states, up to the first that a limit or a failure excludes.
  /// False if exploration ends with them.
  bool expand_block() {
    const std::size_t first = rows_.row_count();
    block_.compute(
        block_.size(visited_.size() - first),
        [&](std::size_t i) { return State{static_cast<std::uint32_t>(first + i)}; },
        [&] { return goes_on(); });
    if (const auto reached = watch_.budget().check_memory(peak_bytes(block_.transition_count()))) {
      limit_ = reached;
      return false;
    }
    if (!block_.number_targets()) {
      limit_ = base::LimitReached{base::LimitKind::states, max_states_};
      return false;
    }
    block_.for_each_row([&](const auto& row) { return add_row(row); });
    failed_ = !limit_ && block_.failed();
    return !limit_ && !failed_;
  }

  /// Adds the row of the next state. False if there are too many states.
  bool add_row(const typename SuccessorBlock<System>::Row& row) {
    for (const Edge& edge : row.edges) {
      if (edge.target.value >= max_states_) {
        limit_ = base::LimitReached{base::LimitKind::states, max_states_};
        return false;
      }
      found_ = std::max(found_, edge.target.value + 1);
    }
    rows_.add_row(row.edges);
    fired_ += row.edges.size();
    if (rows_.row_count() == ply_end_) {
      ply_end_ = found_;
      ++ply_;
    }
    return true;
  }

  std::uint64_t peak_bytes(std::size_t more) const {
    std::uint64_t bytes = visited_.peak_bytes(more) + rows_.peak_bytes(more);
    if constexpr (requires { system_.memory_bytes(); }) bytes += system_.memory_bytes();
    return bytes;
  }

  System& system_;
  const ExploreOptions& options_;
  Watch watch_;
  std::uint64_t max_states_;
  VisitedStates<System> visited_;
  Rows rows_;
  SuccessorBlock<System> block_;  // of the states in work
  std::uint64_t fired_ = 0;
  std::uint32_t found_ = 1;  // states, up to the last row
  std::uint64_t ply_ = 0;    // of the next state without a row
  std::size_t ply_end_ = 1;  // the first state of the ply after it
  std::optional<base::LimitReached> limit_;
  bool failed_ = false;
};

/// Explores everything that can be reached from `system.initial()`.
template <TransitionSystem System>
Exploration<typename System::State> explore(System& system, const ExploreOptions& options = {}) {
  Explorer<System, LtsRowBuilder> explorer(system, options);
  explorer.run();
  return std::move(explorer).exploration();
}

}  // namespace perentie::lts

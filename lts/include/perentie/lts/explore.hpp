// explore: any transition system to an explicit Lts, breadth first.
//
// Input: a `TransitionSystem` and a budget. Output: the graph of its reachable states, numbered in
// the order in which breadth-first search finds them (successors in the system's order), so the
// numbering depends on nothing else. States live once, in an array that is also the queue; the
// visited set holds only their indices. When a budget runs out, what is known so far is the result.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "perentie/base/limits.hpp"
#include "perentie/base/unique_index.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/lts/memory.hpp"
#include "perentie/lts/transition_system.hpp"
#include "perentie/lts/watch.hpp"

namespace perentie::lts {

struct ExploreProgress {
  std::uint64_t states = 0;       ///< found so far
  std::uint64_t transitions = 0;  ///< computed so far, duplicates included
  std::uint64_t ply = 0;          ///< distance from the initial state of the states in work
  std::uint64_t frontier = 0;     ///< states found whose transitions are still to be computed
  std::uint64_t bytes = 0;        ///< held by the exploration
  double seconds = 0;             ///< since it began
};

struct ExploreOptions {
  /// `max_states` counts the states found (the initial one is always kept). `max_memory_bytes`
  /// counts the states (not heap memory that they own), the visited set, the edges, and what the
  /// system says that it holds itself.
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
  bool failed = false;  ///< some successors could not be computed; the system has reported why

  bool complete() const { return expanded == states.size(); }
};

/// The states that an exploration has found, each once, numbered in order of discovery.
template <TransitionSystem System>
class VisitedStates {
 public:
  using S = typename System::State;

  VisitedStates(System& system, std::uint64_t max_states)
      : system_(system), max_states_(std::min<std::uint64_t>(max_states, State::none_value)) {}

  /// The number of a state, known or new; nothing if it is new and one too many, and then no
  /// further state may be added.
  std::optional<State> add(S&& state) {
    const std::uint64_t hash = system_.state_hash(state);
    const auto [number, inserted] = index_.find_or_insert(
        hash, static_cast<std::uint32_t>(states_.size()),
        [&](std::uint32_t other) { return states_[other] == state; },
        [&](std::uint32_t other) -> std::uint64_t { return system_.state_hash(states_[other]); });
    if (inserted) {
      if (states_.size() >= max_states_) return std::nullopt;
      states_.push_back(std::move(state));
    }
    return State{number};
  }

  const S& operator[](std::size_t number) const { return states_[number]; }
  std::size_t size() const { return states_.size(); }
  std::uint64_t max_states() const { return max_states_; }
  std::uint64_t peak_bytes(std::size_t more) const {
    return lts::peak_bytes(states_, more) + lts::peak_bytes(index_, more);
  }
  std::vector<S> take() && { return std::move(states_); }

 private:
  System& system_;
  std::uint64_t max_states_;
  std::vector<S> states_;
  base::UniqueIndex index_;
};

template <TransitionSystem System>
class Explorer {
 public:
  using S = typename System::State;

  Explorer(System& system, const ExploreOptions& options)
      : system_(system),
        options_(options),
        watch_(options.limits),
        visited_(system, std::max<std::uint64_t>(
                             options.limits.max_states.value_or(State::none_value), 1)) {}

  Exploration<S> run() && {
    visited_.add(system_.initial());
    while (expanded_ < visited_.size() && expand_next()) ++expanded_;
    Lts lts = std::move(rows_).finish(State{0}, visited_.size(), system_.label_names());
    return {std::move(lts), std::move(visited_).take(), expanded_, fired_, limit_, failed_};
  }

 private:
  /// Computes the row of the first state without one. False if exploration must end before it.
  bool expand_next() {
    if (expanded_ == ply_end_) {
      ply_end_ = visited_.size();
      ++ply_;
    }
    if (watch_.due()) {
      limit_ = watch_.look();
      if (limit_) return false;
      report();
    }
    successors_.clear();
    failed_ = !system_.successors(visited_[expanded_], successors_);
    if (failed_) return false;
    limit_ = watch_.budget().check_memory(peak_bytes(successors_.size()));
    if (limit_) return false;
    for (Transition<S>& transition : successors_) {
      const std::optional<State> target = visited_.add(std::move(transition.target));
      if (!target) {
        limit_ = base::LimitReached{base::LimitKind::states, visited_.max_states()};
        return false;
      }
      rows_.add_edge(transition.label, *target);
    }
    rows_.end_row();
    fired_ += successors_.size();
    return true;
  }

  void report() {
    constexpr double seconds_between_reports = 0.1;
    const double now = watch_.budget().elapsed_seconds();
    if (!options_.progress || now - last_report_ < seconds_between_reports) return;
    last_report_ = now;
    options_.progress(
        {visited_.size(), fired_, ply_, visited_.size() - expanded_, peak_bytes(0), now});
  }

  std::uint64_t peak_bytes(std::size_t more) const {
    std::uint64_t bytes = visited_.peak_bytes(more) + rows_.peak_bytes(more);
    if constexpr (requires { system_.memory_bytes(); }) bytes += system_.memory_bytes();
    return bytes;
  }

  System& system_;
  const ExploreOptions& options_;
  Watch watch_;
  VisitedStates<System> visited_;
  LtsRowBuilder rows_;
  std::vector<Transition<S>> successors_;  // of the state in work
  std::size_t expanded_ = 0;
  std::uint64_t fired_ = 0;
  std::size_t ply_end_ = 1;
  std::uint64_t ply_ = 0;
  double last_report_ = 0;
  std::optional<base::LimitReached> limit_;
  bool failed_ = false;
};

/// Explores everything that can be reached from `system.initial()`.
template <TransitionSystem System>
Exploration<typename System::State> explore(System& system, const ExploreOptions& options = {}) {
  return Explorer<System>(system, options).run();
}

}  // namespace perentie::lts

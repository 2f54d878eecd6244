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
#include <iterator>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "perentie/base/growing_array.hpp"
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
  std::uint64_t ply = 0;          ///< distance of the states in work from the initial state
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
  /// Some successors could not be computed; the system has reported why. A limit may have come
  /// first.
  bool failed = false;

  bool complete() const { return expanded == states.size(); }
};

/// The states that an exploration has found, each once, numbered in order of discovery.
template <TransitionSystem System>
class VisitedStates {
 public:
  using S = typename System::State;

  VisitedStates(System& system, std::uint64_t max_states)
      : system_(system), max_states_(std::min<std::uint64_t>(max_states, State::none_value)) {}

  /// The number of a state with this hash, known or new; nothing if it is new and one too many, and
  /// then no further state may be added.
  std::optional<State> add(S&& state, std::uint64_t hash) {
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

  std::optional<State> add(S&& state) {
    const std::uint64_t hash = system_.state_hash(state);
    return add(std::move(state), hash);
  }
  /// Computes the hashes of the targets of transitions, and makes `add` cheaper for them: their
  /// look-ups wait for memory at the same time, first the table, then the states. `expect(number)`
  /// is told of the states that `add` will probably find.
  template <class Expect>
  void prefetch(std::span<const Transition<S>> transitions, std::vector<std::uint64_t>& hashes,
                Expect expect) const {
    hashes.clear();
    for (const Transition<S>& transition : transitions) {
      hashes.push_back(system_.state_hash(transition.target));
      index_.prefetch(hashes.back());
    }
    for (const std::uint64_t hash : hashes) {
      const std::optional<std::uint32_t> number = index_.candidate(hash);
      if (!number) continue;
      __builtin_prefetch(&states_[*number]);
      expect(*number);
    }
  }

  const S& operator[](std::size_t number) const { return states_[number]; }
  std::size_t size() const { return states_.size(); }
  std::uint64_t max_states() const { return max_states_; }
  std::uint64_t peak_bytes(std::size_t more) const {
    return lts::peak_bytes(states_, more) + lts::peak_bytes(index_, more);
  }
  std::vector<S> take() && {
    return {std::make_move_iterator(states_.begin()), std::make_move_iterator(states_.end())};
  }

 private:
  System& system_;
  std::uint64_t max_states_;
  std::conditional_t<std::is_trivially_copyable_v<S>, base::GrowingArray<S>, std::vector<S>>
      states_;
  base::UniqueIndex index_;
};

/// The search itself. `Rows` takes the edges of one state after the other, as `LtsRowBuilder` does.
template <TransitionSystem System, class Rows>
class Explorer {
 public:
  using S = typename System::State;

  Explorer(System& system, const ExploreOptions& options)
      : system_(system),
        options_(options),
        watch_(options.limits),
        visited_(system, std::max<std::uint64_t>(
                             options.limits.max_states.value_or(State::none_value), 1)) {}

  void run() {
    visited_.add(system_.initial());
    while (rows_.row_count() < visited_.size() && expand_block()) {
    }
  }

  Exploration<S> exploration() && {
    const std::size_t expanded = rows_.row_count();
    Lts lts = std::move(rows_).finish(State{0}, visited_.size(), system_.label_names());
    return {std::move(lts), std::move(visited_).take(), expanded, fired_, limit_, failed_};
  }

  /// What there is to say so far.
  ExploreProgress progress() const {
    return {visited_.size(),
            fired_,
            ply_,
            visited_.size() - rows_.row_count(),
            peak_bytes(0),
            watch_.budget().elapsed_seconds()};
  }
  std::optional<base::LimitReached> limit() const { return limit_; }
  bool failed() const { return failed_; }

 private:
  /// So many states are expanded together that the look-ups of their successors can wait for memory
  /// at the same time. The result does not depend on it.
  static constexpr std::size_t block_size = 16;

  /// Computes the rows of the next few states. False if exploration ends with them.
  bool expand_block() {
    compute_successors();
    if (const auto reached = watch_.budget().check_memory(peak_bytes(successors_.size()))) {
      limit_ = reached;
      return false;
    }
    visited_.prefetch(successors_, hashes_, [](std::uint32_t) {});
    std::size_t begin = 0;
    for (const std::size_t end : row_ends_) {
      if (!add_row(begin, end)) return false;
      begin = end;
    }
    return !limit_ && !failed_;
  }

  /// Computes the successors of the next few states, up to the first that a limit or a failure
  /// excludes.
  void compute_successors() {
    successors_.clear();
    row_ends_.clear();
    const std::size_t first = rows_.row_count();
    const std::size_t last = std::min(visited_.size(), first + block_size);
    for (std::size_t s = first; s < last; ++s) {
      if (watch_.due()) {
        limit_ = watch_.look();
        if (limit_) return;
        if (options_.progress && watch_.report_due()) options_.progress(progress());
      }
      failed_ = !system_.successors(visited_[s], successors_);
      if (failed_) return;
      row_ends_.push_back(successors_.size());
    }
  }

  /// Adds the row of the next state, whose successors are [begin, end). False if there are too many
  /// states.
  bool add_row(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto target = visited_.add(std::move(successors_[i].target), hashes_[i]);
      if (!target) {
        limit_ = base::LimitReached{base::LimitKind::states, visited_.max_states()};
        return false;
      }
      rows_.add_edge(successors_[i].label, *target);
    }
    rows_.end_row();
    fired_ += end - begin;
    if (rows_.row_count() == ply_end_) {
      ply_end_ = visited_.size();
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
  VisitedStates<System> visited_;
  Rows rows_;
  std::vector<Transition<S>> successors_;  // of the states in work
  std::vector<std::size_t> row_ends_;      // where the successors of each end
  std::vector<std::uint64_t> hashes_;      // of the successors
  std::uint64_t fired_ = 0;
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

// SuccessorBlock: the transitions of the next few states of a search, computed and numbered
// together.
//
// Look-ups of many targets can wait for memory at the same time, and several workers can share all
// steps. Every worker has the transitions of states that follow each other, its part. It claims for
// each target the number of visited states before the block plus the place of the transition in the
// block; so of several transitions to a new state the first in the order of the search has the
// least claim, and the new states are numbered in the order of these. Numbers depend neither on the
// workers nor on the size of blocks.
#pragma once

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "perentie/lts/lts.hpp"
#include "perentie/lts/transition_system.hpp"
#include "perentie/lts/visited_states.hpp"
#include "perentie/lts/workers.hpp"

namespace perentie::lts {

/// A system that several threads may ask for transitions at once: by the custom of the standard
/// library, one that computes them without changing itself.
template <class T>
concept SharedTransitionSystem = TransitionSystem<T> &&
    requires(const T& system, const typename T::State& state,
             std::vector<Transition<typename T::State>>& out) {
  { system.successors(state, out) } -> std::same_as<bool>;
};

template <TransitionSystem System>
class SuccessorBlock {
 public:
  using S = typename System::State;

  SuccessorBlock(System& system, VisitedStates<System>& visited, unsigned workers)
      : system_(system),
        visited_(visited),
        workers_(SharedTransitionSystem<System> ? workers : 1),
        parts_(workers_.count()) {}

  /// How many of `available` states the next block should have.
  std::size_t size(std::size_t available) const {
    if (workers_.count() == 1 || available < worthwhile * workers_.count()) {
      return std::min(available, batch);
    }
    const std::size_t states = std::clamp(part_transitions / average_, batch, part_transitions);
    return std::min(available, states * workers_.count());
  }

  /// Computes the rows of `count` states, or of the first of them if these have very many
  /// transitions; `state_of(i)` is the i-th, or none for an empty row.
  /// `goes_on()`, which is asked before each state on this thread, ends the block early if it says
  /// no.
  template <class StateOf, class GoesOn>
  void compute(std::size_t count, StateOf state_of, GoesOn goes_on) {
    stopped_ = false;
    part_count_ = count <= batch ? 1 : workers_.count();
    for_each_part([&](unsigned p) {
      compute_part(parts_[p], count * p / part_count_, count * (p + 1) / part_count_, state_of,
                   [&] {
                     if (p == 0 && !goes_on()) stopped_ = true;
                     return !stopped_.load(std::memory_order_relaxed);
                   });
    });
    // What follows a state whose row is not there is not part of the block.
    part_count_ =
        static_cast<unsigned>(std::find_if(parts_.begin(), parts_.begin() + part_count_ - 1,
                                           [](const Part& part) { return !part.is_whole; }) -
                              parts_.begin() + 1);
    transition_count_ = 0;
    std::size_t row_count = 0;
    for (unsigned p = 0; p < part_count_; ++p) {
      transition_count_ += parts_[p].transitions.size();
      row_count += parts_[p].row_ends.size();
    }
    average_ = std::max<std::size_t>(transition_count_ / std::max<std::size_t>(row_count, 1), 1);
  }

  std::size_t transition_count() const { return transition_count_; }
  /// Whether the system could not compute the row that would be the next.
  bool failed() const { return parts_[part_count_ - 1].failed; }

  /// Adds the targets that are new to the visited states. False, and nothing is done, if there may
  /// be more of both than numbers.
  bool number_targets() {
    const std::size_t known = visited_.size();
    if (known + transition_count_ >= State::none_value) return false;
    visited_.make_room(transition_count_, workers_);
    std::size_t claim_number = known;
    for (unsigned p = 0; p < part_count_; ++p) {
      parts_[p].first_claim = static_cast<std::uint32_t>(claim_number);
      claim_number += parts_[p].transitions.size();
    }
    for_each_part([&](unsigned p) { claim(parts_[p], known); });
    for_each_part([&](unsigned p) { find_first(parts_[p]); });
    std::size_t size = known;
    for (unsigned p = 0; p < part_count_; ++p) {
      parts_[p].first_number = static_cast<std::uint32_t>(size);
      size += parts_[p].first.size();
    }
    visited_.extend(size - known);
    for_each_part([&](unsigned p) { set_new_states(parts_[p]); });
    for_each_part([&](unsigned p) { set_targets(parts_[p]); });
    return true;
  }

  /// The transitions of a state.
  struct Row {
    std::size_t size;             ///< how many there are
    std::span<const Edge> edges;  ///< they, if targets were numbered
  };

  /// Calls `visit(row)` for each row that was computed, in the order of states, until it returns
  /// false.
  template <class Visit>
  void for_each_row(Visit visit) const {
    for (unsigned p = 0; p < part_count_; ++p) {
      const std::span<const Edge> edges = parts_[p].edges;
      std::size_t begin = 0;
      for (const std::size_t end : parts_[p].row_ends) {
        const std::size_t size = end - begin;
        if (!visit(Row{size, edges.empty() ? edges : edges.subspan(begin, size)})) return;
        begin = end;
      }
    }
  }

 private:
  // States whose look-ups wait together.
  static constexpr std::size_t batch = 16;
  // So many states for each worker are worth waking it.
  static constexpr std::size_t worthwhile = 64;
  // What a worker's part of a block aims at, and where it ends early.
  static constexpr std::size_t part_transitions = 16'384;
  static constexpr std::size_t most_transitions = 8 * part_transitions;

  struct Part {
    std::vector<Transition<S>> transitions;
    std::vector<std::size_t> row_ends;  // by state
    bool is_whole = true;               // no row is missing
    bool failed = false;                // because the system could not compute it

    std::vector<Edge> edges;             // the transitions, with the numbers of targets
    std::vector<std::uint64_t> places;   // of the targets; their hashes before
    std::vector<std::uint32_t> unknown;  // transitions to states that were not visited before
    std::vector<std::uint32_t> first;    // those that lead to such a state first
    std::uint32_t first_claim = 0;       // of the first transition
    std::uint32_t first_number = 0;      // of the state that the first of `first` leads to

    std::uint32_t claim_of(std::size_t i) const {
      return first_claim + static_cast<std::uint32_t>(i);
    }
  };

  /// Calls `step(p)` for each part of the block, side by side.
  template <class Step>
  void for_each_part(Step step) {
    if (part_count_ == 1) return step(0);
    workers_.run([&](unsigned worker) {
      if (worker < part_count_) step(worker);
    });
  }

  template <class StateOf, class GoesOn>
  void compute_part(Part& part, std::size_t first, std::size_t last, StateOf state_of,
                    GoesOn goes_on) {
    part.transitions.clear();
    part.edges.clear();
    part.row_ends.clear();
    part.is_whole = false;
    part.failed = false;
    for (std::size_t i = first; i < last; ++i) {
      if (!goes_on() || part.transitions.size() >= most_transitions) return;
      const State state = state_of(i);
      part.failed = state && !system_.successors(visited_[state.value], part.transitions);
      if (part.failed) {
        part.transitions.resize(part.row_ends.empty() ? 0 : part.row_ends.back());
        return;
      }
      part.row_ends.push_back(part.transitions.size());
    }
    part.is_whole = true;
  }

  /// Claims numbers for the targets of a part, a few of which are fetched at a time.
  void claim(Part& part, std::size_t known) {
    constexpr std::size_t at_once = 128;
    const std::size_t count = part.transitions.size();
    part.unknown.clear();
    part.places.resize(count);
    part.edges.resize(count);
    for (std::size_t begin = 0; begin < count; begin += at_once) {
      const std::size_t end = std::min(begin + at_once, count);
      for (std::size_t i = begin; i < end; ++i) {
        part.places[i] = system_.state_hash(part.transitions[i].target);
        visited_.prefetch(part.places[i]);
      }
      for (std::size_t i = begin; i < end; ++i) visited_.prefetch_candidate(part.places[i]);
      for (std::size_t i = begin; i < end; ++i) {
        part.places[i] =
            visited_.claim(part.transitions[i].target, part.places[i], part.claim_of(i),
                           [&](std::uint32_t claimed) { return &claimant(claimed).target; });
        const std::uint32_t number = visited_.number(part.places[i]);
        part.edges[i] = {part.transitions[i].label, State{number}};
        if (number >= known) part.unknown.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }

  /// Of the transitions of a part, those that are the first to new states.
  void find_first(Part& part) {
    part.first.clear();
    for (const std::uint32_t i : part.unknown) {
      if (visited_.number(part.places[i]) == part.claim_of(i)) part.first.push_back(i);
    }
  }

  void set_new_states(Part& part) {
    std::uint32_t number = part.first_number;
    for (const std::uint32_t i : part.first) {
      visited_.set(number++, part.places[i], std::move(part.transitions[i].target));
    }
  }

  void set_targets(Part& part) {
    for (const std::uint32_t i : part.unknown) {
      part.edges[i].target = State{visited_.number(part.places[i])};
    }
  }

  /// The transition whose claim a number is.
  const Transition<S>& claimant(std::uint32_t claim) const {
    unsigned p = part_count_ - 1;
    while (claim < parts_[p].first_claim) --p;
    return parts_[p].transitions[claim - parts_[p].first_claim];
  }

  System& system_;
  VisitedStates<System>& visited_;
  Workers workers_;
  std::vector<Part> parts_;
  unsigned part_count_ = 1;           // of the block
  std::size_t transition_count_ = 0;  // of the block
  std::size_t average_ = 1;           // transitions a state, lately
  std::atomic<bool> stopped_{false};
};

}  // namespace perentie::lts

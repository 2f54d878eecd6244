// VisitedStates: the states that a search has found, each once, numbered in order of discovery.
//
// The states live in an array that is also the queue of the search; an index finds their numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

#include "perentie/base/growing_array.hpp"
#include "perentie/lts/claim_index.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/lts/memory.hpp"
#include "perentie/lts/transition_system.hpp"
#include "perentie/lts/workers.hpp"

namespace perentie::lts {

template <TransitionSystem System>
class VisitedStates {
 public:
  using S = typename System::State;

  explicit VisitedStates(System& system) : system_(system) {}

  const S& operator[](std::size_t number) const { return states_[number]; }
  std::size_t size() const { return states_.size(); }
  /// The bytes in use, at the peak, while `more` states are added.
  std::uint64_t peak_bytes(std::size_t more) const {
    return lts::peak_bytes(states_, more) + index_.bytes_for(size() + more);
  }
  /// The first `count` states.
  std::vector<S> take(std::size_t count) && {
    return {std::make_move_iterator(states_.begin()),
            std::make_move_iterator(states_.begin() + count)};
  }

  /// Adds one state, if it is new.
  void add(S state) {
    Workers alone(1);
    make_room(1, alone);
    const auto number = static_cast<std::uint32_t>(size());
    const std::size_t place =
        claim(state, system_.state_hash(state), number, [&](std::uint32_t) { return &state; });
    if (this->number(place) != number) return;
    extend(1);
    set(number, place, std::move(state));
  }

  /// \name What several threads add together
  /// They claim the numbers from `size()` on for states that may be new, in any order; what is the
  /// least number at the place of a state then was claimed for it first. Steps follow each other:
  /// room, claims, more size, final states.
  /// @{

  /// Makes room for `more` states.
  void make_room(std::size_t more, Workers& workers) {
    index_.reserve(
        size() + more, size(), [this](std::size_t i) { return system_.state_hash(states_[i]); },
        workers);
  }
  /// Claims a number for a state; `claimed(number)` points to the state that another claim was for.
  /// Returns the place of the state.
  template <class Claimed>
  std::size_t claim(const S& state, std::uint64_t hash, std::uint32_t number, Claimed claimed) {
    return index_.claim(hash, number, [&](std::uint32_t other) {
      return other < states_.size() ? states_[other] == state : *claimed(other) == state;
    });
  }
  std::uint32_t number(std::size_t place) { return index_.number(place); }
  /// Begins to fetch what a claim for a state with this hash reads: first its place, and when that
  /// is there, the state that will probably be found.
  void prefetch(std::uint64_t hash) const { index_.prefetch(hash); }
  void prefetch_candidate(std::uint64_t hash) {
    const auto number = index_.candidate(hash);
    if (number && *number < states_.size()) __builtin_prefetch(&states_[*number]);
  }
  /// Appends `count` states that are to be set.
  void extend(std::size_t count) {
    if constexpr (is_plain) {
      states_.resize_for_overwrite(size() + count);
    } else {
      states_.resize(size() + count);
    }
  }
  void set(std::uint32_t number, std::size_t place, S&& state) {
    states_[number] = std::move(state);
    index_.set_number(place, number);
  }
  /// @}

 private:
  static constexpr bool is_plain = std::is_trivially_copyable_v<S>;

  System& system_;
  std::conditional_t<is_plain, base::GrowingArray<S>, std::vector<S>> states_;
  ClaimIndex index_;
};

}  // namespace perentie::lts

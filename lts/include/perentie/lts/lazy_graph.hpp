// LazyGraph: the states of a transition system with their transitions, computed when asked for.
//
// States are numbered in the order in which they are first seen. Rows are kept, as the system gave
// them, duplicates included.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "perentie/base/unique_index.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/lts/memory.hpp"
#include "perentie/lts/runs.hpp"
#include "perentie/lts/transition_system.hpp"

namespace perentie::lts {

template <TransitionSystem System>
class LazyGraph {
 public:
  explicit LazyGraph(System& system) : system_(system) { add(system.initial()); }

  State initial() const { return State{0}; }
  std::size_t size() const { return states_.size(); }
  const typename System::State& state(State number) const { return states_[number.value]; }

  /// The transitions of a state. Nothing if the system cannot compute them. Not valid after the
  /// next call.
  std::optional<std::span<const Edge>> row(State number) {
    if (number.value >= row_of_.size()) row_of_.resize(states_.size(), no_row);
    if (row_of_[number.value] == no_row && !compute(number)) return std::nullopt;
    return rows_[row_of_[number.value]];
  }

  std::uint64_t peak_bytes() const {
    std::uint64_t bytes = lts::peak_bytes(states_, 1) + lts::peak_bytes(index_, 1) +
                          rows_.peak_bytes(0) + lts::peak_bytes(row_of_, 0);
    if constexpr (requires { system_.memory_bytes(); }) bytes += system_.memory_bytes();
    return bytes;
  }

 private:
  static constexpr std::uint32_t no_row = State::none_value;

  State add(typename System::State&& state) {
    const auto [number, inserted] = index_.find_or_insert(
        system_.state_hash(state), static_cast<std::uint32_t>(states_.size()),
        [&](std::uint32_t other) { return states_[other] == state; },
        [&](std::uint32_t other) -> std::uint64_t { return system_.state_hash(states_[other]); });
    if (inserted) states_.push_back(std::move(state));
    return State{number};
  }

  bool compute(State number) {
    transitions_.clear();
    if (!system_.successors(states_[number.value], transitions_)) return false;
    edges_.clear();
    for (auto& transition : transitions_) {
      edges_.push_back({transition.label, add(std::move(transition.target))});
    }
    row_of_[number.value] = static_cast<std::uint32_t>(rows_.size());
    rows_.add(edges_);
    return true;
  }

  System& system_;
  std::vector<typename System::State> states_;
  base::UniqueIndex index_;
  Runs<Edge> rows_;
  std::vector<std::uint32_t> row_of_;  // by state
  std::vector<Transition<typename System::State>> transitions_;
  std::vector<Edge> edges_;
};

}  // namespace perentie::lts

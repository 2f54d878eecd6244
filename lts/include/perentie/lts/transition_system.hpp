// TransitionSystem: the one interface that exploration needs.
//
// Process terms, compiled machines, products and test graphs all satisfy it, so they share the same
// exploration code. Labels are those of `lts.hpp`; what a state is, is the system's own business.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <vector>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

template <class S>
struct Transition {
  Label label;
  S target;
};

/// `initial()` gives the state to start from; `successors(s, out)` appends the transitions of `s`
/// to the caller's buffer and returns false if they cannot be computed (the system has reported
/// why). `state_hash(s)` and `==` identify states. `label_names()` is asked for when exploration is
/// over, so a system may create labels while it computes successors. A system whose own tables grow
/// may also have `memory_bytes()`, which then counts towards the limit; one that knows that none of
/// its states leads to τ for ever may say so by `may_diverge()`.
template <class T>
concept TransitionSystem = requires(T& system, const typename T::State& state,
                                    std::vector<Transition<typename T::State>>& out) {
  typename T::State;
  requires std::equality_comparable<typename T::State>;
  { system.initial() } -> std::same_as<typename T::State>;
  { system.successors(state, out) } -> std::same_as<bool>;
  { system.state_hash(state) } -> std::convertible_to<std::uint64_t>;
  { system.label_names() } -> std::convertible_to<std::shared_ptr<const LabelNames>>;
};

/// A system with states of a generalised LTS (CSPM reference 4.7.1): what these may refuse is not
/// said by their transitions but by stable states, each of which offers one acceptance.
/// `for_each_stable(s, use)` calls `use(stable, offered)` with each of them and the labels that it
/// offers, ascending, until that returns false.
template <class T>
concept GeneralisedSystem = TransitionSystem<T> &&
    requires(const T& system, const typename T::State& state,
             bool (*use)(const typename T::State&, const std::vector<Label>&)) {
  { system.is_generalised(state) } -> std::same_as<bool>;
  system.for_each_stable(state, use);
};

}  // namespace perentie::lts

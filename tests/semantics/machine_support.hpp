// A compiled machine beside the step rules: the oracle for machines.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "perentie/lts/refine.hpp"
#include "perentie/semantics/machine.hpp"
#include "script_support.hpp"

namespace perentie::semantics {

/// A transition, by the terms that its states stand for.
struct Fired {
  ProcId from;
  lts::Label label;
  ProcId to;

  friend auto operator<=>(const Fired&, const Fired&) = default;
};

/// Everything that a process can reach.
struct Reached {
  std::vector<ProcId> states;      ///< the terms of all states, ascending
  std::vector<Fired> transitions;  ///< ascending, repetitions included
};

struct BothWays {
  std::optional<Reached> steps;    ///< nothing: too large, or there was an error
  std::optional<Reached> machine;  ///< nothing: there is no machine, or it is too large
};

/// A process explored by its machine, from `min_leaves` leaves on, and by the step rules.
BothWays explore_both_ways(TestScript& script, const std::string& process,
                           std::size_t min_leaves = 1, std::uint64_t max_states = 5'000);

/// Whether both have the same states, each once, and the same transitions, as often.
::testing::AssertionResult same_reached(const Reached& steps, const Reached& machine);

/// Whether a counterexample is a run of the step rules from the first state of a process and, if it
/// is about an acceptance, ends in a state that offers just that.
::testing::AssertionResult is_run(Script& script, ProcId process,
                                  const lts::Counterexample<ProcId>& run);

/// Whether the lazy machine of a process has the states, transitions, order and repetitions of the
/// step rules, as far as `max_states` of both go. A process without a value is no failure.
::testing::AssertionResult lazy_machine_is_exact(TestScript& script, const std::string& process,
                                                 std::uint64_t max_states = 5'000);

}  // namespace perentie::semantics

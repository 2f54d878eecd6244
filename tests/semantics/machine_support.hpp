// A compiled machine beside the step rules: the oracle for machines.
#pragma once

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "perentie/semantics/machine.hpp"
#include "script_support.hpp"

namespace perentie::semantics {

struct BothWays {
  std::optional<lts::Lts> steps;    ///< nothing: too large, or there was an error
  std::optional<lts::Lts> machine;  ///< nothing: there is no machine, or it is too large
};

/// A process explored by its machine, from `min_leaves` leaves on, and by the step rules.
BothWays explore_both_ways(TestScript& script, const std::string& process,
                           std::size_t min_leaves = 1, std::uint64_t max_states = 5'000);

/// Whether both have as many states and edges, with the same names, and every state of one is
/// strongly bisimilar to one of the other: the initial ones to each other.
::testing::AssertionResult same_graph(const lts::Lts& steps, const lts::Lts& machine);

}  // namespace perentie::semantics

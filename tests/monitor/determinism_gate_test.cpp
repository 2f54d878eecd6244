// Varanus's determinism gate, outcome by outcome.
#include "perentie/monitor/determinism_gate.hpp"

#include <gtest/gtest.h>

#include "perentie/test/lts_text.hpp"

namespace perentie::monitor {
namespace {

using Names = std::vector<std::string>;
using Outcome = DeterminismGate::Outcome;

// a.1 -> c -> STOP [] a.1 -> b -> STOP: nondeterministic as it is.
const char* const choice = "0 a.1 1; 0 a.1 2; 1 b 3; 2 c 3";
// a -> h -> b -> STOP [] h -> c -> STOP: hiding h makes it nondeterministic.
const char* const hiding = "0 a 1; 1 h 2; 2 b 3; 0 h 4; 4 c 3";

TEST(DeterminismGateTest, EqualAlphabetsNeedNoCheck) {
  const DeterminismGate gate =
      check_determinism_gate(test::lts_from(choice), Names{"a", "b", "c"}, Names{"c", "b", "a"});
  EXPECT_EQ(gate.outcome, Outcome::not_needed);
  EXPECT_TRUE(gate.passes());
}

TEST(DeterminismGateTest, ALargerSystemNeedsNoCheck) {
  const DeterminismGate gate =
      check_determinism_gate(test::lts_from(choice), Names{"a", "b"}, Names{"a", "b", "c"});
  EXPECT_EQ(gate.outcome, Outcome::not_needed);
  EXPECT_EQ(gate.extra, Names{"c"});
}

TEST(DeterminismGateTest, WhatTheSystemDoesNotShowIsHiddenAndChecked) {
  const DeterminismGate gate = check_determinism_gate(
      test::lts_from(hiding), Names{"a", "b", "c", "h"}, Names{"a", "b", "c"});
  EXPECT_EQ(gate.outcome, Outcome::nondeterministic);
  EXPECT_FALSE(gate.passes());
  EXPECT_EQ(gate.trace, Names{});
  EXPECT_EQ(gate.event, "a");
  EXPECT_EQ(explain(gate),
            "with {|h|} hidden the model is nondeterministic: after <> it may perform `a` and may "
            "refuse it");
}

TEST(DeterminismGateTest, HidingMayBeHarmless) {
  const DeterminismGate gate = check_determinism_gate(test::lts_from("0 a 1; 1 h.3 2; 2 b 0"),
                                                      Names{"a", "b", "h"}, Names{"a", "b"});
  EXPECT_EQ(gate.outcome, Outcome::deterministic);
  EXPECT_EQ(explain(gate), "the model is deterministic with {|h|} hidden");
}

TEST(DeterminismGateTest, EndlessHiddenEventsAreNondeterminism) {
  const DeterminismGate gate =
      check_determinism_gate(test::lts_from("0 a 1; 1 h 1"), Names{"a", "h"}, Names{"a"});
  EXPECT_EQ(gate.outcome, Outcome::nondeterministic);
  EXPECT_EQ(gate.trace, Names{"a"});
  EXPECT_EQ(gate.event, std::nullopt);
  EXPECT_EQ(
      explain(gate),
      "with {|h|} hidden the model is nondeterministic: after <a> it may perform hidden events "
      "for ever");
}

TEST(DeterminismGateTest, IncomparableAlphabetsHaveNoRule) {
  const DeterminismGate gate =
      check_determinism_gate(test::lts_from(choice), Names{"a", "b"}, Names{"b", "z"});
  EXPECT_EQ(gate.outcome, Outcome::incomparable);
  EXPECT_FALSE(gate.passes());
  EXPECT_EQ(
      explain(gate),
      "the alphabets cannot be compared: only the model has {|a|}, only the system has {|z|}");
}

TEST(DeterminismGateTest, ABudgetThatRunsOutIsNoVerdict) {
  base::Limits limits;
  limits.max_states = 1;
  const DeterminismGate gate =
      check_determinism_gate(test::lts_from("0 a 1; 1 b 2; 2 c 3; 3 h 0"),
                             Names{"a", "b", "c", "h"}, Names{"a", "b", "c"}, limits);
  EXPECT_EQ(gate.outcome, Outcome::inconclusive);
  EXPECT_FALSE(gate.passes());
  EXPECT_NE(explain(gate).find("the limit of 1 states"), std::string::npos) << explain(gate);
}

}  // namespace
}  // namespace perentie::monitor

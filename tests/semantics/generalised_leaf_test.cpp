// Compressed leaves as generalised LTSs: they do not multiply states, and say the same.
#include <gtest/gtest.h>

#include <string>

#include "machine_support.hpp"
#include "perentie/lts/specifications.hpp"
#include "perentie/semantics/check.hpp"
#include "perentie/semantics/process_graph.hpp"
#include "perentie/semantics/process_system.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

// P(i) stops after an event, or goes on with the next one first.
const char* const definitions = R"(
transparent diamond, normal, sbisim
channel c : {0..4}
channel a, b, e
P(i) = c.i -> (P(i) |~| c.(i + 1) -> P(i))
CHAIN(f) = || i : {0..3} @ [{c.i, c.(i + 1)}] f(P(i))
A = a -> A |~| a -> STOP
plain(X) = X
both(X) = sbisim(diamond(X))
)";

const char* const meets =
    "normal(a -> STOP |~| b -> STOP) [|{a, b}|] normal(a -> STOP |~| b -> STOP)";

CheckResult checked(TestScript& script, const std::string& claim) {
  base::Diagnostics diagnostics;
  const auto assertion = script.script().assertion("assert " + claim, diagnostics);
  EXPECT_TRUE(assertion) << base::render_all(diagnostics, script.sources());
  if (!assertion) return {.outcome = CheckResult::Outcome::error};
  return check(script.script(), *assertion, {}, diagnostics);
}

std::uint64_t states_of(const std::string& claim) {
  TestScript script(definitions);
  const CheckResult result = checked(script, claim);
  EXPECT_EQ(result.outcome, CheckResult::Outcome::holds) << claim;
  return result.counts.states;
}

// Each component has two states, as in FDR, where τ had given it a third (CSPM reference 4.7.1).
TEST(GeneralisedLeafTest, ChoicesOfAcceptancesAreNoStates) {
  for (const std::string model : {"[F]", "[FD]"}) {
    EXPECT_EQ(states_of("CHAIN(plain) :[deadlock free " + model + "]"), 81U);
    for (const std::string f : {"normal", "diamond", "both"}) {
      EXPECT_EQ(states_of("CHAIN(" + f + ") :[deadlock free " + model + "]"), 16U) << f << model;
    }
  }
  for (const std::string model : {"[T=", "[F=", "[FD="}) {
    EXPECT_EQ(states_of("CHAIN(plain) " + model + " CHAIN(normal)"), 16U) << model;
  }
}

TEST(GeneralisedLeafTest, OneLeafAloneIsAMachine) {
  EXPECT_EQ(states_of("A [FD= normal(A)"), 2U);
  EXPECT_EQ(states_of("A [FD= sbisim(diamond(A))"), 3U);
}

// The choices of both sides meet: each alone may go on, together they may be stuck.
TEST(GeneralisedLeafTest, StableStatesOfTheWholeAreThoseThatMeet) {
  TestScript script(definitions);
  const CheckResult stuck = checked(script, std::string(meets) + " :[deadlock free [F]]");
  ASSERT_EQ(stuck.outcome, CheckResult::Outcome::fails);
  EXPECT_EQ(stuck.counts.states, 1U);
  EXPECT_EQ(stuck.witness->offered, std::vector<std::string>{});
  const CheckResult refuses = checked(script,
                                      "(a -> STOP) ||| e -> STOP [F= "
                                      "normal(a -> STOP |~| e -> STOP) ||| e -> STOP");
  ASSERT_EQ(refuses.outcome, CheckResult::Outcome::fails);
}

// A choice that hiding makes unstable says nothing: only the b of the right side is certain.
TEST(GeneralisedLeafTest, HiddenOffersAreNotStable) {
  TestScript script(definitions);
  const std::string hidden = "(normal(a -> e -> STOP |~| e -> STOP) ||| normal(b -> STOP)) \\ {a}";
  EXPECT_EQ(checked(script, "(e -> STOP) ||| (b -> STOP) [F= " + hidden).outcome,
            CheckResult::Outcome::holds);
}

TEST(GeneralisedLeafTest, DivergenceStays) {
  TestScript script(definitions + std::string("LOOP = a -> LOOP\nD = LOOP \\ {a} |~| b -> STOP\n"));
  const std::string network = "normal(D) ||| normal(a -> STOP |~| e -> STOP)";
  EXPECT_EQ(checked(script, network + " :[divergence free]").outcome, CheckResult::Outcome::fails);
  EXPECT_EQ(checked(script, "(b -> STOP) ||| (a -> STOP |~| e -> STOP) [F= " + network).outcome,
            CheckResult::Outcome::holds);
}

// What a generalised state refuses is shown by a state of the step rules, behind τ.
TEST(GeneralisedLeafTest, CounterexamplesAreRunsOfTheStepRules) {
  for (const std::string process :
       {"normal(A) [|{a}|] normal(A)", "normal(A)", "(normal(A) ||| normal(b -> STOP |~| SKIP))",
        "diamond(A) [|{a}|] sbisim(normal(A |~| b -> A))"}) {
    SCOPED_TRACE(process);
    TestScript script(definitions);
    base::Diagnostics diagnostics;
    const auto term = script.script().process(process, diagnostics);
    const auto found = refine_process(script.script(), *term, lts::DeadlockFreedom{},
                                      lts::SemanticModel::failures, {}, diagnostics);
    ASSERT_TRUE(found.counterexample);
    EXPECT_TRUE(is_run(script.script(), *term, *found.counterexample));
    EXPECT_EQ(found.counterexample->kind, lts::Counterexample<ProcId>::Kind::acceptance);
    EXPECT_TRUE(found.counterexample->offered.empty());
  }
}

// Whoever asks for a graph gets one whose edges say everything.
TEST(GeneralisedLeafTest, GraphsArePlain) {
  TestScript script(definitions);
  base::Diagnostics diagnostics;
  const auto term = script.script().process(meets, diagnostics);
  const auto graph = explore_process(script.script(), *term, {}, diagnostics);
  EXPECT_TRUE(graph.structure.is_generalised);
  // Two states, and of the first a stable one: where both choose alike more is accepted than where
  // they do not.
  EXPECT_EQ(graph.lts.state_count(), 3U);
  EXPECT_EQ(graph.lts.edges(lts::State{0}, lts::tau).size(), 1U);
  EXPECT_EQ(count_process(script.script(), *term, {}, diagnostics).states, 2U);
}

// Stable states lead back to states that have not chosen yet: the choices do not multiply here
// either, nor in compressions of compressions.
TEST(GeneralisedLeafTest, GraphsDoNotMultiplyChoices) {
  TestScript script(definitions);
  base::Diagnostics diagnostics;
  const auto term = script.script().process("CHAIN(normal)", diagnostics);
  const auto graph = explore_process(script.script(), *term, {}, diagnostics);
  EXPECT_EQ(count_process(script.script(), *term, {}, diagnostics).states, 16U);
  EXPECT_EQ(graph.lts.state_count(), 32U);
  EXPECT_EQ(states_of("normal(CHAIN(normal)) :[deadlock free]"),
            states_of("normal(CHAIN(plain)) :[deadlock free]"));
}

TEST(GeneralisedLeafTest, StableStatesOfGraphsCountAsStates) {
  TestScript script(definitions);
  base::Diagnostics diagnostics;
  const auto term = script.script().process(meets, diagnostics);
  for (const std::uint64_t most : {1U, 2U}) {
    const auto cut =
        explore_process(script.script(), *term, {.limits = {.max_states = most}}, diagnostics);
    EXPECT_FALSE(cut.complete);
    ASSERT_TRUE(cut.limit);
    EXPECT_EQ(cut.limit->kind, base::LimitKind::states);
  }
  EXPECT_TRUE(
      explore_process(script.script(), *term, {.limits = {.max_states = 3}}, diagnostics).complete);
}

}  // namespace
}  // namespace perentie::semantics

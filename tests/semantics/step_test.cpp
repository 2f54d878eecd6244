// The step rules, operator by operator: whole LTSs of small processes (CSPM reference 4.1, 4.2).
#include "perentie/semantics/step.hpp"

#include <gtest/gtest.h>

#include "perentie/test/lts_text.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

// --- Constants (CSPM reference 3.10.7, 3.10.8)
// -----------------------------------------------------------------

TEST(StepTest, Constants) {
  EXPECT_TRUE(has_lts("STOP", "0"));
  EXPECT_TRUE(has_lts("SKIP", "0 tick 1"));
  EXPECT_TRUE(has_lts("DIV", "0 tau 0"));
  EXPECT_TRUE(has_lts("RUN({a, b})", "0 a 0; 0 b 0"));
  EXPECT_TRUE(has_lts("RUN({})", "0"));
  EXPECT_TRUE(has_lts("CHAOS({a, b})", "0 tau 1; 0 tau 2; 1; 2 a 0; 2 b 0"));
  EXPECT_TRUE(has_lts("CHAOS({})", "0 tau 1; 1"));
}

TEST(StepTest, RunAndChaosOverAChannel) {
  EXPECT_TRUE(has_lts("RUN({|n|})", "0 n.0 0; 0 n.1 0"));
  EXPECT_TRUE(has_lts("CHAOS({|n.1|})", "0 tau 1; 0 tau 2; 1; 2 n.1 0"));
}

// The states and transitions of CSPM reference 10.2, "Explicit sizes".
TEST(StepTest, ExplicitSizesOfTheReference) {
  const struct {
    const char* process;
    std::size_t states;
    std::size_t transitions;
  } rows[] = {
      {"STOP", 1, 0}, {"SKIP", 2, 1},          {"a -> STOP", 2, 1},   {"a -> SKIP", 3, 2},
      {"P", 2, 2},    {"P ||| P", 4, 8},       {"P [|{a}|] P", 4, 5}, {"SKIP ||| SKIP", 2, 1},
      {"DIV", 1, 1},  {"CHAOS({a, b})", 3, 4}, {"RUN({a, b})", 1, 2},
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(row.process);
    TestScript script("channel a, b\nP = a -> b -> P");
    const auto lts = script.explore(row.process);
    ASSERT_TRUE(lts) << script.messages();
    EXPECT_EQ(lts->state_count(), row.states);
    EXPECT_EQ(lts->edge_count(), row.transitions);
  }
}

// --- Guards and choices -------------------------------------------------------------------------

TEST(StepTest, Guard) {
  EXPECT_TRUE(has_lts("true & a -> STOP", "0 a 1; 1"));
  EXPECT_TRUE(has_lts("false & a -> STOP", "0"));
  EXPECT_TRUE(has_lts("false & DIV", "0"));
  EXPECT_TRUE(has_lts("(1 > 2 & a -> STOP) [] (1 < 2 & b -> STOP)", "0 b 1; 1"));
}

TEST(StepTest, ExternalChoiceIsResolvedByEventsAndTick) {
  EXPECT_TRUE(has_lts("a -> STOP [] b -> SKIP", "0 a 1; 1; 0 b 2; 2 tick 1"));
  EXPECT_TRUE(has_lts("a -> STOP [] SKIP", "0 a 1; 1; 0 tick 1"));
  EXPECT_TRUE(has_lts("a -> b -> STOP [] a -> c -> STOP", "0 a 1; 0 a 2; 1 b 3; 2 c 3; 3"));
  EXPECT_TRUE(has_lts("STOP [] a -> STOP", "0 a 1; 1"));
}

TEST(StepTest, ExternalChoiceIsNotResolvedByTau) {
  EXPECT_TRUE(has_lts("(a -> STOP |~| b -> STOP) [] c -> STOP",
                      "0 tau 1; 0 tau 2; 0 c 3; 1 a 3; 1 c 3; 2 b 3; 2 c 3; 3"));
  EXPECT_TRUE(has_lts("DIV [] a -> STOP", "0 tau 0; 0 a 1; 1"));
  // Both sides move on their own.
  EXPECT_TRUE(has_lts("(a -> STOP |~| STOP) [] (b -> STOP |~| STOP)",
                      "0 tau 1; 0 tau 2; 0 tau 3; 0 tau 4;"
                      "1 tau 5; 1 tau 6; 1 a 9; 2 tau 7; 2 tau 8;"
                      "3 tau 5; 3 tau 7; 3 b 9; 4 tau 6; 4 tau 8;"
                      "5 a 9; 5 b 9; 6 a 9; 7 b 9; 8; 9"));
}

TEST(StepTest, InternalChoiceIsOneTauForEachOperand) {
  EXPECT_TRUE(has_lts("a -> STOP |~| b -> STOP", "0 tau 1; 0 tau 2; 1 a 3; 2 b 3; 3"));
  EXPECT_TRUE(has_lts("STOP |~| STOP", "0 tau 1; 1"));
  // Nested, not flattened: the root has two, not three.
  EXPECT_TRUE(has_lts("a -> STOP |~| b -> STOP |~| c -> STOP",
                      "0 tau 1; 0 tau 2; 1 tau 3; 1 tau 4; 2 c 5; 3 a 5; 4 b 5; 5"));
}

TEST(StepTest, SlidingChoice) {
  EXPECT_TRUE(has_lts("a -> STOP [> b -> STOP", "0 a 2; 0 tau 1; 1 b 2; 2"));
  EXPECT_TRUE(has_lts("SKIP [> STOP", "0 tick 1; 0 tau 1; 1"));
  // A τ of the left stays; a τ of the right is not yet possible.
  EXPECT_TRUE(has_lts("(a -> STOP |~| b -> STOP) [> DIV",
                      "0 tau 1; 0 tau 2; 0 tau 3; 1 a 4; 1 tau 3; 2 b 4; 2 tau 3; 3 tau 3; 4"));
}

// --- Sequence, interrupt, exception -------------------------------------------------------------

TEST(StepTest, Sequence) {
  EXPECT_TRUE(has_lts("a -> STOP ; b -> STOP", "0 a 1; 1"));
  EXPECT_TRUE(has_lts("STOP ; a -> STOP", "0"));
  EXPECT_TRUE(has_lts("DIV ; a -> STOP", "0 tau 0"));
  EXPECT_TRUE(has_lts("(a -> STOP |~| SKIP) ; SKIP", "0 tau 1; 0 tau 2; 1 a 4; 2 tick 3; 3; 4"));
}

TEST(StepTest, SequenceElidesTheTauOfAStateThatCanOnlyTerminate) {
  EXPECT_TRUE(has_lts("(a -> SKIP) ; b -> STOP", "0 a 1; 1 b 2; 2"));
  EXPECT_TRUE(has_lts("a -> SKIP ; SKIP", "0 a 1; 1 tick 2; 2"));
  // CSPM reference 6.2.6: (gets [] sets) ; terminate -> SKIP has 4 states.
  EXPECT_TRUE(has_lts("(a -> SKIP [] b -> SKIP) ; c -> SKIP", "0 a 1; 0 b 1; 1 c 2; 2 tick 3; 3"));
  EXPECT_TRUE(has_lts("(a -> SKIP ; b -> SKIP) ; c -> SKIP", "0 a 1; 1 b 2; 2 c 3; 3 tick 4; 4"));
}

TEST(StepTest, SequenceKeepsTheTauWhereTheLeftOffersMore) {
  EXPECT_TRUE(has_lts("(a -> STOP [] SKIP) ; b -> STOP", "0 a 1; 1; 0 tau 2; 2 b 3; 3"));
}

TEST(StepTest, LoopThroughSequence) {
  EXPECT_TRUE(has_lts("P", "0 a 0", "P = a -> SKIP ; P"));
  EXPECT_TRUE(has_lts("P", "0 a 1; 1 b 0", "P = (a -> b -> SKIP) ; P"));
}

TEST(StepTest, Interrupt) {
  EXPECT_TRUE(has_lts("(a -> STOP) /\\ (b -> c -> STOP)", "0 a 1; 0 b 2; 1 b 2; 2 c 3; 3"));
  // ✓ of either side ends the whole.
  EXPECT_TRUE(has_lts("SKIP /\\ (b -> STOP)", "0 tick 1; 0 b 1; 1"));
  EXPECT_TRUE(has_lts("(a -> STOP) /\\ SKIP", "0 a 1; 0 tick 2; 1 tick 2; 2"));
  // τ of the right stays and does not interrupt.
  EXPECT_TRUE(has_lts("(a -> STOP) /\\ (b -> STOP |~| STOP)",
                      "0 a 1; 0 tau 2; 0 tau 3; 1 tau 4; 1 tau 6;"
                      "2 a 4; 2 b 5; 3 a 6; 4 b 5; 5; 6"));
}

TEST(StepTest, Exception) {
  EXPECT_TRUE(has_lts("(a -> b -> STOP) [|{a}|> (c -> STOP)", "0 a 1; 1 c 2; 2"));
  EXPECT_TRUE(has_lts("(a -> b -> SKIP) [|{b}|> (c -> STOP)", "0 a 1; 1 b 2; 2 c 3; 3"));
  EXPECT_TRUE(has_lts("SKIP [|{a}|> DIV", "0 tick 1; 1"));
  // The handler is off until then; τ of the left stays.
  EXPECT_TRUE(has_lts("STOP [|{a}|> DIV", "0"));
  EXPECT_TRUE(
      has_lts("(STOP |~| a -> STOP) [|{a}|> SKIP", "0 tau 1; 0 tau 2; 1; 2 a 3; 3 tick 4; 4"));
}

// --- Parallel -----------------------------------------------------------------------------------

TEST(StepTest, Interleaving) {
  EXPECT_TRUE(has_lts("a -> STOP ||| b -> STOP", "0 a 1; 0 b 2; 1 b 3; 2 a 3; 3"));
  EXPECT_TRUE(has_lts("a -> STOP ||| a -> STOP", "0 a 1; 0 a 2; 1 a 3; 2 a 3; 3"));
  EXPECT_TRUE(has_lts("DIV ||| a -> STOP", "0 tau 0; 0 a 1; 1 tau 1"));
}

TEST(StepTest, TickIsSynchronisedByAllOperands) {
  EXPECT_TRUE(has_lts("SKIP ||| SKIP", "0 tick 1; 1"));
  EXPECT_TRUE(has_lts("SKIP ||| STOP", "0"));
  EXPECT_TRUE(has_lts("(a -> SKIP) ||| SKIP", "0 a 1; 1 tick 2; 2"));
  EXPECT_TRUE(has_lts("SKIP [|{a}|] SKIP", "0 tick 1; 1"));
  EXPECT_TRUE(has_lts("SKIP [|{a}|] RUN({b})", "0 b 0"));
  EXPECT_TRUE(has_lts("SKIP [{a} || {b}] SKIP", "0 tick 1; 1"));
  EXPECT_TRUE(has_lts("SKIP [{a} || {}] STOP", "0"));
  EXPECT_TRUE(has_lts("SKIP [a <-> b] SKIP", "0 tick 1; 1"));
  // ✓ beside something else is a choice on each side.
  EXPECT_TRUE(has_lts("(a -> STOP [] SKIP) ||| SKIP", "0 a 1; 0 tick 2; 1; 2"));
}

TEST(StepTest, GeneralisedParallel) {
  EXPECT_TRUE(
      has_lts("a -> b -> STOP [|{a}|] a -> c -> STOP", "0 a 1; 1 b 2; 1 c 3; 2 c 4; 3 b 4; 4"));
  EXPECT_TRUE(has_lts("a -> STOP [|{a}|] STOP", "0"));
  EXPECT_TRUE(has_lts("a -> STOP [|{b}|] b -> STOP", "0 a 1; 1"));
  // Each way of the one with each way of the other.
  EXPECT_TRUE(has_lts("(a -> a -> STOP [] a -> b -> STOP) [|{a}|] (a -> a -> STOP [] a -> STOP)",
                      "0 a 1; 0 a 2; 0 a 3; 0 a 4; 1 a 5; 2; 3 b 6; 4 b 5; 5; 6"));
}

TEST(StepTest, AlphabetisedParallel) {
  EXPECT_TRUE(has_lts("a -> b -> STOP [{a, b} || {b, c}] c -> b -> STOP",
                      "0 a 1; 0 c 2; 1 c 3; 2 a 3; 3 b 4; 4"));
  // Outside its own alphabet an operand is blocked.
  EXPECT_TRUE(has_lts("a -> STOP [{b} || {b}] STOP", "0"));
  EXPECT_TRUE(has_lts("a -> STOP [{b} || {a}] RUN({a})", "0 a 0"));
  EXPECT_TRUE(has_lts("(STOP |~| a -> STOP) [{a} || {}] STOP", "0 tau 1; 0 tau 2; 1; 2 a 1"));
}

TEST(StepTest, LinkedParallel) {
  EXPECT_TRUE(
      has_lts("a -> c -> STOP [a <-> b] b -> e -> STOP", "0 tau 1; 1 c 2; 1 e 3; 2 e 4; 3 c 4; 4"));
  // Linked events never occur alone.
  EXPECT_TRUE(has_lts("a -> STOP [a <-> b] e -> STOP", "0 e 1; 1"));
  EXPECT_TRUE(has_lts("c -> STOP [a <-> b] b -> STOP", "0 c 1; 1"));
  // A name is linked on its own side only.
  EXPECT_TRUE(has_lts("b -> STOP [a <-> b] a -> STOP", "0 b 1; 0 a 2; 1 a 3; 2 b 3; 3"));
  EXPECT_TRUE(has_lts("n!1 -> STOP [n <-> n] n?x -> (if x == 1 then c -> STOP else e -> STOP)",
                      "0 tau 1; 1 c 2; 2"));
  EXPECT_TRUE(has_lts("n?x -> STOP [n.i <-> n.i | i <- {0..1}] n?x -> STOP", "0 tau 1; 1"));
}

TEST(StepTest, SynchronisingChoice) {
  // CSPM reference 10.2.
  EXPECT_TRUE(has_lts("(a -> b -> STOP) [+{a}+] (a -> c -> STOP)", "0 a 1; 1 b 2; 1 c 2; 2"));
  EXPECT_TRUE(has_lts("(a -> STOP) [+{a}+] STOP", "0"));
  EXPECT_TRUE(has_lts("(a -> STOP) [+{b}+] (c -> STOP)", "0 a 1; 0 c 1; 1"));
  EXPECT_TRUE(has_lts("SKIP [+{a}+] (b -> STOP)", "0 tick 1; 0 b 1; 1"));
  // τ does not resolve the choice (4.2.2).
  EXPECT_TRUE(has_lts("(b -> STOP |~| STOP) [+{a}+] (c -> STOP)",
                      "0 tau 1; 0 tau 2; 0 c 3; 1 b 3; 1 c 3; 2 c 3; 3"));
}

TEST(StepTest, SynchronisingInterrupt) {
  EXPECT_TRUE(
      has_lts("(a -> b -> STOP) /+{a}+\\ (a -> c -> STOP)", "0 a 1; 1 b 2; 1 c 3; 2 c 3; 3"));
  EXPECT_TRUE(has_lts("SKIP /+{a}+\\ (b -> STOP)", "0 tick 1; 0 b 1; 1"));
  EXPECT_TRUE(has_lts("(b -> STOP) /+{a}+\\ SKIP", "0 b 1; 0 tick 2; 1 tick 2; 2"));
  EXPECT_TRUE(has_lts("(a -> STOP) /+{a}+\\ (b -> STOP)", "0 b 1; 1"));
  EXPECT_TRUE(has_lts("(a -> STOP) /+{b}+\\ DIV", "0 a 1; 0 tau 0; 1 tau 1"));
}

// --- Hiding and renaming ------------------------------------------------------------------------

TEST(StepTest, Hiding) {
  EXPECT_TRUE(has_lts("(a -> b -> SKIP) \\ {a}", "0 tau 1; 1 b 2; 2 tick 3; 3"));
  EXPECT_TRUE(has_lts("P \\ {a}", "0 tau 0", "P = a -> P"));
  EXPECT_TRUE(has_lts("(a -> STOP) \\ {}", "0 a 1; 1"));
  EXPECT_TRUE(has_lts("(n?x -> STOP) \\ {|n|}", "0 tau 1; 1"));
}

TEST(StepTest, Projection) {
  EXPECT_TRUE(has_lts("(a -> b -> SKIP) |\\ {a}", "0 a 1; 1 tau 2; 2 tick 3; 3"));
  EXPECT_TRUE(has_lts("(a -> SKIP) |\\ {}", "0 tau 1; 1 tick 2; 2"));
}

TEST(StepTest, Renaming) {
  EXPECT_TRUE(has_lts("(a -> b -> SKIP)[[a <- c]]", "0 c 1; 1 b 2; 2 tick 3; 3"));
  EXPECT_TRUE(has_lts("(a -> STOP)[[a <- b, a <- c]]", "0 b 1; 0 c 1; 1"));
  EXPECT_TRUE(has_lts("(a -> STOP)[[a <- a, a <- c]]", "0 a 1; 0 c 1; 1"));
  EXPECT_TRUE(has_lts("(a -> STOP [] b -> STOP)[[a <- b, b <- a]]", "0 a 1; 0 b 1; 1"));
  EXPECT_TRUE(has_lts("(a -> c -> STOP [] b -> STOP)[[a <- b]]", "0 b 1; 0 b 2; 1 c 2; 2"));
  EXPECT_TRUE(
      has_lts("(n.0 -> n.1 -> STOP)[[n.i <- n.(1 - i) | i <- {0..1}]]", "0 n.1 1; 1 n.0 2; 2"));
  // Whole channels: n.x becomes d.0.x's counterpart field by field.
  EXPECT_TRUE(has_lts("(m?x -> STOP)[[m <- n]]", "0 n.0 1; 0 n.1 1; 1", "channel m : {0..1}"));
  EXPECT_TRUE(
      has_lts("(t?x -> STOP)[[t <- d.1]]", "0 d.1.false 1; 0 d.1.true 1; 1", "channel t : Bool"));
  // A pair list without pairs is no operator; τ stays.
  EXPECT_TRUE(
      has_lts("(STOP |~| a -> STOP)[[x <- x | x <- {b}, false]]", "0 tau 1; 0 tau 2; 1; 2 a 1"));
}

// --- Recursion and states -----------------------------------------------------------------------

TEST(StepTest, NamesThatOnlyStandForOthersAreNoStates) {
  EXPECT_TRUE(has_lts("Q", "0 a 0", "P = a -> P\nQ = P"));
  EXPECT_TRUE(has_lts("P", "0 a 1; 1 b 0", "P = a -> Q\nQ = b -> P"));
  EXPECT_TRUE(has_lts("Q", "0 a 0; 0 b 0", "P(x) = x -> P(x)\nQ = P(a) ||| P(b)"));
}

TEST(StepTest, ParametersMakeStates) {
  EXPECT_TRUE(
      has_lts("P(0)", "0 a 1; 1 a 2; 2 b 0", "P(k) = if k < 2 then a -> P(k + 1) else b -> P(0)"));
}

TEST(StepTest, RecursionWithoutAnEventIsRefused) {
  EXPECT_EQ(codes_of_process("P", "P = P [] a -> STOP"), "E013");
  EXPECT_EQ(codes_of_process("P", "P = Q \\ {a}\nQ = P ||| STOP"), "E013");
}

TEST(StepTest, AnErrorInTheInitialStateIsReportedOnce) {
  EXPECT_EQ(codes_of_process("Q", "P = error(\"no\") & STOP\nQ = P \\ {a}"), "E010");
}

TEST(StepTest, RecursionThroughInternalChoiceIsGuardedByItsTau) {
  EXPECT_TRUE(has_lts("P", "0 tau 0; 0 tau 1; 1 a 2; 2", "P = P |~| a -> STOP"));
  EXPECT_TRUE(has_lts("P", "0 tau 0; 0 a 1; 1", "P = a -> STOP [> P"));
}

TEST(StepTest, InfiniteStateSpacesEndAtTheLimit) {
  TestScript script("channel a\nP(k) = a -> P(k + 1)\nQ = a -> (Q ||| Q)");
  EXPECT_FALSE(script.explore("P(0)", {.max_states = 100}));
  EXPECT_FALSE(script.explore("Q", {.max_states = 100}));
  EXPECT_EQ(script.messages(), "");
}

}  // namespace
}  // namespace perentie::semantics

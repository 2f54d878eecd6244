// The operators on whole processes that have a meaning of their own: `deter` and the watchdogs.
#include <gtest/gtest.h>

#include "perentie/semantics/check.hpp"
#include "perentie/semantics/compression.hpp"
#include "perentie/semantics/process_graph.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

const std::string imports =
    "transparent normal\nexternal deter, trace_watchdog, failure_watchdog, prioritise\n";

::testing::AssertionResult becomes(const std::string& process, const std::string& lts,
                                   const std::string& definitions = "") {
  return has_lts(process, lts, imports + definitions);
}

// CSPM reference 4.6.4.
TEST(GraphOperatorTest, DeterKeepsOneOfEach) {
  EXPECT_TRUE(becomes("deter(a -> STOP |~| b -> STOP)", "0 a 1; 1"));
  EXPECT_TRUE(becomes("deter(a -> b -> STOP [] a -> c -> STOP)", "0 a 1; 1 b 2; 2"));
  EXPECT_TRUE(becomes("deter(a -> (b -> P) \\ {b})", "0 a 1; 1 tau 1", "P = b -> P"));
  EXPECT_TRUE(becomes("deter(SKIP [] a -> STOP)", "0 a 1; 0 tick 1; 1"));
}

TEST(GraphOperatorTest, InsideOfOperators) {
  EXPECT_TRUE(
      becomes("deter(a -> STOP |~| b -> STOP) ||| c -> STOP", "0 a 1; 0 c 2; 1 c 3; 2 a 3; 3"));
  EXPECT_TRUE(becomes("deter(a -> SKIP |~| STOP) ; b -> STOP", "0 a 1; 1 tau 2; 2 b 3; 3"));
  EXPECT_TRUE(becomes("deter(deter(a -> STOP |~| b -> STOP) |~| c -> STOP)", "0 a 1; 1"));
  EXPECT_TRUE(becomes("normal(deter(a -> STOP |~| b -> STOP))", "0 a 1; 1"));
}

// CSPM reference 4.6.2 and 4.6.3.
TEST(GraphOperatorTest, Watchdogs) {
  EXPECT_TRUE(
      becomes("trace_watchdog(a -> STOP, {a, b}, e)", "0 a 1; 0 b 2; 1 a 2; 1 b 2; 2 e 3; 3"));
  EXPECT_TRUE(becomes("failure_watchdog(STOP, {a}, e)", "0 tau 0; 0 a 1; 1 e 2; 2"));
  EXPECT_TRUE(becomes("trace_watchdog(STOP, {a}, e) ||| STOP", "0 a 1; 1 e 2; 2"));
}

// It is one process, whatever is done with it.
TEST(GraphOperatorTest, TheGraphIsTheSameEverywhere) {
  const std::string p = "P = normal(b -> STOP |~| a -> c -> STOP)\n";
  TestScript script(imports + "channel a, b, c\n" + p);
  ASSERT_TRUE(script.loaded()) << script.messages();
  const auto plain = script.explore("deter(P)");
  ASSERT_TRUE(plain);
  for (const auto preserved : {Preserved::priority, Preserved::bisimilarity, Preserved::identity}) {
    TestScript other(imports + "channel a, b, c\n" + p);
    other.script().set_preserved(preserved);
    const auto found = other.explore("deter(P)");
    ASSERT_TRUE(found);
    EXPECT_TRUE(isomorphic(*plain, *found));
  }
  EXPECT_TRUE(same_lts("prioritise(deter(P), <{c}>)", "deter(P)", imports + p));
}

TEST(GraphOperatorTest, ALimitIsNeverTheIdentity) {
  TestScript script(imports + "channel a, b\nP(n) = a -> P(n + 1)\nQ(n) = a -> deter(Q(n + 1))\n");
  ASSERT_TRUE(script.loaded()) << script.messages();
  for (const std::string process :
       {"deter(P(0))", "b -> deter(P(0))", "deter(P(0)) ||| STOP", "normal(deter(P(0)))", "Q(0)",
        "trace_watchdog(P(0), {a}, b)", "failure_watchdog(P(0), {a}, b)"}) {
    base::Diagnostics diagnostics;
    script.script().set_limits({.max_states = 1'000});
    const auto term = script.script().process(process, diagnostics);
    ASSERT_TRUE(term);
    const auto found =
        explore_process(script.script(), *term, {.limits = {.max_states = 1'000}}, diagnostics);
    EXPECT_FALSE(found.complete) << process;
    EXPECT_TRUE(found.limit) << process;
    EXPECT_LT(found.lts.state_count(), 200U) << process;
    EXPECT_FALSE(diagnostics.has_errors()) << base::render_all(diagnostics, script.sources());
  }
  script.script().set_limits({});
  EXPECT_TRUE(script.explore("deter(a -> STOP)"));
}

// With other limits the same process is tried again.
TEST(GraphOperatorTest, OtherLimitsAreAnotherTry) {
  TestScript script(imports + "channel a\nP(n) = a -> (if n == 0 then STOP else P(n - 1))\n");
  ASSERT_TRUE(script.loaded()) << script.messages();
  script.script().set_limits({.max_states = 100});
  EXPECT_FALSE(script.explore("deter(P(500))", {.max_states = 100}));
  script.script().set_limits({});
  const auto found = script.explore("deter(P(500))");
  ASSERT_TRUE(found) << script.messages();
  EXPECT_EQ(found->state_count(), 502U);
}

TEST(GraphOperatorTest, ErrorsInsideAreReported) {
  TestScript script(imports + "channel a\nP = a -> (if head(<>) then STOP else SKIP)\n");
  ASSERT_TRUE(script.loaded()) << script.messages();
  EXPECT_FALSE(script.explore("a -> normal(deter(P))"));
  EXPECT_EQ(script.codes(), "E005");
  EXPECT_FALSE(script.explore("deter(deter(P))"));
  EXPECT_EQ(script.codes(), "E005 E005") << "whoever asks again is told again";
}

// What is never reached needs no graph.
TEST(GraphOperatorTest, RecursionThroughAGraphIsAnErrorOnlyWhereItIsReached) {
  TestScript script(imports + "channel a\nP = (a -> deter(P)) [|{a}|] STOP\nQ = a -> deter(Q)\n");
  ASSERT_TRUE(script.loaded()) << script.messages();
  EXPECT_TRUE(script.explore("deter(P)")) << script.messages();
  EXPECT_FALSE(script.explore("Q"));
  EXPECT_EQ(script.codes(), "E023");
}

TEST(GraphOperatorTest, StatesAreNamedAfterTheProcess) {
  TestScript script(imports + "channel a, b\nP = a -> STOP |~| b -> STOP\n");
  ASSERT_TRUE(script.loaded()) << script.messages();
  base::Diagnostics diagnostics;
  const auto term = script.script().process("deter(P)", diagnostics);
  ASSERT_TRUE(term);
  EXPECT_EQ(script.script().name(*term), "deter(…)");
  EXPECT_EQ(script.script().show(*term), "deter(P)");
  const auto watchdog = script.script().process("trace_watchdog(P, {a}, b)", diagnostics);
  ASSERT_TRUE(watchdog);
  EXPECT_EQ(script.script().show(*watchdog), "trace_watchdog(P, {a}, b)");
}

}  // namespace
}  // namespace perentie::semantics

// Depth, time and size: deep input works or is refused in a sentence, and never breaks anything.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>

#include "script_support.hpp"

namespace perentie::semantics {
namespace {

std::string repeated(const std::string& text, std::size_t count) {
  std::string result;
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

// --- Depth --------------------------------------------------------------------------------------

TEST(LimitsTest, CallsNestAMillionDeep) {
  EXPECT_EQ(value_of("sum(1000000)", "sum(n) = if n == 0 then 0 else n + sum(n - 1)"),
            "500000500000");
  EXPECT_EQ(value_of("even(1000000)",
                     "even(n) = if n == 0 then true else odd(n - 1)\n"
                     "odd(n) = if n == 0 then false else even(n - 1)"),
            "true");
}

TEST(LimitsTest, SequencesAreAMillionLong) {
  EXPECT_EQ(value_of("#<1..1000000>"), "1000000");
  EXPECT_EQ(value_of("sum(<1..200000>)", "sum(<>) = 0\nsum(<x>^xs) = x + sum(xs)"), "20000100000");
  EXPECT_EQ(value_of("<1..100000> == <1..100000>"), "true");
  EXPECT_EQ(value_of("card(set(<1..100000>))"), "100000");
}

TEST(LimitsTest, DataNestsAThousandDeep) {
  const char* numbers =
      "datatype Nat = Zero | Succ.Nat\n"
      "build(n) = if n == 0 then Zero else Succ.build(n - 1)\n"
      "size(Zero) = 0\nsize(Succ.m) = 1 + size(m)";
  EXPECT_EQ(value_of("size(build(1000))", numbers), "1000");
  EXPECT_EQ(value_of("(build(1000)) == (build(1000))", numbers), "true");
  EXPECT_EQ(value_of("member(build(1000), {build(1000), Zero})", numbers), "true");
  EXPECT_EQ(value_of("#show(build(1000))", numbers), "5004");
}

TEST(LimitsTest, DeepDataIsBuiltInLinearTime) {
  EXPECT_EQ(value_of("size(build(100000))",
                     "datatype Nat = Zero | Succ.Nat\n"
                     "build(n) = if n == 0 then Zero else Succ.build(n - 1)\n"
                     "size(Zero) = 0\nsize(Succ.m) = 1 + size(m)"),
            "100000");
}

TEST(LimitsTest, LongExpressionsAreLoweredWithoutRecursion) {
  EXPECT_EQ(value_of("0" + repeated(" + 1", 10'000)), "10000");
  EXPECT_EQ(value_of("#(<>" + repeated("^<1>", 1'000) + ")"), "1000");
}

TEST(LimitsTest, LongProcessesAreExplored) {
  TestScript script("channel a\nP = " + repeated("a -> ", 1'000) + "STOP");
  const auto lts = script.explore("P");
  ASSERT_TRUE(lts) << script.messages();
  EXPECT_EQ(lts->state_count(), 1001U);
}

TEST(LimitsTest, DeeplyNestedExpressionsAreRefusedWithASentence) {
  for (const auto& [open, close] : {std::pair{"(", ")"}, std::pair{"<", ">"}, std::pair{"f(", ")"},
                                    std::pair{"if true then ", " else 0"}}) {
    SCOPED_TRACE(open);
    TestScript script("f(x) = x\ny = " + repeated(open, 100'000) + "0" + repeated(close, 100'000));
    EXPECT_FALSE(script.loaded());
    EXPECT_FALSE(script.messages().empty());
  }
}

TEST(LimitsTest, TermsNestedTooDeeplyEndInconclusively) {
  TestScript script("channel a, b\nP(k) = if k == 0 then a -> STOP else P(k - 1) \\ {b}");
  EXPECT_TRUE(script.explore("P(1000)")) << script.messages();
  EXPECT_FALSE(script.explore("P(100000)"));
  EXPECT_EQ(script.messages(), "");
}

TEST(LimitsTest, NamesStandForNamesAHundredThousandDeep) {
  TestScript script(
      "channel a\nP(n) = if n == 0 then a -> STOP else P(n - 1)\n"
      "Endless(n) = if n < 0 then STOP else Endless(n + 1)");
  const auto lts = script.explore("P(100000)");
  ASSERT_TRUE(lts) << script.messages();
  EXPECT_EQ(lts->state_count(), 2U);
  EXPECT_FALSE(script.explore("Endless(0)"));
  EXPECT_EQ(script.messages(), "");
}

// --- Time ---------------------------------------------------------------------------------------

class Endless : public ::testing::TestWithParam<const char*> {};

TEST_P(Endless, EndsWhenItsTimeIsUp) {
  TestScript script(R"(
loop(n) = loop(n + 1)
grow(xs) = grow(xs^<1>)
double(s) = double(union(s, {x + card(s) | x <- s}))
ones = <1>^ones
twice(x) = (x, x)
twice4(x) = twice(twice(twice(twice(x))))
twice16(x) = twice4(twice4(twice4(twice4(x))))
)");
  base::Limits limits;
  limits.timeout = std::chrono::milliseconds(100);
  script.script().set_limits(limits);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(script.evaluate(GetParam()), std::nullopt);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  ASSERT_TRUE(script.script().limit());
  EXPECT_EQ(script.script().limit()->kind, base::LimitKind::time);
}

INSTANTIATE_TEST_SUITE_P(Evaluation, Endless,
                         ::testing::Values("loop(0)", "#ones", "elem(2, ones)",
                                           "#<x | x <- <0..>, x < 0>",
                                           "head(<x | x <- <1..>, x < 0>)", "show(<0..>)",
                                           "ones == ones", "twice16(twice16(twice16(1)))",
                                           "card(Set({1..23}))",
                                           "card(Union({{(x, y, z) | x <- s} | s <- {{1..250}}, "
                                           "y <- s, z <- s}))"));

TEST(LimitsTest, ListingEventsEndsWhenItsTimeIsUp) {
  TestScript script("channel c : {0..15}.{0..15}.{0..15}.{0..15}.{0..15}.{0..15}");
  base::Limits limits;
  limits.timeout = std::chrono::milliseconds(50);
  script.script().set_limits(limits);
  EXPECT_EQ(script.evaluate("card({|c|})"), std::nullopt);
  ASSERT_TRUE(script.script().limit());
  EXPECT_EQ(script.script().limit()->kind, base::LimitKind::time);
}

TEST(LimitsTest, EvaluationEndsWhenItIsCancelled) {
  TestScript script("loop(n) = loop(n + 1)");
  const std::atomic<bool> cancelled = true;
  script.script().set_limits({.cancelled = &cancelled});
  EXPECT_EQ(script.evaluate("loop(0)"), std::nullopt);
  ASSERT_TRUE(script.script().limit());
  EXPECT_EQ(script.script().limit()->kind, base::LimitKind::cancelled);
}

TEST(LimitsTest, EvaluationEndsWhenItsMemoryIsUsed) {
  TestScript script("count(n) = 1 + count(n + 1)");
  base::Limits limits;
  limits.max_memory_bytes = 64U << 20U;
  script.script().set_limits(limits);
  EXPECT_EQ(script.evaluate("count(0)"), std::nullopt);
  ASSERT_TRUE(script.script().limit()) << script.messages();
  EXPECT_EQ(script.script().limit()->kind, base::LimitKind::memory);
}

TEST(LimitsTest, AScriptIsUsableAfterALimit) {
  TestScript script("loop(n) = loop(n + 1)\nslow = loop(0)\nquick = 3");
  base::Limits limits;
  limits.timeout = std::chrono::milliseconds(20);
  script.script().set_limits(limits);
  EXPECT_EQ(script.evaluate("slow + 1"), std::nullopt);
  EXPECT_EQ(script.evaluate("quick"), "3");
  EXPECT_FALSE(script.script().limit());
  EXPECT_EQ(script.evaluate("slow"), std::nullopt);
  EXPECT_TRUE(script.script().limit());
  EXPECT_EQ(script.messages(), "");
}

TEST(LimitsTest, AScriptIsUsableAfterAnError) {
  TestScript script("bad = head(<>)\ngood = 1\nboth = <good, bad>");
  EXPECT_EQ(script.evaluate("bad"), std::nullopt);
  EXPECT_EQ(script.evaluate("good"), "1");
  EXPECT_EQ(script.evaluate("bad"), std::nullopt);
  EXPECT_EQ(script.evaluate("head(both)"), "1");
  EXPECT_EQ(script.codes(), "E005 E005");
}

// --- Memory -------------------------------------------------------------------------------------

TEST(LimitsTest, GarbageIsCollected) {
  // Some 10^7 heap cells are made here; few are ever alive.
  TestScript script(
      "count(n, s) = if n == 0 then s else count(n - 1, (s + n) % 1000)\n"
      "last(<x>) = x\nlast(<x>^xs) = last(xs)");
  base::Limits limits;
  limits.max_memory_bytes = 256U << 20U;
  script.script().set_limits(limits);
  EXPECT_EQ(script.evaluate("count(1000000, 0)"), "0") << script.messages();
  EXPECT_EQ(script.evaluate("last(<1..300000>)"), "300000") << script.messages();
}

TEST(LimitsTest, WhatIsAliveSurvivesCollections) {
  EXPECT_EQ(value_of("(#kept, head(kept), card(set(kept)), churn(200000), #kept, kept == kept)", R"(
kept = <(n, {n, n + 1}, <n>) | n <- <1..2000>>
churn(n) = if n == 0 then 0 else (let f(x) = x + n within f(0 - n) + churn(n - 1))
)"),
            "(2000, (1, {1, 2}, <1>), 2000, 0, 2000, true)");
}

}  // namespace
}  // namespace perentie::semantics

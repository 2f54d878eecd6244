// Compressions that scripts ask for: where each is applied, what states it leaves, and where it is
// the identity instead.
#include "perentie/semantics/compression.hpp"

#include <gtest/gtest.h>

#include "perentie/semantics/check.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

const std::string compressions =
    "transparent explicate, lazyenumerate, diamond, normal, lazynorm, sbisim, dbisim, wbisim\n"
    "transparent tau_loop_factor\nexternal prioritise\n";

::testing::AssertionResult becomes(const std::string& process, const std::string& lts,
                                   const std::string& definitions = "") {
  return has_lts(process, lts, compressions + definitions);
}

TEST(CompressionTest, EnumerationIsTheIdentity) {
  const std::string p = "P = a -> P [> (b -> SKIP |~| DIV)";
  for (const std::string name : {"explicate", "lazyenumerate", "lazynorm"}) {
    EXPECT_TRUE(same_lts(name + "(P)", "P", compressions + p)) << name;
  }
}

// CSPM reference 4.7.4: a and b lead to processes that are bisimilar.
TEST(CompressionTest, StrongBisimulation) {
  EXPECT_TRUE(
      becomes("sbisim(a -> c -> STOP [] b -> (c -> STOP [] c -> STOP))", "0 a 1; 0 b 1; 1 c 2; 2"));
}

// CSPM reference 4.7.5 and 4.7.3: a τ that decides nothing is no step; a divergence is a τ loop.
TEST(CompressionTest, DelayAndWeakBisimulation) {
  for (const std::string name : {"dbisim", "wbisim"}) {
    EXPECT_TRUE(becomes(name + "((c -> a -> STOP) \\ {c})", "0 a 1; 1")) << name;
    EXPECT_TRUE(becomes(name + "(a -> DIV)", "0 a 1; 1 tau 1")) << name;
  }
}

TEST(CompressionTest, TauLoopFactor) {
  EXPECT_TRUE(becomes("tau_loop_factor(P \\ {a, b})", "0 tau 0", "P = a -> b -> P"));
}

// CSPM reference 4.7.7's own example: the refusals are those of a stable state behind τ.
TEST(CompressionTest, NormalFormsSayWhatTheyRefuse) {
  EXPECT_TRUE(becomes("normal(P)", "0 a 1; 1 a 1; 1 tau 2; 2", "P = a -> P |~| a -> STOP"));
  EXPECT_TRUE(becomes("diamond(a -> STOP [> b -> STOP)", "0 a 2; 0 b 2; 0 tau 1; 1 b 2; 2"));
}

// CSPM reference 4.7.8.
TEST(CompressionTest, WhatIsHiddenAltogetherHasOneState) {
  EXPECT_TRUE(becomes("normal((a -> b -> STOP) \\ {a, b})", "0"));
  EXPECT_TRUE(becomes("normal((a -> b -> SKIP) \\ {a, b})", "0 tick 1; 1"));
  EXPECT_TRUE(becomes("normal(P \\ {a, b})", "0 tau 0", "P = a -> b -> P"));
}

TEST(CompressionTest, InsideOfOperatorsEachIsItsGraph) {
  EXPECT_TRUE(
      becomes("dbisim((c -> a -> STOP) \\ {c}) ||| b -> STOP", "0 a 1; 0 b 2; 1 b 3; 2 a 3; 3"));
  EXPECT_TRUE(becomes("dbisim((c -> a -> STOP) \\ {c}) [] b -> STOP", "0 a 1; 0 b 1; 1"));
  EXPECT_TRUE(becomes("normal(a -> sbisim(b -> STOP [] b -> STOP))", "0 a 1; 1 b 2; 2"));
}

// CSPM reference 6.2.6: the τ into what follows stays.
TEST(CompressionTest, InSequences) {
  EXPECT_TRUE(becomes("normal(SKIP) ; a -> STOP", "0 tau 1; 1 a 2; 2"));
}

// CSPM reference 4.5.7: `prioritise` tells more processes apart than failures do.
TEST(CompressionTest, BelowPriorityOnlyBisimulationsAreApplied) {
  const std::string p = "P = (c -> a -> STOP) \\ {c}\n";
  EXPECT_TRUE(same_lts("prioritise(normal(P), <{b}, {a}>)", "P", compressions + p));
  EXPECT_TRUE(same_lts("prioritise(normal(P) ||| STOP, <{b}, {a}>)", "P", compressions + p));
  EXPECT_TRUE(becomes("prioritise(dbisim(P), <{b}, {a}>)", "0 a 1; 1", p));
  EXPECT_TRUE(becomes("normal(prioritise(P, <{b}, {a}>))", "0 a 1; 1", p));
}

TEST(CompressionTest, ProcessesThatAreTooLargeAreLeftAlone) {
  TestScript script(compressions + "channel a, b\nP(n) = a -> P(n + 1)\nQ = b -> P(0)");
  ASSERT_TRUE(script.loaded()) << script.messages();
  script.script().set_limits({.max_states = 100});
  EXPECT_FALSE(script.explore("normal(P(0))", {.max_states = 100}));
  EXPECT_EQ(script.messages(), "");
  EXPECT_EQ(script.script().compressions_given_up(), std::vector<std::string>{"normal"});
  EXPECT_TRUE(script.explore("sbisim(Q) [|{b}|] STOP", {.max_states = 100}));
  EXPECT_EQ(script.script().compressions_given_up(),
            (std::vector<std::string>{"normal", "sbisim"}));
}

// There is no graph of a process that is compressed inside of itself.
TEST(CompressionTest, RecursionThroughACompressionIsTheIdentity) {
  TestScript script(compressions + "channel a\nP = a -> normal(P)\nQ = a -> (Q ||| normal(Q))\n");
  ASSERT_TRUE(script.loaded()) << script.messages();
  for (const std::string process : {"normal(P)", "normal(Q)", "P ||| sbisim(Q)"}) {
    script.script().set_limits({.max_states = 300});
    EXPECT_FALSE(script.explore(process, {.max_states = 300})) << process;
    EXPECT_EQ(script.messages(), "");
  }
}

TEST(CompressionTest, CompressionsInCompressions) {
  EXPECT_TRUE(
      becomes("P(300)", "0 a 0", "P(k) = if k == 0 then Q else sbisim(P(k - 1))\nQ = a -> Q"));
}

// An error inside is reported where it is met, at the place where it is.
TEST(CompressionTest, ErrorsAreThoseOfTheProcess) {
  TestScript script(compressions + "channel a\nP = a -> (if head(<>) then STOP else SKIP)\n");
  ASSERT_TRUE(script.loaded()) << script.messages();
  EXPECT_FALSE(script.explore("normal(P)"));
  EXPECT_EQ(script.codes(), "E005");
}

TEST(CompressionTest, FinerModelsSeeOnlyStrongBisimulation) {
  TestScript script(compressions + "channel a\nP = a -> STOP |~| a -> a -> STOP\n");
  ASSERT_TRUE(script.loaded()) << script.messages();
  script.script().set_preserved(Preserved::bisimilarity);
  const auto exact = script.explore("P");
  const auto normal = script.explore("normal(P)");
  const auto strong = script.explore("sbisim(P)");
  ASSERT_TRUE(exact && normal && strong);
  EXPECT_TRUE(isomorphic(*exact, *normal));
  EXPECT_TRUE(isomorphic(*exact, *strong));
}

}  // namespace
}  // namespace perentie::semantics

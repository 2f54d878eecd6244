#include "perentie/lts/compressions.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;
using test::to_text;

/// The acceptances and the divergence of each state: `{a}{b} {}! -` for three states.
std::string marks(const GeneralisedLts& generalised) {
  std::string text;
  for (std::uint32_t s = 0; s < generalised.lts.state_count(); ++s) {
    if (s > 0) text += ' ';
    const auto acceptances = generalised.acceptances.of(State{s});
    for (const AcceptanceId id : acceptances) {
      text += '{';
      for (const Label label : generalised.acceptances.labels(id)) {
        text += generalised.lts.name(label);
      }
      text += '}';
    }
    if (acceptances.empty()) text += '-';
    if (generalised.divergent[s]) text += '!';
  }
  return text;
}

TEST(TauLoopFactorTest, ALoopBecomesOneDivergentState) {
  const Quotient quotient = tau_loop_factor(lts_from("0 a 1; 1 tau 2; 2 tau 3; 3 tau 1; 2 b 0"));
  EXPECT_EQ(to_text(quotient.lts), "0 a 1; 1 τ 1; 1 b 0");
  EXPECT_EQ(quotient.block_of, (std::vector<State>{State{0}, State{1}, State{1}, State{1}}));
}

TEST(TauLoopFactorTest, OtherTausRemain) {
  EXPECT_EQ(to_text(tau_loop_factor(lts_from("0 tau 1; 1 a 2; 2 tau 2")).lts),
            "0 τ 1; 1 a 2; 2 τ 2");
}

TEST(DiamondTest, StatesBehindTauGiveTheirStepsAcceptancesAndDivergence) {
  const auto result = diamond(lts_from("0 tau 1; 0 tau 2; 1 a 3; 2 b 4; 3; 4 tau 4"));
  const auto& generalised = std::get<GeneralisedLts>(result);
  EXPECT_EQ(to_text(generalised.lts), "0 a 1; 0 b 2; 1; 2");
  EXPECT_EQ(marks(generalised), "{a}{b} {} -!");
}

TEST(DiamondTest, ATargetBehindAnotherOneIsSuperfluous) {
  const auto result = diamond(lts_from("0 a 1; 0 a 2; 1 tau 2; 1 b 0; 2 c 0"));
  const auto& generalised = std::get<GeneralisedLts>(result);
  EXPECT_EQ(to_text(generalised.lts), "0 a 1; 1 b 0; 1 c 0");
  EXPECT_EQ(marks(generalised), "{a} {c}");
}

TEST(DiamondTest, DivergenceBehindTauIsMarked) {
  const auto result = diamond(lts_from("0 tau 1; 1 tau 2; 2 tau 1; 0 tau 3; 3 a 0"));
  const auto& generalised = std::get<GeneralisedLts>(result);
  EXPECT_EQ(to_text(generalised.lts), "0 a 0");
  EXPECT_EQ(marks(generalised), "{a}!");
}

TEST(NormalTest, TheExampleOfTheReference) {
  // P = a->P |~| a->STOP; CSPM reference 4.7.7.
  const auto result = normal(lts_from("0 tau 1; 0 tau 2; 1 a 0; 2 a 3; 3"));
  const auto& generalised = std::get<GeneralisedLts>(result);
  EXPECT_EQ(to_text(generalised.lts), "0 a 1; 1 a 1");
  EXPECT_EQ(marks(generalised), "{a} {}");
}

TEST(NormalTest, NodesThatSayTheSameAreMerged) {
  const auto result = normal(lts_from("0 a 1; 1 a 2; 2 a 0; 2 b 2"));
  EXPECT_EQ(std::get<GeneralisedLts>(result).lts.state_count(), 3U);
  const auto ring = normal(lts_from("0 a 1; 1 a 2; 2 a 0"));
  EXPECT_EQ(to_text(std::get<GeneralisedLts>(ring).lts), "0 a 0");
}

TEST(NormalTest, WhenAllIsHiddenOneStateIsLeftAndTwoWithTick) {
  // CSPM reference 4.7.8.
  const auto loop = normal(lts_from("0 tau 1; 1 tau 0"));
  EXPECT_EQ(to_text(std::get<GeneralisedLts>(loop).lts), "0");
  EXPECT_EQ(marks(std::get<GeneralisedLts>(loop)), "-!");
  const auto ending = normal(lts_from("0 tau 1; 1 tau 2; 2 tick 3; 3"));
  EXPECT_EQ(to_text(std::get<GeneralisedLts>(ending).lts), "0 ✓ 1; 1");
  EXPECT_EQ(marks(std::get<GeneralisedLts>(ending)), "{✓} {}");
}

TEST(CompressionsTest, ABudgetThatRunsOutIsAValue) {
  const std::atomic<bool> cancelled{true};
  const Lts lts = lts_from("0 a 1; 0 a 0; 0 b 0; 1 a 2; 1 b 2; 2 a 3; 2 b 3; 3");
  for (const auto compress : {diamond, normal}) {
    const auto result = compress(lts, {.cancelled = &cancelled});
    ASSERT_TRUE(std::holds_alternative<base::LimitReached>(result));
    EXPECT_EQ(std::get<base::LimitReached>(result).kind, base::LimitKind::cancelled);
  }
  const auto few = normal(lts, {.max_states = 3});
  ASSERT_TRUE(std::holds_alternative<base::LimitReached>(few));
  EXPECT_EQ(std::get<base::LimitReached>(few).kind, base::LimitKind::states);
}

}  // namespace
}  // namespace perentie::lts

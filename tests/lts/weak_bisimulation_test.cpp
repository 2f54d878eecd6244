#include "perentie/lts/weak_bisimulation.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;
using test::to_text;

std::string strong(std::string_view text) {
  return to_text(strong_bisimulation(lts_from(text, {"a", "b", "c"})).lts);
}
std::string delay(std::string_view text) {
  return to_text(std::get<Quotient>(delay_bisimulation(lts_from(text, {"a", "b", "c"}))).lts);
}
std::string weak(std::string_view text) {
  return to_text(std::get<Quotient>(weak_bisimulation(lts_from(text, {"a", "b", "c"}))).lts);
}

TEST(WeakBisimulationTest, ATauThatDecidesNothingVanishes) {
  constexpr auto text = "0 tau 1; 1 a 2; 2 tau 3; 3 b 0";
  EXPECT_EQ(strong(text), "0 τ 1; 1 a 2; 2 τ 3; 3 b 0");
  EXPECT_EQ(delay(text), "0 a 1; 1 b 0");
  EXPECT_EQ(weak(text), "0 a 1; 1 b 0");
}

TEST(WeakBisimulationTest, ATauThatDecidesRemains) {
  constexpr auto text = "0 a 1; 0 tau 2; 1; 2 b 1";
  EXPECT_EQ(delay(text), "0 τ 1; 0 a 2; 1 b 2; 2");
  EXPECT_EQ(weak(text), delay(text));
}

TEST(WeakBisimulationTest, WeakMatchesAlsoWithTauAfterTheStep) {
  // The third law of Milner, a.(p + τ.q) + a.q = a.(p + τ.q), holds for weak bisimulation only.
  constexpr auto text = "0 a 1; 0 a 2; 1 b 3; 1 tau 2; 2 c 3; 3";
  EXPECT_EQ(delay(text), "0 a 1; 0 a 2; 1 c 3; 2 τ 1; 2 b 3; 3");
  EXPECT_EQ(weak(text), "0 a 1; 1 τ 2; 1 b 3; 2 c 3; 3");
}

TEST(WeakBisimulationTest, DelayMatchesWithTauBeforeTheStep) {
  // 0 has a step a of its own to where 1 leads with a: superfluous. Branching bisimulation would
  // keep 4 apart, which lacks it.
  constexpr auto text = "0 tau 1; 0 a 2; 0 b 2; 1 a 2; 2 c 4; 2 c 0; 4 tau 1; 4 b 2";
  EXPECT_EQ(strong(text), "0 τ 1; 0 a 2; 0 b 2; 1 a 2; 2 c 0; 2 c 3; 3 τ 1; 3 b 2");
  EXPECT_EQ(delay(text), "0 τ 1; 0 b 2; 1 a 2; 2 c 0");
}

TEST(WeakBisimulationTest, ATauToWhatAnotherTauReachesIsSuperfluous) {
  EXPECT_EQ(delay("0 tau 1; 0 tau 2; 1 tau 2; 1 a 3; 0 b 3; 2 c 3; 3"),
            "0 τ 1; 0 b 2; 1 τ 3; 1 a 2; 2; 3 c 2");
}

TEST(WeakBisimulationTest, DivergenceIsKept) {
  EXPECT_EQ(delay("0 tau 1; 1 tau 0; 0 a 2; 2"), "0 τ 0; 0 a 1; 1");
  EXPECT_EQ(weak("0 a 1; 0 a 2; 1 tau 1; 2"), "0 a 1; 0 a 2; 1 τ 1; 2");
  EXPECT_EQ(weak("0 tau 0"), "0 τ 0");
}

TEST(WeakBisimulationTest, ALoopIsSuperfluousBeforeAnotherDivergence) {
  EXPECT_EQ(delay("0 tau 0; 0 tau 1; 0 a 2; 1 tau 1; 2"), "0 τ 1; 0 a 2; 1 τ 1; 2");
}

TEST(WeakBisimulationTest, StatesAreMappedThroughAllSteps) {
  const auto result = delay_bisimulation(lts_from("-> 3; 0 a 1; 1 tau 2; 2 tau 1; 3 tau 0; 4 a 3"));
  const Quotient& quotient = std::get<Quotient>(result);
  EXPECT_EQ(to_text(quotient.lts), "0 a 1; 1 τ 1");
  EXPECT_EQ(quotient.block_of,
            (std::vector<State>{State{0}, State{1}, State{1}, State{0}, State{}}));
}

Lts tau_chain(std::uint32_t length) {
  LtsRowBuilder rows;
  for (std::uint32_t s = 0; s < length; ++s) {
    rows.add_edge(s % 2 == 0 ? tau : Label{2}, State{s + 1});
    rows.end_row();
  }
  return std::move(rows).finish(State{0}, length + 1,
                                std::make_shared<LabelNames>(LabelNames{"τ", "✓", "a"}));
}

TEST(WeakBisimulationTest, ALongChainEnds) {
  EXPECT_EQ(std::get<Quotient>(delay_bisimulation(tau_chain(20'000))).lts.state_count(), 10'001U);
  EXPECT_EQ(std::get<Quotient>(weak_bisimulation(tau_chain(20'000))).lts.state_count(), 10'001U);
}

/// Three edges a state, to one of the next hundred, with `name_count` names of labels.
Lts random_lts(std::uint32_t states, std::uint32_t name_count) {
  LabelNames names{"τ", "✓"};
  while (names.size() < name_count) names.push_back(std::to_string(names.size()));
  std::mt19937 random(1);
  LtsRowBuilder rows;
  for (std::uint32_t s = 0; s < states; ++s) {
    for (int i = 0; i < 3; ++i) {
      const auto label = static_cast<std::uint32_t>(random() % 4);
      const auto step = static_cast<std::uint32_t>(random() % 100);
      rows.add_edge(label == 0 ? tau : Label{label + 1}, State{(s + step) % states});
    }
    rows.end_row();
  }
  return std::move(rows).finish(State{0}, states, std::make_shared<LabelNames>(std::move(names)));
}

// Pairs of a label and a state that do not fit 32 bits take another way.
TEST(WeakBisimulationTest, LabelsThatNoEdgeHasDoNotMatter) {
  for (const auto reduce : {delay_bisimulation, weak_bisimulation}) {
    const auto few = std::get<Quotient>(reduce(random_lts(8'000, 5), {}));
    const auto many = std::get<Quotient>(reduce(random_lts(8'000, 140'000), {}));
    EXPECT_LT(few.lts.state_count(), 8'000U);
    EXPECT_EQ(many.block_of, few.block_of);
    EXPECT_EQ(to_text(many.lts), to_text(few.lts));
  }
}

TEST(WeakBisimulationTest, ABudgetThatRunsOutIsAValue) {
  const std::atomic<bool> cancelled{true};
  const Lts lts = tau_chain(10);
  for (const auto reduce : {delay_bisimulation, weak_bisimulation}) {
    const auto result = reduce(lts, {.cancelled = &cancelled});
    ASSERT_TRUE(std::holds_alternative<base::LimitReached>(result));
    EXPECT_EQ(std::get<base::LimitReached>(result).kind, base::LimitKind::cancelled);
    const auto starved = reduce(lts, {.max_memory_bytes = 1});
    ASSERT_TRUE(std::holds_alternative<base::LimitReached>(starved));
    EXPECT_EQ(std::get<base::LimitReached>(starved).kind, base::LimitKind::memory);
  }
}

}  // namespace
}  // namespace perentie::lts

#include "perentie/lts/bisimulation.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "perentie/test/lts_text.hpp"
#include "stable_partition.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;
using test::to_text;

TEST(StrongBisimulationTest, OneStateStaysOne) {
  const Quotient quotient = strong_bisimulation(lts_from("0"));
  EXPECT_EQ(to_text(quotient.lts), "0");
  EXPECT_EQ(quotient.block_of, std::vector<State>{State{0}});
}

TEST(StrongBisimulationTest, StatesWithTheSameStepsAreMerged) {
  const Quotient quotient =
      strong_bisimulation(lts_from("0 a 1; 0 a 2; 1 b 0; 2 b 0; 2 b 3; 3 a 1"));
  EXPECT_EQ(to_text(quotient.lts), "0 a 1; 1 b 0");
  EXPECT_EQ(quotient.block_of, (std::vector<State>{State{0}, State{1}, State{1}, State{0}}));
}

TEST(StrongBisimulationTest, TheTimeOfAChoiceMatters) {
  const Lts lts = lts_from("0 a 1; 1 b 2; 1 c 3; 0 a 4; 0 a 5; 4 b 6; 5 c 7");
  EXPECT_EQ(to_text(strong_bisimulation(lts).lts),
            "0 a 1; 0 a 2; 0 a 3; 1 b 4; 1 c 4; 2 b 4; 3 c 4; 4");
}

TEST(StrongBisimulationTest, HowOftenAStepIsPossibleDoesNotMatter) {
  // 0 and 1 lead to the same two blocks, 0 by three edges and 1 by two.
  const Lts lts = lts_from("0 a 2; 0 a 3; 0 a 4; 1 a 2; 1 a 4; 2 b 0; 3 b 1; 4 c 1");
  EXPECT_EQ(to_text(strong_bisimulation(lts).lts), "0 a 1; 0 a 2; 1 b 0; 2 c 0");
}

TEST(StrongBisimulationTest, TauAndTickAreLabelsLikeOthers) {
  const Lts lts = lts_from("0 tau 1; 1 tau 2; 2 tick 3");
  EXPECT_EQ(strong_bisimulation(lts).lts.state_count(), 4U);
}

TEST(StrongBisimulationTest, UnreachableBlocksAreLeftOut) {
  const Quotient quotient = strong_bisimulation(lts_from("-> 2; 0 b 1; 1; 2 a 1; 3 a 1"));
  EXPECT_EQ(to_text(quotient.lts), "0 a 1; 1");
  EXPECT_EQ(quotient.block_of, (std::vector<State>{State{}, State{1}, State{0}, State{0}}));
}

TEST(StrongBisimulationTest, ClassesStayApart) {
  const Lts lts = lts_from("0 a 1; 1 a 2; 2 a 0");
  EXPECT_EQ(strong_bisimulation(lts).lts.state_count(), 1U);
  EXPECT_EQ(strong_bisimulation(lts, std::vector<std::uint32_t>{7, 7, 7}).lts.state_count(), 1U);
  EXPECT_EQ(strong_bisimulation(lts, std::vector<std::uint32_t>{7, 7, 9}).lts.state_count(), 3U);
  const Lts two = lts_from("0 a 1; 1 a 0");
  const Quotient quotient = strong_bisimulation(two, std::vector<std::uint32_t>{1, 0});
  EXPECT_EQ(to_text(quotient.lts), "0 a 1; 1 a 0");
}

TEST(StrongBisimulationTest, NumbersAreBreadthFirst) {
  const Lts lts = lts_from("-> 5; 5 a 4; 5 b 2; 2 c 0; 4 d 1; 0; 1 e 0");
  EXPECT_EQ(to_text(strong_bisimulation(lts).lts), "0 a 1; 0 b 2; 1 d 3; 2 c 4; 3 e 4; 4");
}

Lts counter(std::uint32_t states, std::uint32_t copies) {
  LtsRowBuilder rows;
  for (std::uint32_t s = 0; s < states; ++s) {
    for (std::uint32_t c = 0; c < copies; ++c) {
      if (s + 1 < states) rows.add_edge(Label{2}, State{(s + 1) * copies + (c + 1) % copies});
      rows.end_row();
    }
  }
  return std::move(rows).finish(State{0}, std::size_t{states} * copies,
                                std::make_shared<LabelNames>(LabelNames{"τ", "✓", "a"}));
}

TEST(StrongBisimulationTest, ALongChainTakesNoQuadraticTime) {
  // One state parts from the others at a time: 200,000 rounds.
  const Quotient quotient = strong_bisimulation(counter(100'000, 3));
  EXPECT_EQ(quotient.lts.state_count(), 100'000U);
  EXPECT_EQ(quotient.lts.edge_count(), 99'999U);
}

TEST(StrongBisimulationTest, HubsTakeNoQuadraticTime) {
  // Two hubs lead to every state of a chain: each round changes what they lead to.
  constexpr std::uint32_t states = 50'000;
  LtsBuilder builder(std::make_shared<LabelNames>(LabelNames{"τ", "✓", "a", "b"}));
  builder.add_states(states + 2);
  for (std::uint32_t s = 0; s < states; ++s) {
    if (s + 1 < states) builder.add_edge(State{s}, Label{2}, State{s + 1});
    builder.add_edge(State{states}, Label{3}, State{s});
    builder.add_edge(State{states + 1}, Label{3}, State{s});
  }
  const Quotient quotient = strong_bisimulation(std::move(builder).finish(State{states}));
  EXPECT_EQ(quotient.lts.state_count(), states + 1);
  EXPECT_EQ(quotient.block_of[states], quotient.block_of[states + 1]);
}

TEST(StablePartitionTest, AnUnstablePartitionIsSeen) {
  // This is what stands between a collision of hashes and a wrong quotient.
  const Lts lts = lts_from("0 a 1; 1 a 2; 2");
  Partition partition(3);
  EXPECT_FALSE(is_stable(lts, partition));
  std::vector<Partition::Split> splits;
  const std::vector<std::uint32_t> changed{2};
  const std::vector<std::uint64_t> keys{1, 1, 2};
  partition.split(changed, keys, splits);
  EXPECT_FALSE(is_stable(lts, partition)) << "1 leads to the block of 2, and 0 does not";
  EXPECT_FALSE(parts(partition, std::vector<std::uint32_t>{4, 5, 5}));
  EXPECT_TRUE(parts(partition, std::vector<std::uint32_t>{4, 4, 5}));
  partition.split(std::vector<std::uint32_t>{1}, std::vector<std::uint64_t>{1, 3, 2}, splits);
  EXPECT_TRUE(is_stable(lts, partition));
}

TEST(PartitionTest, TheLargestPartKeepsTheNumber) {
  Partition partition(10);
  std::vector<std::uint32_t> all(10);
  std::iota(all.begin(), all.end(), 0U);
  std::vector<Partition::Split> splits;
  partition.split(all, std::vector<std::uint64_t>{1, 2, 2, 2, 2, 2, 3, 3, 1, 2}, splits);
  ASSERT_EQ(splits.size(), 2U);
  EXPECT_EQ(partition.block_count(), 3U);
  EXPECT_EQ(partition.size_of(0), 6U);
  for (const std::uint32_t e : {1U, 2U, 3U, 4U, 5U, 9U}) EXPECT_EQ(partition.block_of(e), 0U);
  EXPECT_EQ(partition.block_of(0), partition.block_of(8));
  EXPECT_NE(partition.block_of(0), partition.block_of(6));

  // Four of six change, three of them to one key: the two that did not change lose the number.
  splits.clear();
  partition.split(std::vector<std::uint32_t>{9, 1, 4, 3},
                  std::vector<std::uint64_t>{1, 5, 2, 5, 2, 2, 3, 3, 1, 5}, splits);
  ASSERT_EQ(splits.size(), 1U);
  EXPECT_EQ(splits[0].from, 0U);
  EXPECT_EQ(partition.size_of(0), 3U);
  EXPECT_EQ(partition.block_of(4), partition.block_of(2)) << "4 was named, but its key is the same";
}

}  // namespace
}  // namespace perentie::lts

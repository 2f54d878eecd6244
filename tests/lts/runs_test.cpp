// Runs come back as they were added, equal ones under one number, through many growths of the
// table.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "perentie/lts/lts.hpp"
#include "perentie/lts/runs.hpp"

namespace perentie::lts {
namespace {

std::vector<State> states(std::initializer_list<std::uint32_t> numbers) {
  std::vector<State> result;
  for (const std::uint32_t number : numbers) result.push_back(State{number});
  return result;
}

TEST(RunsTest, KeepsOrderAndEmptyRuns) {
  Runs<State> runs;
  for (const auto& run : {states({}), states({3, 1}), states({}), states({3, 1})}) runs.add(run);
  ASSERT_EQ(runs.size(), 4U);
  EXPECT_TRUE(runs[0].empty());
  EXPECT_TRUE(std::ranges::equal(runs[1], states({3, 1})));
  EXPECT_TRUE(runs[2].empty());
  EXPECT_TRUE(std::ranges::equal(runs[3], states({3, 1})));
}

TEST(UniqueRunsTest, EqualRunsHaveOneNumber) {
  UniqueRuns<State, State> runs;
  EXPECT_EQ(runs.add(states({1, 2})), State{0});
  EXPECT_EQ(runs.add(states({})), State{1});
  EXPECT_EQ(runs.add(states({2, 1})), State{2});
  EXPECT_EQ(runs.add(states({1, 2})), State{0});
  EXPECT_EQ(runs.add(states({1})), State{3});
  EXPECT_EQ(runs.add(states({})), State{1});
  EXPECT_EQ(runs.size(), 4U);
}

TEST(UniqueRunsTest, WordsDifferInTheirUpperHalves) {
  UniqueRuns<State, std::uint64_t> runs;
  const std::uint64_t high = std::uint64_t{1} << 63U;
  EXPECT_EQ(runs.add(std::vector<std::uint64_t>{1, 2}), State{0});
  EXPECT_EQ(runs.add(std::vector<std::uint64_t>{high | 1, 2}), State{1});
  EXPECT_EQ(runs.add(std::vector<std::uint64_t>{1, high | 2}), State{2});
  EXPECT_EQ(runs.add(std::vector<std::uint64_t>{1, 2}), State{0});
  EXPECT_EQ(runs.size(), 3U);
}

TEST(UniqueRunsTest, RefusesOneTooMany) {
  UniqueRuns<State, State> runs;
  EXPECT_EQ(runs.add(states({1}), 2), State{0});
  EXPECT_EQ(runs.add(states({2}), 2), State{1});
  EXPECT_EQ(runs.add(states({1}), 2), State{0});
  EXPECT_TRUE(runs.add(states({3}), 2).is_none());
  EXPECT_EQ(runs.size(), 2U);
}

TEST(UniqueRunsTest, ManyRuns) {
  UniqueRuns<State, State> runs;
  for (const bool again : {false, true}) {
    for (std::uint32_t i = 0; i < 20'000; ++i) {
      // Runs of one to three elements, all distinct.
      std::vector<State> run = states({i});
      for (std::uint32_t j = 0; j < i % 3; ++j) run.push_back(State{i + j});
      ASSERT_EQ(runs.add(run), State{i}) << again;
    }
  }
  EXPECT_EQ(runs.size(), 20'000U);
}

}  // namespace
}  // namespace perentie::lts

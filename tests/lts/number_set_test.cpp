// NumberSet: numbers come out in order, each once.
#include "number_set.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>

namespace perentie::lts {
namespace {

TEST(NumberSetTest, IsEmptyAtFirst) {
  EXPECT_TRUE(NumberSet(0).empty());
  EXPECT_TRUE(NumberSet(1'000).empty());
}

TEST(NumberSetTest, GivesTheLeastOfAnyBound) {
  for (const std::uint32_t bound : {1U, 63U, 64U, 65U, 4'096U, 4'097U, 300'000U}) {
    NumberSet numbers(bound);
    numbers.insert(bound - 1);
    numbers.insert(bound / 2);
    numbers.insert(bound / 2);
    EXPECT_EQ(numbers.take_least(), bound / 2);
    if (bound / 2 != bound - 1) {
      EXPECT_FALSE(numbers.empty());
      EXPECT_EQ(numbers.take_least(), bound - 1);
    }
    EXPECT_TRUE(numbers.empty()) << bound;
  }
}

TEST(NumberSetTest, IsASetWhateverTheOrder) {
  constexpr std::uint32_t bound = 20'000;
  std::mt19937 random(1);
  NumberSet numbers(bound);
  std::set<std::uint32_t> expected;
  for (int i = 0; i < 100'000; ++i) {
    if (random() % 2 == 0 || expected.empty()) {
      const auto number = static_cast<std::uint32_t>(random() % bound);
      numbers.insert(number);
      expected.insert(number);
    } else {
      ASSERT_EQ(numbers.take_least(), *expected.begin());
      expected.erase(expected.begin());
    }
    ASSERT_EQ(numbers.empty(), expected.empty());
  }
}

}  // namespace
}  // namespace perentie::lts

#include "perentie/base/growing_array.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace perentie::base {
namespace {

TEST(GrowingArrayTest, KeepsItsElementsWhileItGrows) {
  // Beyond the size from which blocks are huge.
  constexpr std::uint32_t count = 3'000'000;
  GrowingArray<std::uint32_t> array;
  for (std::uint32_t i = 0; i < count; ++i) array.push_back(i);
  ASSERT_EQ(array.size(), count);
  for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(array[i], i);
}

TEST(GrowingArrayTest, AppendsItsOwnElements) {
  GrowingArray<std::uint64_t> array;
  array.push_back(7);
  for (int i = 0; i < 1'000; ++i) array.push_back(array[0]);
  EXPECT_EQ(std::accumulate(array.begin(), array.end(), std::uint64_t{0}), 7'007U);
}

TEST(GrowingArrayTest, ResizesWithAValueAndShrinks) {
  GrowingArray<int> array;
  array.resize(3, 5);
  array.resize(5, 6);
  EXPECT_EQ(std::vector<int>(array.begin(), array.end()), (std::vector<int>{5, 5, 5, 6, 6}));
  array.resize(1);
  array.resize(2, 9);
  EXPECT_EQ(std::vector<int>(array.begin(), array.end()), (std::vector<int>{5, 9}));
}

TEST(GrowingArrayTest, CopiesAndMoves) {
  GrowingArray<int> array;
  array.resize(4, 1);
  GrowingArray<int> copy(array);
  copy[0] = 2;
  EXPECT_EQ(array[0], 1);
  const GrowingArray<int> moved(std::move(copy));
  EXPECT_EQ(moved[0], 2);
  EXPECT_EQ(moved.size(), 4U);
  array = moved;
  EXPECT_EQ(array[0], 2);
  array = {};
  EXPECT_TRUE(array.empty());
  EXPECT_EQ(array.begin(), array.end());
}

TEST(GrowingArrayTest, GrowsWithAnElementOfItsOwn) {
  for (std::size_t size = 1; size < 5'000; size = size * 2 + 1) {
    GrowingArray<std::uint64_t> array;
    for (std::size_t i = 0; i < size; ++i) array.push_back(i + 7);
    array.resize(20 * array.capacity() + 1, array.back());  // the block moves
    EXPECT_EQ(array[array.size() - 1], size + 6);
    array.push_back(array[0]);
    EXPECT_EQ(array.back(), 7U);
  }
}

}  // namespace
}  // namespace perentie::base

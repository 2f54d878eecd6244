// The forecasts of memory against what containers then really hold.
#include <gtest/gtest.h>

#include <vector>

#include "perentie/base/hash.hpp"
#include "perentie/lts/memory.hpp"

namespace perentie::lts {
namespace {

TEST(MemoryTest, AVectorWithRoomTakesWhatItTakes) {
  std::vector<std::uint64_t> vector;
  vector.reserve(10);
  vector.assign(4, 0);
  EXPECT_EQ(peak_bytes(vector, 0), 4U * 8);
  EXPECT_EQ(peak_bytes(vector, 6), 10U * 8);
}

TEST(MemoryTest, AVectorThatMovesHoldsBothBlocks) {
  std::vector<std::uint64_t> vector;
  vector.reserve(10);
  vector.assign(4, 0);
  EXPECT_EQ(peak_bytes(vector, 7), (4U + 11U) * 8);
}

TEST(MemoryTest, ATableIsForecastExactly) {
  base::UniqueIndex index;
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    const std::uint64_t forecast = peak_bytes(index, 1);
    index.find_or_insert(
        base::hash_mix(0, i), i, [](std::uint32_t) { return false; },
        [](std::uint32_t other) { return base::hash_mix(0, other); });
    ASSERT_EQ(index.memory_bytes(), i == 0 ? 64 * sizeof(std::uint32_t) : forecast) << i;
  }
}

}  // namespace
}  // namespace perentie::lts

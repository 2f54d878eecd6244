// The forecasts of memory against what containers then really hold.
#include <gtest/gtest.h>

#include <vector>

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

}  // namespace
}  // namespace perentie::lts

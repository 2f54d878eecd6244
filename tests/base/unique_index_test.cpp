// UniqueIndex: one index for each element, whatever their hashes are, and no more memory than is
// forecast.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "perentie/base/hash.hpp"
#include "perentie/base/unique_index.hpp"

namespace perentie::base {
namespace {

/// Elements are numbers.
struct Numbers {
  UniqueIndex index;
  std::vector<std::uint64_t> elements;

  UniqueIndex::Result add(std::uint64_t element, std::uint64_t hash) {
    const auto result =
        index.find_or_insert(hash, static_cast<std::uint32_t>(elements.size()),
                             [&](std::uint32_t i) { return elements[i] == element; });
    if (result.inserted) elements.push_back(element);
    return result;
  }
};

TEST(UniqueIndexTest, FindsWhatWasInserted) {
  Numbers numbers;
  for (std::uint64_t n = 0; n < 10'000; ++n) EXPECT_TRUE(numbers.add(n, hash_mix(0, n)).inserted);
  for (std::uint64_t n = 0; n < 10'000; ++n) {
    const auto found = numbers.add(n, hash_mix(0, n));
    EXPECT_FALSE(found.inserted);
    EXPECT_EQ(found.index, n);
  }
  EXPECT_EQ(numbers.index.size(), 10'000U);
}

TEST(UniqueIndexTest, ElementsWithOneHashAreDifferent) {
  Numbers numbers;
  for (std::uint64_t n = 0; n < 300; ++n) EXPECT_TRUE(numbers.add(n, 7).inserted);
  for (std::uint64_t n = 0; n < 300; ++n) EXPECT_EQ(numbers.add(n, 7).index, n);
}

TEST(UniqueIndexTest, ElementsWithHalfAHashInCommonAreDifferent) {
  Numbers numbers;
  for (std::uint64_t n = 0; n < 300; ++n) EXPECT_TRUE(numbers.add(n, n << 32U | 5U).inserted);
  for (std::uint64_t n = 0; n < 300; ++n) EXPECT_EQ(numbers.add(n, n << 32U | 5U).index, n);
}

TEST(UniqueIndexTest, MemoryIsForecast) {
  Numbers numbers;
  for (std::uint64_t n = 0; n < 10'000; ++n) {
    const std::size_t before = numbers.index.memory_bytes();
    const std::uint64_t forecast = numbers.index.peak_bytes(1);
    numbers.add(n, hash_mix(0, n));
    const std::size_t after = numbers.index.memory_bytes();
    ASSERT_GE(forecast, after == before ? after : before + after) << n;
    ASSERT_LE(forecast, 2 * after) << n;
  }
}

}  // namespace
}  // namespace perentie::base

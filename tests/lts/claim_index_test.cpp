// ClaimIndex: the least claim stays, whoever comes first.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "perentie/base/hash.hpp"
#include "perentie/lts/claim_index.hpp"

namespace perentie::lts {
namespace {

std::uint64_t no_hash(std::size_t) { return 0; }

TEST(ClaimIndexTest, TheLeastClaimStays) {
  Workers alone(1);
  ClaimIndex index;
  index.reserve(10, 0, no_hash, alone);
  const auto same = [](std::uint32_t) { return true; };
  const std::size_t place = index.claim(5, 7, same);
  EXPECT_EQ(index.number(place), 7U);
  EXPECT_EQ(index.claim(5, 9, same), place);
  EXPECT_EQ(index.number(place), 7U);
  EXPECT_EQ(index.claim(5, 3, same), place);
  EXPECT_EQ(index.number(place), 3U);
  index.set_number(place, 4);
  EXPECT_EQ(index.number(place), 4U);
}

TEST(ClaimIndexTest, EqualHashesAreNotEqualElements) {
  Workers alone(1);
  ClaimIndex index;
  index.reserve(10, 0, no_hash, alone);
  for (std::uint32_t n = 0; n < 10; ++n) {
    index.claim(0, n, [](std::uint32_t) { return false; });
  }
  for (std::uint32_t n = 0; n < 10; ++n) {
    const auto place = index.claim(0, 99, [n](std::uint32_t other) { return other == n; });
    EXPECT_EQ(index.number(place), n);
  }
}

// Element e is claimed with the numbers n for which n % elements == e, by all workers at once.
TEST(ClaimIndexTest, WorkersClaimTogether) {
  constexpr std::uint32_t elements = 5'000;
  constexpr std::uint32_t claims = 40'000;
  for (const unsigned count : {1U, 2U, 4U}) {
    Workers workers(count);
    ClaimIndex index;
    index.reserve(elements, 0, no_hash, workers);
    const auto claim = [&](std::uint32_t number) {
      const std::uint32_t element = number % elements;
      return index.claim(base::hash_mix(0, element), number,
                         [&](std::uint32_t other) { return other % elements == element; });
    };
    workers.run([&](unsigned worker) {
      for (std::uint32_t i = worker; i < claims; i += count) claim(claims - 1 - i);
    });
    for (std::uint32_t e = 0; e < elements; ++e) ASSERT_EQ(index.number(claim(claims + e)), e);

    // The table grows and keeps them.
    index.reserve(
        100 * elements, elements, [](std::size_t e) { return base::hash_mix(0, e); }, workers);
    for (std::uint32_t e = 0; e < elements; ++e) ASSERT_EQ(index.number(claim(claims + e)), e);
    EXPECT_EQ(index.bytes_for(0), index.bytes_for(100 * elements));
  }
}

}  // namespace
}  // namespace perentie::lts

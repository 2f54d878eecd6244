#include "perentie/lts/strong_components.hpp"

#include <gtest/gtest.h>

namespace perentie::lts {
namespace {

using Components = std::vector<std::vector<std::uint32_t>>;

TEST(StrongComponentsTest, OfNothingThereAreNone) {
  EXPECT_EQ(strong_components({}), Components{});
}

TEST(StrongComponentsTest, ComeAfterWhatTheyLeadTo) {
  EXPECT_EQ(strong_components({{1}, {2}, {}}), (Components{{2}, {1}, {0}}));
}

TEST(StrongComponentsTest, HoldTheVerticesOfACycleInOrder) {
  EXPECT_EQ(strong_components({{3}, {0, 4}, {1}, {2, 3}, {}}), (Components{{4}, {0, 1, 2, 3}}));
}

TEST(StrongComponentsTest, AreFoundInALongChain) {
  constexpr std::uint32_t size = 200'000;
  std::vector<std::vector<std::uint32_t>> successors(size);
  for (std::uint32_t v = 0; v + 1 < size; ++v) successors[v] = {v + 1};
  EXPECT_EQ(strong_components(successors).size(), size);
}

}  // namespace
}  // namespace perentie::lts

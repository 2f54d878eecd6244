// Counting: the numbers of an exploration, without its edges.
#include <gtest/gtest.h>

#include <cstdint>

#include "perentie/lts/count.hpp"
#include "perentie/lts/lts_system.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;

TEST(CountTest, CountsWhatExplorationFinds) {
  const Lts graph = lts_from("0 a 1; 0 b 2; 1 a 3; 2 b 3; 2 tau 0; 3 a 3; 4 a 0");
  LtsSystem system(graph);
  const Count found = count(system);
  const auto explored = explore(system);
  EXPECT_TRUE(found.complete());
  EXPECT_EQ(found.states, 4U);
  EXPECT_EQ(found.states, explored.states.size());
  EXPECT_EQ(found.transitions, 6U);
  EXPECT_EQ(found.transitions, explored.transitions_fired);
  EXPECT_EQ(found.plies, 3U);
}

// A chain without an end.
struct Endless {
  using State = std::uint32_t;
  std::uint32_t fail_at = 0xFFFF'FFFFU;

  State initial() const { return 0; }
  bool successors(State s, std::vector<Transition<State>>& out) const {
    if (s == fail_at) return false;
    out.push_back({tau, s + 1});
    return true;
  }
  std::uint64_t state_hash(State s) const { return s; }
  std::shared_ptr<const LabelNames> label_names() const { return {}; }
};

TEST(CountTest, EndsAtALimitWithWhatIsKnown) {
  Endless system;
  const Count found = count(system, {.limits = {.max_states = 1'000}});
  EXPECT_FALSE(found.complete());
  EXPECT_EQ(found.states, 1'000U);
  EXPECT_EQ(found.expanded, 999U);
  ASSERT_TRUE(found.limit);
  EXPECT_EQ(found.limit->kind, base::LimitKind::states);
}

TEST(CountTest, EndsAtAMemoryLimit) {
  Endless system;
  const Count found = count(system, {.limits = {.max_memory_bytes = 1'000'000}});
  ASSERT_TRUE(found.limit);
  EXPECT_EQ(found.limit->kind, base::LimitKind::memory);
  EXPECT_LE(found.bytes, 1'000'000U);
  EXPECT_GT(found.states, 10'000U);
}

TEST(CountTest, EndsWhereSuccessorsFail) {
  Endless system{.fail_at = 10};
  const Count found = count(system);
  EXPECT_TRUE(found.failed);
  EXPECT_FALSE(found.complete());
  EXPECT_EQ(found.expanded, 10U);
}

}  // namespace
}  // namespace perentie::lts

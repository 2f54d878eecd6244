// The watch looks at once, then about every millisecond, however long a unit of work takes.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "perentie/lts/watch.hpp"

namespace perentie::lts {
namespace {

TEST(WatchTest, LooksAtTheFirstUnit) {
  const std::atomic<bool> cancelled = true;
  Watch watch({.cancelled = &cancelled});
  ASSERT_TRUE(watch.due());
  ASSERT_TRUE(watch.look());
  EXPECT_EQ(watch.look()->kind, base::LimitKind::cancelled);
}

TEST(WatchTest, SeldomLooksDuringFastWork) {
  Watch watch({});
  std::uint64_t looks = 0;
  constexpr std::uint64_t units = 10'000'000;
  for (std::uint64_t i = 0; i < units; ++i) {
    if (watch.due()) {
      ++looks;
      EXPECT_FALSE(watch.look());
    }
  }
  EXPECT_GT(looks, units >> 17U);
  EXPECT_LT(looks, units / 1000);
}

TEST(WatchTest, LooksAtEveryUnitOfSlowWork) {
  Watch watch({});
  // Fast work first: the spacing must come back from it.
  for (int i = 0; i < 100; ++i) {
    if (watch.due()) watch.look();
  }
  int looks = 0;
  for (int i = 0; i < 100; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    if (!watch.due()) continue;
    ++looks;
    watch.look();
  }
  EXPECT_GT(looks, 30);
}

TEST(WatchTest, ReportsAreDueNowAndThen) {
  Watch watch({});
  watch.look();
  EXPECT_FALSE(watch.report_due());
  std::this_thread::sleep_for(std::chrono::milliseconds(120));
  EXPECT_FALSE(watch.report_due()) << "the clock was not looked at";
  watch.look();
  EXPECT_TRUE(watch.report_due());
  EXPECT_FALSE(watch.report_due());
}

TEST(WatchTest, ReportsTheTimeLimit) {
  Watch watch({.timeout = std::chrono::milliseconds(5)});
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const auto limit = watch.look();
  ASSERT_TRUE(limit);
  EXPECT_EQ(limit->kind, base::LimitKind::time);
  EXPECT_EQ(limit->limit, 5U);
}

}  // namespace
}  // namespace perentie::lts

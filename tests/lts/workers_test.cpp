// Workers: every part is done, on as many threads as are asked for, and failures come out.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "perentie/lts/workers.hpp"

namespace perentie::lts {
namespace {

TEST(WorkersTest, EachDoesItsPartOfEachTask) {
  for (const unsigned count : {1U, 2U, 5U}) {
    Workers workers(count);
    std::vector<int> done(count, 0);
    for (int task = 0; task < 1'000; ++task) {
      workers.run([&](unsigned worker) { ++done[worker]; });
    }
    EXPECT_EQ(done, std::vector<int>(count, 1'000)) << count;
  }
}

TEST(WorkersTest, TheFirstIsTheCallerAndTheOthersAreNot) {
  Workers workers(3);
  std::vector<std::thread::id> ids(3);
  workers.run([&](unsigned worker) { ids[worker] = std::this_thread::get_id(); });
  EXPECT_EQ(ids[0], std::this_thread::get_id());
  EXPECT_EQ(std::set<std::thread::id>(ids.begin(), ids.end()).size(), 3U);
}

TEST(WorkersTest, WhatOneDidBeforeATaskAllSeeInIt) {
  Workers workers(4);
  std::vector<int> values(4, 0);
  for (int task = 0; task < 1'000; ++task) {
    workers.run([&](unsigned worker) { values[worker] = task; });
    std::atomic<int> right = 0;
    workers.run([&](unsigned worker) { right += values[(worker + 1) % 4] == task ? 1 : 0; });
    ASSERT_EQ(right, 4);
  }
}

TEST(WorkersTest, AnExceptionComesOutWhenAllHaveEnded) {
  Workers workers(3);
  std::atomic<int> ended = 0;
  const auto task = [&](unsigned worker) {
    ++ended;
    if (worker == 2) throw std::runtime_error("part 2");
  };
  EXPECT_THROW(workers.run(task), std::runtime_error);
  EXPECT_EQ(ended, 3);
  workers.run([&](unsigned) { ++ended; });
  EXPECT_EQ(ended, 6) << "they go on";
}

// What the system gives no thread for is done all the same: a block that lacked a part would be
// taken for a whole one.
TEST(WorkersTest, PartsWithoutAThreadAreDoneByTheCaller) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers do not live with little address space";
#endif
  constexpr unsigned count = 64;
  constexpr rlim_t room = rlim_t{64} << 20U;  // for a few stacks
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  rlimit little = before;
  little.rlim_cur = pages * static_cast<std::size_t>(getpagesize()) + room;
  std::vector<int> done(count, 0);
  std::vector<std::thread::id> ids(count);
  Workers workers(count);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &little), 0);
  for (int task = 0; task < 10; ++task) {
    workers.run([&](unsigned worker) {
      ++done[worker];
      ids[worker] = std::this_thread::get_id();
    });
  }
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_EQ(done, std::vector<int>(count, 10));
  EXPECT_EQ(workers.count(), count);
  if (std::ranges::count(ids, std::this_thread::get_id()) == 1) {
    GTEST_SKIP() << "the system gave all threads";
  }
}

TEST(WorkersTest, NoneIsOne) {
  Workers workers(0);
  EXPECT_EQ(workers.count(), 1U);
  int calls = 0;
  workers.run([&](unsigned) { ++calls; });
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace perentie::lts

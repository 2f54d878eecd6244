// Workers: every part is done, on as many threads as are asked for, and failures come out.
#include <gtest/gtest.h>

#include <atomic>
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

TEST(WorkersTest, NoneIsOne) {
  Workers workers(0);
  EXPECT_EQ(workers.count(), 1U);
  int calls = 0;
  workers.run([&](unsigned) { ++calls; });
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace perentie::lts

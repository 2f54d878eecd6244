#include "perentie/lts/watchdogs.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

const std::vector<std::string> alphabet{"a", "b", "c", "bark"};

std::string watchdog(WatchdogResult (*make)(const Lts&, std::span<const Label>, Label,
                                            const base::Limits&),
                     std::string_view text, const std::string& events) {
  const Lts lts = test::lts_from(text, alphabet);
  const auto result =
      make(lts, test::labels_from(lts, events), *lts.find_label("bark"), base::Limits{});
  return test::to_text(std::get<Lts>(result));
}

// CSPM reference 4.6.2.
TEST(TraceWatchdogTest, TheExampleOfTheReference) {
  EXPECT_EQ(watchdog(trace_watchdog, "0 a 1; 1", "a b"), "0 a 1; 0 b 2; 1 a 2; 1 b 2; 2 bark 3; 3");
}

TEST(TraceWatchdogTest, OfNondeterminismOnlyTheTracesCount) {
  EXPECT_EQ(watchdog(trace_watchdog, "0 tau 1; 0 tau 2; 1 a 0; 2", "a b"),
            "0 a 0; 0 b 1; 1 bark 2; 2");
}

TEST(TraceWatchdogTest, TickIsKeptAndEndsIt) {
  EXPECT_EQ(watchdog(trace_watchdog, "0 a 0; 0 tick 1; 1", "a"), "0 ✓ 2; 0 a 0; 1 a 3; 2; 3 bark 2")
      << "state 1 is what ✓ led to, and nothing leads there any more";
}

TEST(FailureWatchdogTest, OffersTheLeastThatMustBeAccepted) {
  // Either a must be accepted, or b: who refuses both is held up.
  EXPECT_EQ(watchdog(failure_watchdog, "0 tau 1; 0 tau 2; 1 a 0; 2 b 0", "a b"),
            "0 τ 1; 0 a 0; 0 b 0; 1 a 0; 1 b 0");
  // Both must be accepted: who refuses one of them is held up.
  EXPECT_EQ(watchdog(failure_watchdog, "0 a 0; 0 b 0", "a b"),
            "0 τ 1; 0 τ 2; 0 a 0; 0 b 0; 1 a 0; 2 b 0");
}

TEST(FailureWatchdogTest, WhereDeadlockIsAllowedItNeverWaits) {
  EXPECT_EQ(watchdog(failure_watchdog, "0", "a"), "0 τ 0; 0 a 1; 1 bark 2; 2");
}

TEST(FailureWatchdogTest, WhatCannotBeStableIsHeldUp) {
  EXPECT_EQ(watchdog(failure_watchdog, "0 tau 0", "a"), "0 τ 3; 0 a 1; 1 bark 2; 2; 3");
}

// Of n pairs of events there are 2^n minimal hitting sets.
TEST(FailureWatchdogTest, TooManyHittingSetsAreALimit) {
  std::vector<std::string> names{"bark"};
  std::string text;
  for (int i = 0; i < 40; ++i) {
    const std::string n = std::to_string(i);
    text += "; 0 tau " + std::to_string(i + 1) + "; " + std::to_string(i + 1) + " x" + n + " 0; " +
            std::to_string(i + 1) + " y" + n + " 0";
  }
  const Lts lts = test::lts_from(text.substr(2), names);
  const auto limit = [&](const base::Limits& limits) {
    const auto result = failure_watchdog(lts, {}, *lts.find_label("bark"), limits);
    EXPECT_TRUE(std::holds_alternative<base::LimitReached>(result));
    return std::get<base::LimitReached>(result);
  };
  EXPECT_EQ(limit({.max_states = 1'000}).limit, 1'000U);
  EXPECT_EQ(limit({}).kind, base::LimitKind::states);
  const std::atomic<bool> cancelled{true};
  EXPECT_EQ(limit({.cancelled = &cancelled}).kind, base::LimitKind::cancelled);
}

}  // namespace
}  // namespace perentie::lts

// Exploration: numbering, counts, and every way to end early with a usable result.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "perentie/base/hash.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/lts/lts_system.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;
using test::to_text;

/// Two counters: `a` counts one up, `b` the other, both below a bound; labels are created on the
/// way.
struct Counters {
  struct State {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    friend bool operator==(const State&, const State&) = default;
  };

  std::uint32_t bound = 1;
  std::uint32_t fail_at = 1'000'000'000;  // the value of `a` whose successors cannot be computed
  std::uint64_t own_bytes = 0;
  std::vector<std::string> names{std::string(tau_name), std::string(tick_name)};

  Label label(const std::string& name) {
    for (std::uint32_t i = 0; i < names.size(); ++i) {
      if (names[i] == name) return Label{i};
    }
    names.push_back(name);
    return Label{static_cast<std::uint32_t>(names.size() - 1)};
  }

  State initial() const { return {}; }
  bool successors(const State& s, std::vector<Transition<State>>& out) {
    if (s.a == fail_at) return false;
    if (s.a < bound) out.push_back({label("a"), {s.a + 1, s.b}});
    if (s.b < bound) out.push_back({label("b"), {s.a, s.b + 1}});
    return true;
  }
  std::uint64_t state_hash(const State& s) const { return base::hash_mix(s.a, s.b); }
  std::uint64_t memory_bytes() const { return own_bytes; }
  std::shared_ptr<const LabelNames> label_names() const {
    return std::make_shared<const LabelNames>(names);
  }
};
static_assert(TransitionSystem<Counters>);
static_assert(TransitionSystem<LtsSystem>);

TEST(ExploreTest, NumbersStatesBreadthFirst) {
  Counters system;
  const auto result = explore(system);
  EXPECT_EQ(to_text(result.lts), "0 a 1; 0 b 2; 1 b 3; 2 a 3; 3");
  EXPECT_TRUE(result.complete());
  EXPECT_FALSE(result.failed);
  EXPECT_FALSE(result.limit);
  EXPECT_EQ(result.expanded, 4U);
  EXPECT_EQ(result.transitions_fired, 4U);
  EXPECT_EQ(result.states[2], (Counters::State{0, 1}));
}

TEST(ExploreTest, CountsFiringsBesideEdges) {
  struct Twice : LtsSystem {
    using LtsSystem::LtsSystem;
    bool successors(State s, std::vector<Transition<State>>& out) const {
      return LtsSystem::successors(s, out) && LtsSystem::successors(s, out);
    }
  };
  const Lts lts = lts_from("0 a 1; 1 b 0; 1 b 1");
  Twice system(lts);
  const auto result = explore(system);
  EXPECT_EQ(to_text(result.lts), to_text(lts));
  EXPECT_EQ(result.transitions_fired, 6U);
}

TEST(ExploreTest, LeavesOutWhatCannotBeReached) {
  const Lts lts = lts_from("-> 3; 0 a 1; 3 b 2; 3 a 5; 2 tau 2; 4 tick 3; 5 tick 1");
  LtsSystem system(lts);
  const auto result = explore(system);
  EXPECT_EQ(to_text(result.lts), "0 a 1; 0 b 2; 1 ✓ 3; 2 τ 2; 3");
  EXPECT_EQ(result.states, (std::vector<State>{State{3}, State{5}, State{2}, State{1}}));
}

TEST(ExploreTest, OneStateIsEnough) {
  Counters system{.bound = 0};
  const auto result = explore(system);
  EXPECT_EQ(to_text(result.lts), "0");
  EXPECT_TRUE(result.complete());
}

TEST(ExploreTest, StateLimitKeepsTheExpandedPart) {
  Counters system{.bound = 100};
  for (const std::uint64_t max_states : {1U, 2U, 3U, 4U, 50U}) {
    const auto result = explore(system, {.limits = {.max_states = max_states}});
    ASSERT_TRUE(result.limit) << max_states;
    EXPECT_EQ(result.limit->kind, base::LimitKind::states);
    EXPECT_EQ(result.limit->limit, max_states);
    EXPECT_EQ(result.states.size(), max_states);
    EXPECT_EQ(result.lts.state_count(), max_states);
    EXPECT_LT(result.expanded, max_states);
    EXPECT_FALSE(result.complete());
    for (std::uint32_t s = 0; s < max_states; ++s) {
      EXPECT_EQ(result.lts.edges(State{s}).size(), s < result.expanded ? 2U : 0U);
    }
  }
}

TEST(ExploreTest, StateLimitEqualToTheNumberOfStatesIsNotReached) {
  Counters system{.bound = 2};
  EXPECT_TRUE(explore(system, {.limits = {.max_states = 9}}).complete());
  EXPECT_TRUE(explore(system, {.limits = {.max_states = 8}}).limit.has_value());
}

TEST(ExploreTest, MemoryLimitIsKept) {
  Counters system{.bound = 1000};
  constexpr std::uint64_t limit = 1'000'000;
  std::uint64_t largest_report = 0;
  ExploreOptions options{.limits = {.max_memory_bytes = limit}};
  options.progress = [&](const ExploreProgress& p) {
    largest_report = std::max(largest_report, p.bytes);
  };
  const auto result = explore(system, options);
  ASSERT_TRUE(result.limit);
  EXPECT_EQ(result.limit->kind, base::LimitKind::memory);
  EXPECT_LE(largest_report, limit);
  EXPECT_GT(result.states.size(), 10'000U);
  EXPECT_LE(result.states.size() * sizeof(Counters::State) + result.lts.edge_count() * sizeof(Edge),
            limit);

  system.own_bytes = limit;
  EXPECT_EQ(explore(system, options).expanded, 0U) << "the system's own memory counts";
}

TEST(ExploreTest, TimeLimitEndsEarly) {
  Counters system{.bound = 1'000'000};
  const auto begin = std::chrono::steady_clock::now();
  const auto result = explore(system, {.limits = {.timeout = std::chrono::milliseconds(30)}});
  const auto elapsed = std::chrono::steady_clock::now() - begin;
  ASSERT_TRUE(result.limit);
  EXPECT_EQ(result.limit->kind, base::LimitKind::time);
  EXPECT_EQ(result.limit->limit, 30U);
  EXPECT_GT(result.expanded, 0U);
  EXPECT_LT(elapsed, std::chrono::seconds(5));
}

TEST(ExploreTest, CancellationEndsEarlyEvenWhenStatesAreSlow) {
  struct Slow : Counters {
    bool successors(const State& s, std::vector<Transition<State>>& out) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      ++calls;
      if (calls == 3) *cancel = true;
      return Counters::successors(s, out);
    }
    std::atomic<bool>* cancel = nullptr;
    int calls = 0;
  };
  std::atomic<bool> cancelled = false;
  Slow system;
  system.bound = 1000;
  system.cancel = &cancelled;
  const auto result = explore(system, {.limits = {.cancelled = &cancelled}});
  ASSERT_TRUE(result.limit);
  EXPECT_EQ(result.limit->kind, base::LimitKind::cancelled);
  EXPECT_LE(system.calls, 6) << "the flag was looked at too seldom";
  EXPECT_EQ(result.expanded, static_cast<std::size_t>(system.calls));
}

TEST(ExploreTest, FailureKeepsWhatIsKnown) {
  Counters system{.bound = 5, .fail_at = 2};
  const auto result = explore(system);
  EXPECT_TRUE(result.failed);
  EXPECT_FALSE(result.limit);
  EXPECT_EQ(result.expanded, 3U);
  EXPECT_EQ(result.states.size(), 6U);
  EXPECT_EQ(to_text(result.lts), "0 a 1; 0 b 2; 1 a 3; 1 b 4; 2 a 4; 2 b 5; 3; 4; 5");
}

TEST(ExploreTest, TransitionsBeforeAFailureDoNotCount) {
  struct Partial : Counters {
    bool successors(const State& s, std::vector<Transition<State>>& out) {
      return Counters::successors(s, out) && s.a != 1;
    }
  };
  Partial system;
  system.bound = 2;
  const auto result = explore(system);
  EXPECT_TRUE(result.failed);
  EXPECT_EQ(result.expanded, 1U);
  EXPECT_EQ(to_text(result.lts), "0 a 1; 0 b 2; 1; 2");
}

TEST(ExploreTest, ReportsProgressAtItsLeisure) {
  struct Slow : Counters {
    bool successors(const State& s, std::vector<Transition<State>>& out) {
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
      return Counters::successors(s, out);
    }
  };
  Slow system;
  system.bound = 9;
  std::vector<ExploreProgress> reports;
  ExploreOptions options;
  options.progress = [&](const ExploreProgress& p) { reports.push_back(p); };
  const auto result = explore(system, options);
  ASSERT_FALSE(reports.empty());
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const ExploreProgress& p = reports[i];
    EXPECT_LE(p.states, result.states.size());
    EXPECT_LE(p.frontier, p.states);
    ASSERT_LT(p.states - p.frontier, result.states.size());
    const Counters::State& next = result.states[p.states - p.frontier];
    EXPECT_EQ(p.ply, next.a + next.b);
    EXPECT_GT(p.bytes, 0U);
    EXPECT_GE(p.seconds, i == 0 ? 0.1 : reports[i - 1].seconds + 0.1);
  }
}

TEST(ExploreTest, AChainOfAMillionStates) {
  struct Chain {
    using State = std::uint32_t;
    State initial() const { return 0; }
    bool successors(State s, std::vector<Transition<State>>& out) const {
      if (s + 1 < 1'000'000) out.push_back({tau, s + 1});
      return true;
    }
    std::uint64_t state_hash(State s) const { return base::hash_mix(0, s); }
    std::shared_ptr<const LabelNames> label_names() const {
      return std::make_shared<const LabelNames>(
          LabelNames{std::string(tau_name), std::string(tick_name)});
    }
  };
  Chain system;
  const auto result = explore(system);
  EXPECT_EQ(result.lts.state_count(), 1'000'000U);
  EXPECT_EQ(result.lts.edge_count(), 999'999U);
}

}  // namespace
}  // namespace perentie::lts

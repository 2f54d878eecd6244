// The normal form on hand-made graphs: τ-closure, nondeterminism, ✓, divergence, acceptances,
// limits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>

#include "perentie/lts/normalise.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;
using test::to_text;

NormalLts normal(const Lts& lts) {
  Normalisation result = normalise(lts, {.acceptances = true});
  EXPECT_TRUE(result.complete());
  EXPECT_FALSE(result.limit);
  return std::move(result.normal);
}

std::string members(const NormalLts& normal, std::uint32_t node) {
  std::string text;
  for (const State s : normal.members[node]) text += std::to_string(s.value) + " ";
  return text;
}

/// Such as "{a ✓} {b}"; the sets in no particular order.
std::vector<std::string> acceptances(const NormalLts& normal, std::uint32_t node) {
  std::vector<std::string> sets;
  for (const AcceptanceId id : normal.acceptances->of(State{node})) {
    const auto labels = normal.acceptances->labels(id);
    sets.push_back(fmt::format("{{{}}}", to_text(normal.lts, {labels.begin(), labels.end()})));
  }
  std::sort(sets.begin(), sets.end());
  return sets;
}

using Sets = std::vector<std::string>;

TEST(NormaliseTest, StopIsItsOwnNormalForm) {
  const NormalLts n = normal(lts_from("0"));
  EXPECT_EQ(to_text(n.lts), "0");
  EXPECT_EQ(members(n, 0), "0 ");
  EXPECT_EQ(acceptances(n, 0), Sets{"{}"});
  EXPECT_FALSE(n.divergent[0]);
}

TEST(NormaliseTest, TheManualsExample) {
  // CSPM reference 4.7.7: P = a -> P |~| a -> STOP.
  const NormalLts n = normal(lts_from("0 tau 1; 0 tau 2; 1 a 0; 2 a 3"));
  EXPECT_EQ(to_text(n.lts), "0 a 1; 1 a 1");
  EXPECT_EQ(members(n, 0), "0 1 2 ");
  EXPECT_EQ(members(n, 1), "0 1 2 3 ");
  EXPECT_EQ(acceptances(n, 0), Sets{"{a}"});
  EXPECT_EQ(acceptances(n, 1), Sets{"{}"}) << "{a} is not minimal";
}

TEST(NormaliseTest, IncomparableAcceptancesAllStay) {
  const NormalLts n =
      normal(lts_from("0 tau 1; 0 tau 2; 0 tau 3; 0 d 4; 1 a 4; 1 b 4; 2 b 4; 2 tick 4; 3 a 4; "
                      "3 b 4; 3 c 4"));
  EXPECT_EQ(acceptances(n, 0), (Sets{"{a b}", "{✓ b}"}));
  EXPECT_EQ(to_text(n.lts), "0 ✓ 1; 0 a 1; 0 b 1; 0 c 1; 0 d 1; 1");
}

TEST(NormaliseTest, TickIsAnOrdinaryLabel) {
  // Two ways to end of which one goes on: nondeterminism only after ✓.
  const NormalLts n = normal(lts_from("0 tick 1; 0 tick 2; 2 a 2"));
  EXPECT_EQ(to_text(n.lts), "0 ✓ 1; 1 a 2; 2 a 2");
  EXPECT_EQ(members(n, 1), "1 2 ");
  EXPECT_EQ(acceptances(n, 0), Sets{"{✓}"});
  EXPECT_EQ(acceptances(n, 1), Sets{"{}"});
}

TEST(NormaliseTest, UnstableStatesHaveNoAcceptance) {
  // P [> Q: the a of P can be refused.
  const NormalLts timeout = normal(lts_from("0 a 1; 0 tau 2; 2 b 1"));
  EXPECT_EQ(acceptances(timeout, 0), Sets{"{b}"});
  EXPECT_EQ(to_text(timeout.lts), "0 a 1; 0 b 1; 1");
  // DIV: traces, but no stable failures at all.
  const NormalLts div = normal(lts_from("0 tau 0"));
  EXPECT_EQ(acceptances(div, 0), Sets{});
  EXPECT_EQ(to_text(div.lts), "0");
  EXPECT_TRUE(div.divergent[0]);
}

TEST(NormaliseTest, ANodeDivergesIfAMemberDoes) {
  const NormalLts n = normal(lts_from("0 a 1; 0 a 2; 2 tau 3; 3 tau 3; 3 b 0; 1 c 0"));
  EXPECT_EQ(to_text(n.lts), "0 a 1; 1 b 0; 1 c 0");
  EXPECT_FALSE(n.divergent[0]);
  EXPECT_TRUE(n.divergent[1]);
  EXPECT_EQ(acceptances(n, 1), Sets{"{c}"});
}

TEST(NormaliseTest, UnreachableStatesAreInNoNode) {
  const NormalLts n = normal(lts_from("-> 2; 0 tau 2; 1 a 0; 2 b 3"));
  EXPECT_EQ(to_text(n.lts), "0 b 1; 1");
  EXPECT_EQ(members(n, 0), "2 ");
  EXPECT_EQ(members(n, 1), "3 ");
}

TEST(NormaliseTest, AcceptancesOnlyOnRequest) {
  EXPECT_FALSE(normalise(lts_from("0 a 0")).normal.acceptances);
}

/// The n-th letter from the end is a: n + 1 states, 2^n nodes.
Lts exponential(std::uint32_t n) {
  std::string text = "0 a 0; 0 b 0; 0 a 1";
  for (std::uint32_t i = 1; i < n; ++i) {
    const std::string step = std::to_string(i) + " %c " + std::to_string(i + 1);
    for (const char letter : {'a', 'b'}) {
      text += "; " + std::string(step).replace(step.find("%c"), 2, 1, letter);
    }
  }
  return lts_from(text);
}

TEST(NormaliseTest, CanBeExponential) {
  EXPECT_EQ(normal(exponential(10)).lts.state_count(), 1024U);
}

TEST(NormaliseTest, NodeLimitKeepsTheExpandedPart) {
  const Lts lts = exponential(10);
  const NormalLts whole = normal(lts);
  for (const std::uint64_t max_nodes : {1U, 2U, 3U, 100U}) {
    const Normalisation part =
        normalise(lts, {.limits = {.max_states = max_nodes}, .acceptances = true});
    ASSERT_TRUE(part.limit);
    EXPECT_EQ(part.limit->kind, base::LimitKind::states);
    EXPECT_EQ(part.limit->limit, max_nodes);
    EXPECT_FALSE(part.complete());
    ASSERT_EQ(part.normal.lts.state_count(), max_nodes);
    ASSERT_EQ(part.normal.acceptances->state_count(), max_nodes);
    for (std::uint32_t n = 0; n < max_nodes; ++n) {
      EXPECT_EQ(members(part.normal, n), members(whole, n));
      if (n >= part.expanded) {
        EXPECT_TRUE(part.normal.lts.edges(State{n}).empty());
        continue;
      }
      EXPECT_TRUE(std::ranges::equal(part.normal.lts.edges(State{n}), whole.lts.edges(State{n})));
      EXPECT_EQ(acceptances(part.normal, n), acceptances(whole, n));
    }
  }
  EXPECT_TRUE(normalise(lts, {.limits = {.max_states = 1024}}).complete());
}

TEST(NormaliseTest, OtherLimitsEndItToo) {
  const Lts lts = exponential(25);
  const Normalisation slow = normalise(lts, {.limits = {.timeout = std::chrono::milliseconds(20)}});
  ASSERT_TRUE(slow.limit);
  EXPECT_EQ(slow.limit->kind, base::LimitKind::time);
  EXPECT_GT(slow.expanded, 0U);

  const Normalisation large =
      normalise(lts, {.limits = {.max_memory_bytes = 1'000'000}, .acceptances = true});
  ASSERT_TRUE(large.limit);
  EXPECT_EQ(large.limit->kind, base::LimitKind::memory);
  EXPECT_GT(large.expanded, 1000U);

  const std::atomic<bool> cancelled = true;
  const Normalisation none = normalise(lts, {.limits = {.cancelled = &cancelled}});
  ASSERT_TRUE(none.limit);
  EXPECT_EQ(none.limit->kind, base::LimitKind::cancelled);
  EXPECT_EQ(none.expanded, 0U);
  EXPECT_EQ(none.normal.lts.state_count(), 1U);
}

TEST(NormaliseTest, AChainOfAMillionTausIsOneNode) {
  constexpr std::uint32_t count = 1'000'000;
  LtsRowBuilder rows;
  for (std::uint32_t s = 0; s + 1 < count; ++s) {
    rows.add_edge(tau, State{s + 1});
    rows.end_row();
  }
  const Lts lts = std::move(rows).finish(State{0}, count,
                                         std::make_shared<const LabelNames>(LabelNames{
                                             std::string(tau_name), std::string(tick_name)}));
  const NormalLts n = normal(lts);
  EXPECT_EQ(n.lts.state_count(), 1U);
  EXPECT_EQ(n.members[0].size(), count);
  EXPECT_EQ(acceptances(n, 0), Sets{"{}"});
}

}  // namespace
}  // namespace perentie::lts

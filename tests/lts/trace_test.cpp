// Shortest paths, with τ shown, to a state and along a given trace.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "perentie/lts/trace.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::labels_from;
using test::lts_from;
using test::to_text;

auto is(std::uint32_t state) {
  return [state](State s) { return s == State{state}; };
}

TEST(TraceTest, TheInitialStateIsReachedByNothing) {
  const Lts lts = lts_from("-> 1; 0 a 1; 1 a 0");
  const auto path = shortest_path(lts, is(1));
  ASSERT_TRUE(path);
  EXPECT_TRUE(path->empty());
  EXPECT_EQ(end_of(lts, *path), State{1});
}

TEST(TraceTest, PathsShowTauAndTracesDoNot) {
  const Lts lts = lts_from("0 tau 1; 1 a 2; 2 tau 3; 3 tick 4");
  const auto path = shortest_path(lts, is(4));
  ASSERT_TRUE(path);
  EXPECT_EQ(to_text(lts, labels_of(*path)), "τ a τ ✓");
  EXPECT_EQ(to_text(lts, trace_of(*path)), "a ✓");
  EXPECT_EQ(end_of(lts, *path), State{4});
}

TEST(TraceTest, CountsTauAsAStep) {
  const Lts lts = lts_from("0 tau 1; 1 tau 2; 2 tau 4; 0 b 3; 3 b 4");
  EXPECT_EQ(to_text(lts, labels_of(shortest_path(lts, is(4)).value())), "b b");
}

TEST(TraceTest, PrefersEarlierLabelsAndStates) {
  const Lts lts = lts_from("0 b 3; 0 a 2; 0 a 1; 1 a 4; 2 a 4; 3 a 4");
  const Path path = shortest_path(lts, is(4)).value();
  EXPECT_EQ(to_text(lts, labels_of(path)), "a a");
  EXPECT_EQ(path[0].target, State{1});
}

TEST(TraceTest, UnreachableStatesHaveNoPath) {
  EXPECT_EQ(shortest_path(lts_from("0 a 0; 1 a 0"), is(1)), std::nullopt);
  EXPECT_EQ(shortest_path(lts_from("0 tau 0"), [](State) { return false; }), std::nullopt);
}

TEST(TraceTest, AlongATraceEndsWithTheTrace) {
  const Lts lts = lts_from("0 a 1; 1 tau 2; 2 tau 1; 2 b 3; 3 tau 4; 1 b 0; 0 b 4");
  EXPECT_EQ(to_text(lts, labels_of(shortest_path(lts, is(4), labels_from(lts, "a b")).value())),
            "a τ b τ");
  EXPECT_EQ(to_text(lts, labels_of(shortest_path(lts, is(0), labels_from(lts, "a b")).value())),
            "a b");
  EXPECT_EQ(shortest_path(lts, is(4), labels_from(lts, "a")), std::nullopt);
  EXPECT_EQ(shortest_path(lts, is(4), labels_from(lts, "a a")), std::nullopt);
  EXPECT_TRUE(shortest_path(lts, is(0), {}).value().empty());
}

TEST(TraceTest, AlongATracePassesAStateMoreThanOnce) {
  const Lts lts = lts_from("0 a 0; 0 b 1");
  EXPECT_EQ(to_text(lts, labels_of(shortest_path(lts, is(1), labels_from(lts, "a a a b")).value())),
            "a a a b");
}

TEST(TraceTest, AChainOfAMillionStates) {
  constexpr std::uint32_t count = 1'000'000;
  LtsRowBuilder rows;
  for (std::uint32_t s = 0; s + 1 < count; ++s) {
    rows.add_edge(Label{2}, State{s + 1});
    rows.end_row();
  }
  const Lts lts = std::move(rows).finish(State{0}, count,
                                         std::make_shared<const LabelNames>(LabelNames{
                                             std::string(tau_name), std::string(tick_name), "a"}));
  const Path path = shortest_path(lts, is(count - 1)).value();
  EXPECT_EQ(path.size(), count - 1);
  EXPECT_EQ(shortest_path(lts, is(count - 1), trace_of(path)), path);
}

}  // namespace
}  // namespace perentie::lts

// Minimal acceptances of chosen sets of states.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "perentie/lts/acceptances.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;
using test::to_text;

// 0 {a}, 1 {a b}, 2 {b ✓}, 3 {}, 4 unstable, 5 {a}
const Lts& example() {
  static const Lts lts =
      lts_from("0 a 0; 1 a 0; 1 a 1; 1 b 0; 2 b 0; 2 tick 3; 3; 4 tau 4; 4 c 3; 5 a 1");
  return lts;
}

/// The acceptances of a set of states, such as "a|✓ b|".
std::string of(std::initializer_list<std::uint32_t> numbers) {
  std::vector<State> states;
  for (const std::uint32_t number : numbers) states.push_back(State{number});
  AcceptanceBuilder builder(example());
  builder.add(states);
  const Acceptances acceptances = std::move(builder).finish();
  std::string text;
  for (const AcceptanceId id : acceptances.of(State{0})) {
    const auto labels = acceptances.labels(id);
    text += to_text(example(), {labels.begin(), labels.end()});
    text += '|';
  }
  return text;
}

TEST(AcceptancesTest, OfOneState) {
  EXPECT_EQ(of({0}), "a|");
  EXPECT_EQ(of({1}), "a b|");
  EXPECT_EQ(of({2}), "✓ b|");
  EXPECT_EQ(of({3}), "|") << "one acceptance, which is empty";
  EXPECT_EQ(of({4}), "") << "none";
  EXPECT_EQ(of({}), "");
}

TEST(AcceptancesTest, OnlyMinimalOnesRemain) {
  EXPECT_EQ(of({0, 1}), "a|");
  EXPECT_EQ(of({0, 5}), "a|");
  EXPECT_EQ(of({0, 1, 2}), "a|✓ b|");
  EXPECT_EQ(of({1, 2, 4}), "a b|✓ b|");
  EXPECT_EQ(of({0, 1, 2, 3, 4, 5}), "|");
}

TEST(AcceptancesTest, EachSetIsKeptOnce) {
  AcceptanceBuilder builder(example());
  for (const std::uint32_t s : {0U, 5U, 0U}) builder.add(std::vector<State>{State{s}});
  const Acceptances acceptances = std::move(builder).finish();
  EXPECT_EQ(acceptances.state_count(), 3U);
  EXPECT_EQ(acceptances.set_count(), 1U);
}

TEST(AcceptancesTest, SetsAreUnitedByTheirNumbers) {
  AcceptanceBuilder builder(example());
  builder.add(State{1}, {});
  builder.add(State{4}, std::vector<State>{State{0}});
  builder.add(State{2}, std::vector<State>{State{0}, State{1}});
  builder.add(State{0}, std::vector<State>{State{1}, State{2}});
  const Acceptances all = std::move(builder).finish();
  EXPECT_EQ(all.of(State{1}).size(), 1U);
  EXPECT_EQ(all.of(State{2}).size(), 2U);
  EXPECT_EQ(all.of(State{3}).size(), 2U);
  const auto some = Acceptances(all).of_states(std::vector<State>{State{3}, State{1}});
  EXPECT_EQ(some.state_count(), 2U);
  EXPECT_EQ(some.of(State{0}).size(), 2U);
  EXPECT_EQ(some.labels(some.of(State{1})[0]).size(), 2U);  // a and b, of state 1
}

}  // namespace
}  // namespace perentie::lts

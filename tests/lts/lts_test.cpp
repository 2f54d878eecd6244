// The graph itself: rows sorted and free of duplicates whatever the order of addition, and both
// builders agree.
#include <gtest/gtest.h>

#include <memory>

#include "perentie/lts/lts.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;
using test::to_text;

std::shared_ptr<const LabelNames> names_a_b() {
  return std::make_shared<const LabelNames>(
      LabelNames{std::string(tau_name), std::string(tick_name), "a", "b"});
}

TEST(LtsTest, RowsAreSortedAndFreeOfDuplicates) {
  const Lts lts = lts_from("1 b 0; 0 b 1; 0 a 1; 0 tau 1; 0 a 0; 0 a 1; 1 tick 0");
  EXPECT_EQ(to_text(lts), "0 τ 1; 0 a 0; 0 a 1; 0 b 1; 1 ✓ 0; 1 b 0");
  EXPECT_EQ(lts.state_count(), 2U);
  EXPECT_EQ(lts.edge_count(), 6U);
}

TEST(LtsTest, TheSmallestHasOneStateAndNoEdges) {
  const Lts lts = lts_from("0");
  EXPECT_EQ(lts.state_count(), 1U);
  EXPECT_EQ(lts.edge_count(), 0U);
  EXPECT_TRUE(lts.edges(State{0}).empty());
  EXPECT_TRUE(lts.alphabet().empty());
}

TEST(LtsTest, EdgesUnderOneLabelAreASubRun) {
  const Lts lts = lts_from("0 a 0; 0 b 1; 0 b 2; 0 c 0", {"a", "b", "c", "unused"});
  EXPECT_EQ(lts.edges(State{0}, Label{3}).size(), 2U);
  EXPECT_EQ(lts.edges(State{0}, Label{3})[1].target, State{2});
  EXPECT_TRUE(lts.edges(State{0}, tau).empty());
  EXPECT_TRUE(lts.edges(State{1}, Label{3}).empty());
  EXPECT_TRUE(lts.edges(State{0}, Label{5}).empty());
}

TEST(LtsTest, TheAlphabetLeavesOutTauTickAndUnusedLabels) {
  const Lts lts = lts_from("0 tau 1; 0 tick 1; 0 c 1; 1 a 0", {"a", "b", "c"});
  EXPECT_EQ(to_text(lts, lts.alphabet()), "a c");
  EXPECT_EQ(lts.find_label("b"), Label{3});
  EXPECT_EQ(lts.find_label("nothing"), std::nullopt);
}

TEST(LtsTest, LabelsOnEdgesAreEachOnce) {
  const Lts lts = lts_from("0 a 0; 0 b 1; 0 b 2; 0 tau 0; 0 tau 1");
  EXPECT_EQ(labels_on(lts.edges(State{0})), (std::vector<Label>{tau, Label{2}, Label{3}}));
  EXPECT_TRUE(labels_on(lts.edges(State{1})).empty());
}

TEST(LtsTest, RowByRowGivesTheSameGraph) {
  LtsRowBuilder rows;
  rows.add_edge(Label{3}, State{1});
  rows.add_edge(Label{2}, State{2});
  rows.add_edge(Label{3}, State{1});
  rows.end_row();
  rows.end_row();
  rows.add_edge(Label{2}, State{0});
  rows.drop_row();
  rows.add_edge(tau, State{0});
  rows.end_row();
  rows.add_edge(tau, State{3});  // a row that is never ended does not count
  const Lts lts = std::move(rows).finish(State{0}, 4, names_a_b());
  EXPECT_EQ(to_text(lts), "0 a 2; 0 b 1; 1; 2 τ 0; 3");
}

TEST(LtsDeathTest, AGraphThatIsNoneIsOurBug) {
  const auto build = [](State initial, Label label, State target) {
    LtsBuilder builder(names_a_b());
    builder.add_state();
    builder.add_edge(State{0}, label, target);
    return std::move(builder).finish(initial);
  };
  EXPECT_EQ(to_text(build(State{0}, Label{2}, State{0})), "0 a 0");
  EXPECT_DEATH(build(State{1}, Label{2}, State{0}), "initial state");
  EXPECT_DEATH(build(State{0}, Label{4}, State{0}), "label without a name");
  EXPECT_DEATH(build(State{0}, Label{2}, State{1}), "leads to a state");
}

}  // namespace
}  // namespace perentie::lts

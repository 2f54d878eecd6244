// Hiding: labels become τ, rows stay sorted sets, τ and ✓ are out of its reach.
#include <gtest/gtest.h>

#include "perentie/lts/hide.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::labels_from;
using test::lts_from;
using test::to_text;

TEST(HideTest, HiddenEventsBecomeTau) {
  const Lts lts = lts_from("0 a 1; 0 b 0; 1 b 2; 2 tick 3");
  EXPECT_EQ(to_text(hide(lts, labels_from(lts, "b"))), "0 τ 0; 0 a 1; 1 τ 2; 2 ✓ 3; 3");
  EXPECT_EQ(to_text(hide(lts, {})), to_text(lts));
}

TEST(HideTest, EqualEdgesMerge) {
  const Lts lts = lts_from("0 a 1; 0 b 1; 0 tau 1; 0 b 0");
  EXPECT_EQ(to_text(hide(lts, labels_from(lts, "a b"))), "0 τ 0; 0 τ 1; 1");
}

TEST(HideTest, TickIsNeverHidden) {
  const Lts lts = lts_from("0 a 0; 0 tick 1");
  EXPECT_EQ(to_text(hide(lts, labels_from(lts, "tick tau a"))), "0 τ 0; 0 ✓ 1; 1");
  EXPECT_EQ(to_text(project(lts, {})), "0 τ 0; 0 ✓ 1; 1");
}

TEST(HideTest, ProjectKeepsOnlyTheGivenEvents) {
  const Lts lts = lts_from("-> 1; 0 a 1; 1 b 0; 1 c 1");
  EXPECT_EQ(to_text(project(lts, labels_from(lts, "b"))), "-> 1; 0 τ 1; 1 τ 1; 1 b 0");
}

TEST(HideTest, APredicateIsAskedOnceALabel) {
  const Lts lts = lts_from("0 a 1; 1 a 0; 1 b 1; 0 tick 0");
  std::vector<Label> asked;
  const Lts hidden = hide_if(lts, [&](Label label) {
    asked.push_back(label);
    return lts.name(label) == "a";
  });
  EXPECT_EQ(to_text(hidden), "0 τ 1; 0 ✓ 0; 1 τ 0; 1 b 1");
  EXPECT_EQ(to_text(lts, asked), "a b");
}

}  // namespace
}  // namespace perentie::lts

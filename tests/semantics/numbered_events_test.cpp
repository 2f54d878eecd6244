// Events numbered before their first use, as checks need it that are to know no history.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "script_support.hpp"

namespace perentie::semantics {
namespace {

using Names = std::vector<std::string>;

// All names but τ and ✓, which always come first.
Names names_of(const Script& script) {
  const auto names = script.label_names();
  return {names->begin() + 2, names->end()};
}

TEST(NumberedEventsTest, AreInOrderOfDeclaration) {
  TestScript test(
      "channel b, a\ndatatype D = Of.T | None\ndatatype T = X | Y\nchannel d : D.Bool\n"
      "P = a -> d.None.true -> STOP");
  ASSERT_TRUE(test.loaded()) << test.messages();
  const std::size_t named = names_of(test.script()).size();
  EXPECT_EQ(named, 0U);
  EXPECT_TRUE(test.script().number_events());
  const Names expected{"b",
                       "a",
                       "d.Of.X.false",
                       "d.Of.X.true",
                       "d.Of.Y.false",
                       "d.Of.Y.true",
                       "d.None.false",
                       "d.None.true"};
  Names found = names_of(test.script());
  EXPECT_EQ(Names(found.begin(), found.begin() + 2), Names({"b", "a"}));
  std::sort(found.begin(), found.end());
  Names sorted = expected;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(found, sorted);
  ASSERT_TRUE(test.explore("P"));
  EXPECT_EQ(names_of(test.script()).size(), expected.size()) << "none is left for its first use";
}

TEST(NumberedEventsTest, AreLeftForTheirFirstUseWhereTheyAreTooManyOrUnknown) {
  for (const std::string channel :
       {"channel n : Int", "channel n : {0..99999}.{0..9}", "channel n : {0..}",
        "channel n : {1 / 0}", "f(x) = if x == -1 then {0} else f(x + 1)\nchannel n : f(0)",
        "channel n : {card({| n |})}"}) {
    TestScript test("channel a\n" + channel + "\nP = a -> STOP");
    ASSERT_TRUE(test.loaded()) << test.messages();
    EXPECT_FALSE(test.script().number_events()) << channel;
    EXPECT_EQ(test.messages(), "") << channel;
    EXPECT_TRUE(test.explore("P")) << channel << test.messages();
  }
}

// What is wrong with a channel is said when it is used, as if nobody had looked before.
TEST(NumberedEventsTest, ErrorsAreThoseOfTheFirstUse) {
  TestScript looked("channel n : {1 / 0}\nP = n?x -> STOP");
  TestScript other("channel n : {1 / 0}\nP = n?x -> STOP");
  EXPECT_FALSE(looked.script().number_events());
  EXPECT_FALSE(looked.explore("P"));
  EXPECT_FALSE(other.explore("P"));
  EXPECT_NE(looked.messages(), "");
  EXPECT_EQ(looked.messages(), other.messages());
}

}  // namespace
}  // namespace perentie::semantics

// Priority and the operators that the step rules take as the identity (CSPM reference 4.5, 4.7).
#include <gtest/gtest.h>

#include "script_support.hpp"

namespace perentie::semantics {
namespace {

const char* const import = "external prioritise, prioritise_nocache, prioritisepo\n";

TEST(PriorityTest, HigherEventsBlockLowerOnes) {
  EXPECT_TRUE(has_lts("prioritise(a -> STOP [] b -> STOP, <{a}, {b}>)", "0 a 1; 1", import));
  EXPECT_TRUE(has_lts("prioritise(a -> STOP [] b -> STOP, <{b}, {a}>)", "0 b 1; 1", import));
  EXPECT_TRUE(
      has_lts("prioritise_nocache(a -> STOP [] b -> STOP, <{a}, {b}>)", "0 a 1; 1", import));
  EXPECT_TRUE(same_lts("prioritise(a -> STOP |~| b -> STOP, <{a}, {b}>)", "a -> STOP |~| b -> STOP",
                       import));
}

TEST(PriorityTest, EventsOfNoSetNeitherBlockNorAreBlocked) {
  EXPECT_TRUE(has_lts("prioritise(a -> STOP [] b -> STOP [] c -> STOP, <{a}, {b}>)",
                      "0 a 1; 0 c 1; 1", import));
  EXPECT_TRUE(has_lts("prioritise(c -> STOP [] b -> STOP, <{a}, {b}>)", "0 b 1; 0 c 1; 1", import));
}

TEST(PriorityTest, TauAndTickAreInTheFirstSet) {
  EXPECT_TRUE(
      has_lts("prioritise(a -> STOP [> b -> STOP, <{}, {a}>)", "0 tau 1; 1 b 2; 2", import));
  EXPECT_TRUE(has_lts("prioritise(a -> STOP [] SKIP, <{}, {a}>)", "0 tick 1; 1", import));
  EXPECT_TRUE(
      has_lts("prioritise(a -> STOP [] SKIP, <{a}, {b}>)", "0 a 1; 0 tick 2; 1; 2", import));
}

TEST(PriorityTest, TheOperatorStays) {
  EXPECT_TRUE(has_lts("prioritise(P, <{a}, {b}>)", "0 a 1; 1 c 0",
                      std::string(import) + "P = a -> (c -> P) [] b -> STOP"));
}

TEST(PriorityTest, IllFormedOrdersAreRefused) {
  EXPECT_EQ(codes_of_process("prioritise(STOP, <>)", import), "E016");
  EXPECT_EQ(codes_of_process("prioritisepo(STOP, {a, b}, {(a, b), (b, a)}, {})", import), "E016");
  EXPECT_EQ(codes_of_process("prioritisepo(STOP, {a}, {(a, b)}, {})", import), "E016");
  EXPECT_EQ(codes_of_process("prioritisepo(STOP, {a, b}, {(a, b)}, {b})", import), "E016");
}

TEST(PriorityTest, PartialOrders) {
  const std::string p = "a -> STOP [] b -> STOP [] c -> STOP";
  EXPECT_TRUE(
      has_lts("prioritisepo(" + p + ", {a, b, c}, {(a, b)}, {a})", "0 a 1; 0 c 1; 1", import));
  // Transitively: a before b before c.
  EXPECT_TRUE(has_lts("prioritisepo(a -> STOP [] c -> STOP, {a, b, c}, {(a, b), (b, c)}, {})",
                      "0 a 1; 1", import));
  // τ blocks the events of the order that are not maximal.
  EXPECT_TRUE(has_lts("prioritisepo((" + p + ") [> STOP, {a, b}, {}, {a})",
                      "0 a 1; 0 c 1; 0 tau 1; 1", import));
}

}  // namespace
}  // namespace perentie::semantics

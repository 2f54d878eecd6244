// Modules and their instances: copies with parameters (CSPM reference 2.9).
#include <gtest/gtest.h>

#include "script_support.hpp"

namespace perentie::semantics {
namespace {

const char* const counter = R"(
module Counter(limit, tick_)
  next(k) = (k + 1) % limit
exports
  channel up : {0..limit - 1}
  datatype Size = Small | Large
  size = if limit < 3 then Small else Large
  From(k) = up.k -> tick_ -> From(next(k))
endmodule
instance Two = Counter(2, a)
instance Three = Counter(3, b)
)";
const std::string with_events = std::string("channel a, b\n") + counter;

TEST(ModulesTest, MembersAreNamedWithTheirModule) {
  const char* module =
      "module M\n hidden = 3\nexports\n x = hidden + 1\n channel go\n"
      " P = go -> P\nendmodule";
  EXPECT_EQ(value_of("M::x", module), "4");
  EXPECT_EQ(value_of("M::go", module), "M::go");
  EXPECT_TRUE(has_lts("M::P", "0 M::go 0", module));
  EXPECT_EQ(codes_of_value("M::hidden", module), "N005");
  EXPECT_EQ(codes_of_value("x", module), "N001");
  EXPECT_EQ(codes_of_value("M", module), "N006");
}

TEST(ModulesTest, AnInstanceIsACopyWithItsParameters) {
  EXPECT_TRUE(has_lts("Two::From(0)", "0 Two::up.0 1; 1 a 2; 2 Two::up.1 3; 3 a 0", counter));
  EXPECT_TRUE(has_lts("Three::From(2)",
                      "0 Three::up.2 1; 1 b 2; 2 Three::up.0 3; 3 b 4; 4 Three::up.1 5; 5 b 0",
                      counter));
  EXPECT_TRUE(same_lts(
      "Two::From(0)[[Two::up <- up]]", "From(0)",
      std::string(counter) + "channel up : {0..1}\nFrom(k) = up.k -> a -> From((k + 1) % 2)"));
}

TEST(ModulesTest, InstancesHaveTheirOwnChannelsAndDatatypes) {
  EXPECT_EQ(value_of("Two::size", with_events), "Two::Small");
  EXPECT_EQ(value_of("Three::size", with_events), "Three::Large");
  EXPECT_EQ(value_of("card({|Two::up, Three::up|})", with_events), "5");
  EXPECT_EQ(value_of("inter({|Two::up|}, {|Three::up|})", with_events), "{}");
  EXPECT_EQ(value_of("card(Events)", with_events), "7");
}

TEST(ModulesTest, AnInstanceWithoutParameters) {
  const char* module = "module M\nexports\n channel go : {0..1}\nendmodule\ninstance N = M";
  EXPECT_EQ(value_of("card({|M::go, N::go|})", module), "4");
}

TEST(ModulesTest, FunctionsAreParametersToo) {
  EXPECT_EQ(value_of("N::y",
                     "module M(f)\nexports\n y = f(20)\nendmodule\n"
                     "instance N = M(\\ k @ k + 1)"),
            "21");
}

TEST(ModulesTest, ParametersAreEvaluatedWhenTheyAreNeeded) {
  EXPECT_EQ(value_of("N::y",
                     "module M(p)\nexports\n y = 1\n z = p\nendmodule\n"
                     "instance N = M(error(\"used\"))"),
            "1");
}

TEST(ModulesTest, NestedModulesAreInstancedLevelByLevel) {
  EXPECT_EQ(value_of("X2::sum", R"(
module M(j)
exports
  module N(k)
  exports
    sum = 10 * j + k
  endmodule
endmodule
instance X1 = M(3)
instance X2 = X1::N(4))"),
            "34");
}

TEST(ModulesTest, InstancesInsideModules) {
  EXPECT_EQ(value_of("Outer::I::y", R"(
module M(k)
exports
  y = k * k
endmodule
module Outer
exports
  instance I = M(7)
endmodule)"),
            "49");
}

TEST(ModulesTest, WhatIsRefused) {
  EXPECT_EQ(codes_of_value("Counter::size", with_events), "N012");
  EXPECT_EQ(codes_of_value("0", with_events + "instance Bad = Counter(1)"), "N013");
  EXPECT_EQ(codes_of_value("0", "instance N = M\nmodule M\nexports\nendmodule"), "N001");
  EXPECT_EQ(codes_of_value("0", "M = 0\nmodule M\nexports\nendmodule"), "N002");
}

}  // namespace
}  // namespace perentie::semantics

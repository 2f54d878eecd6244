// JSON output: the schema byte by byte, and valid JSON whatever the names hold.
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "perentie/lts/json.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

std::string write(const Lts& lts, const JsonOptions& options = {}) {
  std::ostringstream out;
  write_json(out, lts, options);
  return out.str();
}

TEST(JsonTest, WritesTheSchema) {
  EXPECT_EQ(write(test::lts_from("-> 1; 1 c 0; 1 tau 1; 0 tick 2; 0 a 2", {"a", "b", "c"})),
            "{\n"
            "\"schema\": \"perentie.lts/1\",\n"
            "\"initial\": 1,\n"
            "\"states\": 3,\n"
            "\"labels\": [\"τ\", \"✓\", \"a\", \"c\"],\n"
            "\"transitions\": [\n"
            "[0,1,2],\n"
            "[0,2,2],\n"
            "[1,0,1],\n"
            "[1,3,0]\n"
            "]\n"
            "}\n");
}

TEST(JsonTest, NamesStatesOnRequest) {
  const Lts lts = test::lts_from("0 a 1");
  const auto json = nlohmann::json::parse(
      write(lts, {.state_name = [](State s) { return "P(" + std::to_string(s.value) + ")\n"; }}));
  EXPECT_EQ(json.at("state_names"), (nlohmann::json{"P(0)\n", "P(1)\n"}));
  EXPECT_FALSE(nlohmann::json::parse(write(lts)).contains("state_names"));
}

TEST(JsonTest, OneStateAndNoEdges) {
  const auto json = nlohmann::json::parse(write(test::lts_from("0")));
  EXPECT_EQ(json.at("states"), 1);
  EXPECT_TRUE(json.at("transitions").empty());
}

TEST(JsonTest, NamesMayHoldAnything) {
  const std::string strange = "say.\"\\\"\n\x01\x7F größe";
  LtsBuilder builder(std::make_shared<const LabelNames>(
      LabelNames{std::string(tau_name), std::string(tick_name), strange, "\xFF"}));
  builder.add_state();
  builder.add_edge(State{0}, Label{2}, State{0});
  builder.add_edge(State{0}, Label{3}, State{0});
  const auto json = nlohmann::json::parse(write(std::move(builder).finish(State{0})));
  EXPECT_EQ(json.at("labels").at(2), strange);
  EXPECT_EQ(json.at("labels").at(3), "\xEF\xBF\xBD");
}

}  // namespace
}  // namespace perentie::lts

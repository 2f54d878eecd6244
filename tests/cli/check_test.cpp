// perentie check: outcomes, counterexamples in words and as JSON, exit codes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

Outcome check(const std::string& script, const std::vector<std::string>& options = {}) {
  const TemporaryFolder folder;
  std::vector<std::string> words{"check", folder.file("script.csp", script)};
  words.insert(words.end(), options.begin(), options.end());
  return perentie(words);
}

constexpr const char* two =
    "channel a, b\nP = a -> P\nassert P [T= a -> STOP\nassert a -> STOP [T= P\n";

TEST(CheckTest, TheExitCodeSaysTheWorstOutcome) {
  EXPECT_EQ(check("channel a\nassert STOP [T= STOP").exit_code, 0);
  EXPECT_EQ(check(two).exit_code, 1);
  EXPECT_EQ(check("assert STOP [V= STOP\nassert STOP [T= SKIP").exit_code, 3);
  EXPECT_EQ(check("channel c : {0..1}\nassert c.2 -> STOP [T= STOP").exit_code, 3);
  EXPECT_EQ(check("x = 1 + true").exit_code, 3);
  EXPECT_EQ(check("channel c : Int\nN(i) = c.i -> N(i + 1)\nassert N(0) :[divergence free]",
                  {"--max-states", "100"})
                .exit_code,
            4);
}

TEST(CheckTest, AFailureBeatsABudget) {
  const Outcome outcome = check(
      "channel c : Int\nN(i) = c.i -> N(i + 1)\nassert STOP [T= N(0)\nassert N(0) :[divergence "
      "free]",
      {"--max-states", "100"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.output.find("inconclusive"), std::string::npos);
}

TEST(CheckTest, ChoosesAssertionsByNumber) {
  const Outcome one = check(two, {"-a", "1"});
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_EQ(one.output.find("2."), std::string::npos);
  const Outcome none = check(two, {"-a", "3"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.errors.find("there is no assertion 3: the script has 2"), std::string::npos);
}

TEST(CheckTest, ExplainsInWords) {
  const Outcome outcome = check(two, {"-a", "2"});
  EXPECT_NE(outcome.output.find("after <a>\n   it performs a\n   the specification allows {}"),
            std::string::npos)
      << outcome.output;
  const Outcome ended = check("assert SKIP :[deadlock free]");
  EXPECT_NE(ended.output.find("after <✓>\n   it has terminated, which counts as a deadlock"),
            std::string::npos)
      << ended.output;
}

TEST(CheckTest, ShowsWhatTheScriptPrints) {
  const std::string script = "print 1 + 2\nprint head(<>)\nassert STOP [T= STOP";
  const Outcome outcome = check(script);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.output.find("print 1 + 2: 3\n1. STOP [T= STOP: holds"), 0U) << outcome.output;
  EXPECT_EQ(check(script, {"-a", "1"}).exit_code, 0);
}

// STOP there lets time pass, but an assertion is not translated (CSPM reference 2.10.9).
TEST(CheckTest, AssertionsInTimedSectionsNameProcesses) {
  const std::string timed = "channel tock, a\nTimed {\n  P = a -> STOP\n  assert ";
  EXPECT_EQ(check(timed + "P :[deadlock free]\n}").exit_code, 0);
  EXPECT_EQ(check(timed + "STOP :[deadlock free]\n}").exit_code, 3);
}

TEST(CheckTest, ExplainsAsJson) {
  const auto json = nlohmann::json::parse(
      check("channel a, b\nassert a -> STOP [] b -> STOP [F= a -> STOP |~| b -> STOP",
            {"--format", "json"})
          .output);
  EXPECT_EQ(json["schema"], "perentie.check/1");
  const auto& assertion = json["assertions"][0];
  EXPECT_EQ(assertion["line"], 2);
  EXPECT_EQ(assertion["outcome"], "fails");
  EXPECT_EQ(assertion["visited_states"], 3);
  EXPECT_EQ(assertion["visited_transitions"], 5);
  EXPECT_EQ(assertion["visited_plys"], 1);
  const auto& found = assertion["counterexample"];
  EXPECT_EQ(found["kind"], "acceptance");
  EXPECT_EQ(found["trace"], nlohmann::json::array({"τ"}));
  EXPECT_EQ(found["offered"], nlohmann::json::array({"a"}));
  EXPECT_EQ(found["allowed"], nlohmann::json::array({{"a", "b"}}));
}

}  // namespace
}  // namespace perentie::test

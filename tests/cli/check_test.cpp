// perentie check: outcomes, counterexamples in words and as JSON, exit codes.
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <boost/property_tree/xml_parser.hpp>
#include <nlohmann/json.hpp>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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
  EXPECT_EQ(check("assert STOP :[deadlock free [T]]\nassert STOP [T= SKIP").exit_code, 3);
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

TEST(CheckTest, CompressesLeavesUnlessItIsTold) {
  const char* script =
      "channel a, b\nP = a -> a -> P\nQ = b -> Q\nassert P ||| P ||| Q :[deadlock free [F]]\n";
  EXPECT_THAT(check(script).output, HasSubstr("; 1 states, "));
  EXPECT_THAT(check(script, {"--compress-leaves", "none"}).output, HasSubstr("; 4 states, "));
  EXPECT_EQ(check(script, {"--compress-leaves", "dbisim"}).exit_code, 2);
  const char* with_tau =
      "channel a\nP = a -> (STOP [> a -> P)\nassert P ||| P :[deadlock free [F]]\n";
  EXPECT_THAT(check(with_tau).output, HasSubstr("holds  (line 3; 9 states, "));
  EXPECT_THAT(check(with_tau, {"--compress-leaves", "wbisim"}).output,
              HasSubstr("holds  (line 3; 1 states, "));
}

TEST(CheckTest, NamesTheDefinitionWhoseArgumentsGrow) {
  const char* script =
      "channel a\nCOUNT(n) = a -> COUNT(n + 1)\nassert COUNT(0) :[deadlock free]\n";
  const Outcome outcome = check(script, {"--max-states", "5000"});
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.errors, HasSubstr("`COUNT` is called with ever other arguments"));
  EXPECT_THAT(check(script, {"--max-states", "500"}).errors, Not(HasSubstr("COUNT` is called")));
}

TEST(CheckTest, ShowsTheCallsThatLedToAnError) {
  const char* script =
      "channel c : {0..1}\nout(n) = c.(n + 5) -> STOP\nP(n) = out(n)\n"
      "assert P(1) :[deadlock free]\n";
  EXPECT_THAT(check(script).errors, Not(HasSubstr("out(1)")));
  EXPECT_THAT(check(script, {"--call-stack"}).errors, HasSubstr("out(1)"));
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
  const auto json = nlohmann::json::parse(check(script, {"--format", "json"}).output);
  EXPECT_EQ(json["prints"][0]["value"], "3");
  EXPECT_EQ(json["prints"][1]["errors"][0]["code"], "E005");
}

// STOP there lets time pass, the operators of an assertion do not (CSPM reference 2.10.9).
TEST(CheckTest, AssertionsInTimedSectionsHaveItsConstants) {
  const std::string timed = "channel tock, a\nTimed {\n  P = a -> STOP\n  assert ";
  EXPECT_EQ(check(timed + "P :[deadlock free]\n}").exit_code, 0);
  EXPECT_EQ(check(timed + "STOP :[deadlock free]\n}").exit_code, 0);
  EXPECT_EQ(check(timed + "STOP [T= STOP ||| WAIT(1) ; STOP\n}").exit_code, 0);
  EXPECT_EQ(check(timed + "P :[deadlock free]\n}\nassert STOP :[deadlock free]").exit_code, 1);
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

TEST(CheckTest, ExplainsStepsAndComponents) {
  const std::string script =
      "channel a, b, c\nP = a -> b -> P\nQ = b -> c -> Q\nR = c -> R\n"
      "assert a -> STOP [T= (P [|{b}|] Q) \\ {b}\n"
      "assert P [|{b}|] R :[deadlock free]\n"
      "assert P [{a, b} || {c}] R :[deadlock free]\n"
      "assert P [{a} || {b}] STOP :[deadlock free]\n"
      "assert a -> SKIP :[deadlock free]\n"
      "assert P \\ {a, b} :[divergence free]\n"
      "assert a -> STOP |~| b -> STOP :[deterministic]\n";
  const std::string steps = check(script, {"-a", "1", "--explain"}).output;
  EXPECT_THAT(steps, HasSubstr("     1. a\n        P is now b -> P\n"
                               "     2. τ (hidden b)\n        P is now P\n"
                               "        Q is now c -> Q\n"))
      << steps;
  EXPECT_THAT(steps, HasSubstr("     P after <a, b> performs a  ["));
  EXPECT_THAT(steps, HasSubstr("script.csp:2:1]"));
  EXPECT_THAT(steps, HasSubstr("script.csp -a 1 --explain\n"));
  EXPECT_EQ(check(script, {"-a", "2"}).exit_code, 0) << "R goes on without P";
  const std::string outside = check(script, {"-a", "4", "--explain"}).output;
  EXPECT_THAT(outside, HasSubstr("     b is offered by P, outside its alphabet\n")) << outside;
  EXPECT_THAT(check(script, {"-a", "5", "--explain"}).output, HasSubstr("note: it ends in ✓"));
  EXPECT_THAT(check(script, {"-a", "6", "--explain"}).output,
              HasSubstr("again and again:\n     1. τ (hidden a)\n"));
  EXPECT_THAT(check(script, {"-a", "7", "--explain"}).output,
              HasSubstr("   but after <τ> it may perform b, in the state b -> STOP\n"));
}

TEST(CheckTest, SaysWhoRefuses) {
  const std::string script =
      "channel a, b\nP = a -> P\nQ = b -> Q\nassert P [|{a, b}|] Q :[deadlock free]";
  const std::string text = check(script, {"--explain"}).output;
  EXPECT_THAT(text, HasSubstr("     a is offered by P, refused by Q\n"
                              "     b is offered by Q, refused by P\n"));
  const auto json = nlohmann::json::parse(check(script, {"--explain", "--format", "json"}).output);
  EXPECT_EQ(json["assertions"][0]["counterexample"]["explanation"]["blocked"][0],
            nlohmann::json::parse(R"({"event":"a","offered_by":"P","refused_by":["Q"]})"));
}

std::string without_times(const std::string& text) {
  static const std::regex time(R"(\d+\.\d\d s\b)");
  return std::regex_replace(text, time, "");
}

TEST(CheckTest, AnyNumberOfWorkersGivesTheSame) {
  const auto with = [](const std::string& jobs) {
    return without_times(
        perentie({"check", "corpus/check/forms.csp", "--explain", "-j", jobs}).output);
  };
  const std::string one = with("1");
  EXPECT_EQ(one, with("2"));
  EXPECT_EQ(one, with("7"));
  EXPECT_THAT(one, HasSubstr("\n20. "));
}

// Both a and b are unexpected; which one is said does not depend on what the script has met before.
TEST(CheckTest, WhatWasCheckedBeforeDoesNotMatter) {
  const std::string script =
      "channel a, b\nassert STOP [T= b -> STOP\nassert STOP [T= RUN({a, b})\n";
  const auto all = nlohmann::json::parse(check(script, {"--format", "json", "-j", "1"}).output);
  const auto one = nlohmann::json::parse(check(script, {"--format", "json", "-a", "2"}).output);
  EXPECT_EQ(all["assertions"][1]["counterexample"]["event"], "a");
  EXPECT_EQ(one["assertions"][0]["counterexample"]["event"], "a");
}

// Both run out of states; the definition that is named is that of the check itself.
TEST(CheckTest, GrowthIsThatOfTheCheckItself) {
  const std::string script =
      "channel a\nWIDE(n) = if n == 0 then STOP else a -> WIDE(n - 1)\n"
      "UP(n) = a -> UP(n + 1)\nassert WIDE(5000) :[deadlock free]\nassert UP(0) :[deadlock free]\n";
  const std::string errors = check(script, {"-j", "1", "--max-states", "3000"}).errors;
  EXPECT_THAT(errors, HasSubstr("`WIDE` is called"));
  EXPECT_THAT(errors, HasSubstr("`UP` is called"));
}

TEST(CheckTest, CasesForJUnit) {
  std::istringstream text(
      check(std::string(two) + "assert P :[deadlock free [T]]\n", {"--format", "junit"}).output);
  boost::property_tree::ptree tree;
  boost::property_tree::read_xml(text, tree);
  const auto& suite = tree.get_child("testsuites.testsuite");
  EXPECT_EQ(suite.get<int>("<xmlattr>.tests"), 3);
  EXPECT_EQ(suite.get<int>("<xmlattr>.failures"), 1);
  EXPECT_EQ(suite.get<int>("<xmlattr>.errors"), 1);
  EXPECT_EQ(suite.count("testcase"), 3U);
}

TEST(CheckTest, AScriptWithErrorsIsACaseForJUnit) {
  const Outcome outcome = check("x =", {"--format", "junit"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, HasSubstr("tests=\"1\" failures=\"0\" errors=\"1\""));
}

TEST(CheckTest, ResultsForSarif) {
  const auto json = nlohmann::json::parse(check(two, {"--format", "sarif"}).output);
  EXPECT_EQ(json["version"], "2.1.0");
  const auto& results = json["runs"][0]["results"];
  ASSERT_EQ(results.size(), 1U) << "what holds is no result";
  EXPECT_EQ(results[0]["ruleId"], "assertion-fails");
  const auto& region = results[0]["locations"][0]["physicalLocation"]["region"];
  EXPECT_EQ(region["startLine"], 4);
  EXPECT_EQ(results[0]["codeFlows"][0]["threadFlows"][0]["locations"].size(), 2U);
  const auto broken = nlohmann::json::parse(check("x =", {"--format", "sarif"}).output);
  EXPECT_EQ(broken["runs"][0]["results"][0]["level"], "error");
}

TEST(CheckTest, ATableForMarkdown) {
  const std::string text = check(two, {"--format", "markdown"}).output;
  EXPECT_THAT(text, HasSubstr("| 2 | 4 | a -> STOP \\[T= P | fails | 2 | 3 |\n")) << text;
  EXPECT_THAT(text, HasSubstr("<details><summary>Assertion 2</summary>"));
}

}  // namespace
}  // namespace perentie::test

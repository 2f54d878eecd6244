// perentie repl with lines on standard input: answers on standard output, no prompt.
#include <gtest/gtest.h>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

Outcome repl(const std::string& lines, const std::vector<std::string>& arguments = {}) {
  std::vector<std::string> words{"repl"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return perentie(words, {.input = lines});
}

TEST(ReplTest, EvaluatesWithoutAScript) {
  const Outcome outcome = repl("1 + 2\n\n-- a comment\nmap_\nhead(<7>)\n");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output, "3\n7\n");
  EXPECT_NE(outcome.errors.find("`map_` is not in scope"), std::string::npos);
}

TEST(ReplTest, KnowsTheScript) {
  const Outcome outcome = repl("card(waypointID)\n:type ROVER_ABORT\n", {"corpus/rover/rover.csp"});
  EXPECT_EQ(outcome.output, "6\nROVER_ABORT :: Proc\n");
}

TEST(ReplTest, ShowsProcessesWithTheirDefinitions) {
  const Outcome outcome = repl("ROVER_ABORT\n", {"corpus/rover/rover.csp"});
  EXPECT_NE(outcome.output.find("ROVER_ABORT = move.0 -> mission_abort -> SKIP"),
            std::string::npos);
}

// CSPM reference 8.1: what was defined earlier keeps the names that it saw.
TEST(ReplTest, DefinitionsSeeThoseBeforeThem) {
  const Outcome outcome = repl("let f = 1\nlet g = f\nlet f(x) = g + x\nf(1)\n:type f\n");
  EXPECT_EQ(outcome.output, "2\nf :: (Int) -> Int\n");
}

TEST(ReplTest, AWrongDefinitionIsNotKept) {
  const Outcome outcome = repl("let x = 1\nlet x = 1 + true\nx\nlet y = 2 within y + x\n");
  EXPECT_EQ(outcome.output, "1\n3\n");
  EXPECT_NE(outcome.errors.find("[T001]"), std::string::npos);
}

TEST(ReplTest, EveryErrorIsShown) {
  const Outcome outcome = repl("head(<>)\n1 + true\nnowhere\n");
  for (const char* code : {"[E005]", "[T001]", "[N001]"}) {
    EXPECT_NE(outcome.errors.find(code), std::string::npos) << code;
  }
}

TEST(ReplTest, CommandsMayBeCutShort) {
  const Outcome outcome = repl(":l corpus/rover/rover.csp\n:p\n:q\n1\n");
  EXPECT_EQ(outcome.output, "ROVER\nROVER_INSPECTING\nROVER_ABORT\nROVER_SYSTEM\n");
  const Outcome assertions = repl(":a\n", {"corpus/check/philosophers.csp"});
  EXPECT_EQ(assertions.output.find("1. Table :[deadlock free [F]]\n2. "), 0U);
  EXPECT_NE(repl(":relaod\n").errors.find("did you mean `:reload`?"), std::string::npos);
  const Outcome help = repl(":help\n:nothing\n:type\n:reload\n");
  EXPECT_NE(help.output.find(":processes"), std::string::npos);
  EXPECT_NE(help.errors.find("no command `:nothing`"), std::string::npos);
  EXPECT_NE(help.errors.find("`:type` needs EXPR"), std::string::npos);
  EXPECT_NE(help.errors.find("no script is loaded"), std::string::npos);
}

// CSPM reference 8.1.
TEST(ReplTest, ImportsCanBeTyped) {
  const Outcome outcome =
      repl("transparent normal\nexternal loop\nlet P = normal(loop(SKIP))\n:type P\n");
  EXPECT_EQ(outcome.output, "P :: Proc\n") << outcome.errors;
  EXPECT_NE(repl("transparent nrmal\n").errors.find("[N003]"), std::string::npos);
}

TEST(ReplTest, AssertionsCanBeTypedAndRun) {
  const TemporaryFolder folder;
  const std::string script = folder.file("s.csp", "channel a, b\nP = a -> P\nassert P [T= P\n");
  const Outcome outcome = repl(
      "let Q = b -> P\nassert P [T= Q\nassert not Q :[has trace [T]]: <a>\n:run 1\n:run 2\n:run "
      "3\n:a\n",
      {script});
  EXPECT_EQ(outcome.output.find("assertion 2 (check it with `:run 2`)\n"
                                "assertion 3 (check it with `:run 3`)\n1. P [T= P: holds"),
            0U)
      << outcome.output << outcome.errors;
  EXPECT_NE(outcome.output.find("2. P [T= Q: fails"), std::string::npos);
  EXPECT_NE(outcome.output.find("3. not Q :[has trace [T]]: <a>: holds"), std::string::npos);
  EXPECT_NE(outcome.output.find("1. P [T= P\n2. P [T= Q\n3. not Q"), std::string::npos);
}

TEST(ReplTest, WrongAssertionsAreNotKept) {
  const Outcome outcome = repl(
      "assert 1 [T= STOP\nassert STOP [T=\nassert Nowhere :[deadlock free]\n:a\n:run 1\n:run x\n");
  EXPECT_EQ(outcome.output, "");
  for (const char* message : {"[T001]", "[P001]", "[N001]", "there is no assertion 1: there are 0",
                              "there is no assertion x"}) {
    EXPECT_NE(outcome.errors.find(message), std::string::npos) << message;
  }
}

TEST(ReplTest, WhatOnlyAScriptCanHoldIsSaid) {
  const Outcome outcome = repl("channel c\nmodule M\nprint 1 + 2\nchannels\n:r\n");
  EXPECT_EQ(outcome.output, "3\n");
  for (const char* message : {"`channel` belongs into a script", "`module` belongs into a script",
                              "`channels` is not in scope", "`:r` may be `:reload` or `:run`"}) {
    EXPECT_NE(outcome.errors.find(message), std::string::npos) << message;
  }
}

TEST(ReplTest, ErrorsCanShowTheirCalls) {
  const std::string lines = "let f(x) = 1 / x\n1 + f(0)\n";
  EXPECT_EQ(repl(lines).errors.find("in `f(0)`"), std::string::npos);
  EXPECT_NE(repl(lines, {"--call-stack"}).errors.find("in `f(0)`"), std::string::npos);
}

// CSPM reference 8.3: a failing file leaves an empty session.
TEST(ReplTest, AScriptWithErrorsLeavesAnEmptySession) {
  const TemporaryFolder folder;
  const std::string wrong = folder.file("wrong.csp", "x = 1 + true\n");
  EXPECT_EQ(repl("1\n", {wrong}).exit_code, 3);
  const Outcome outcome =
      repl(":load corpus/rover/rover.csp\n:load " + wrong + "\nwaypointID\n2\n");
  EXPECT_EQ(outcome.output, "2\n");
  EXPECT_NE(outcome.errors.find("`waypointID` is not in scope"), std::string::npos);
}

TEST(ReplTest, ABudgetEndsAnAnswerNotTheSession) {
  const Outcome outcome = repl("let f(x) = f(x)\nf(1)\n5\n", {"--timeout", "0.2"});
  EXPECT_EQ(outcome.output, "5\n");
  EXPECT_NE(outcome.errors.find("inconclusive"), std::string::npos);
}

}  // namespace
}  // namespace perentie::test

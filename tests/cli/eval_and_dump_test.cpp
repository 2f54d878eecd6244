// perentie eval and perentie dump: results on standard output, diagnostics on standard error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string rover = "corpus/rover/rover.csp";

TEST(EvalTest, PrintsOneValueALine) {
  const Outcome outcome = perentie({"eval", rover, "-e", "card(Events)", "-e", "{5, 1, 3}"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output, "18\n{1, 3, 5}\n");
  EXPECT_EQ(outcome.errors, "");
}

TEST(EvalTest, ShowsAProcessWithItsDefinitions) {
  const Outcome outcome = perentie({"eval", rover, "-p", "ROVER_ABORT"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output,
            "SKIP = ✓ -> STOP\n\n"
            "ROVER_ABORT = move.0 -> mission_abort -> SKIP\n\n"
            "ROVER_ABORT\n");
}

TEST(EvalTest, NeedsSomethingToEvaluate) {
  const Outcome outcome = perentie({"eval", rover});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.output, "");
  EXPECT_NE(outcome.errors.find("nothing to evaluate"), std::string::npos);
}

TEST(EvalTest, AWrongExpressionDoesNotLoseTheOthers) {
  const Outcome outcome = perentie({"eval", rover, "-e", "1 +", "-e", "2 + 3"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.output, "5\n");
  EXPECT_THAT(outcome.errors, StartsWith("<expression>:1:4: error: expected an expression"));
}

TEST(EvalTest, AnEndlessEvaluationIsInconclusive) {
  const TemporaryFolder folder;
  const std::string model = folder.file("m.csp", "f(n) = f(n + 1)\n");
  const Outcome outcome = perentie({"eval", model, "-e", "f(0)", "--timeout", "0.2"});
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.errors, HasSubstr("inconclusive"));
  EXPECT_EQ(outcome.output, "");
}

TEST(EvalTest, AScriptThatCannotBeRead) {
  const Outcome outcome = perentie({"eval", "corpus/missing.csp", "-e", "1"});
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.errors, HasSubstr("cannot read `corpus/missing.csp`"));
  EXPECT_THAT(outcome.errors, HasSubstr(" [C001]\n"));
}

TEST(DumpTest, EveryPhaseOfAScript) {
  for (const char* phase : {"tokens", "ast", "print", "core"}) {
    SCOPED_TRACE(phase);
    const Outcome outcome = perentie({"dump", rover, "--phase", phase});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.errors, "");
    EXPECT_THAT(outcome.output, HasSubstr("ROVER_INSPECTING"));
    EXPECT_EQ(perentie({"dump", rover, "--phase", phase}).output, outcome.output);
  }
}

TEST(DumpTest, APrintedScriptParsesToTheSameTree) {
  const TemporaryFolder folder;
  const Outcome printed = perentie({"dump", rover, "--phase", "print"});
  const Outcome again =
      perentie({"dump", folder.file("m.csp", printed.output), "--phase", "print"});
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(again.output, printed.output);
}

TEST(DumpTest, ErrorsHaveAPlaceALineAndACaret) {
  const TemporaryFolder folder;
  const std::string model = folder.file("m.csp", "channel a\nP = (a -> STOP\n");
  const Outcome outcome = perentie({"dump", model});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.errors, HasSubstr("m.csp:2:"));
  EXPECT_THAT(outcome.errors, HasSubstr("P = (a -> STOP\n"));
  EXPECT_THAT(outcome.errors, HasSubstr("^"));
}

TEST(DumpTest, ABinaryFileIsRefusedInAFewLines) {
  const TemporaryFolder folder;
  std::string bytes;
  for (int i = 0; i < 100'000; ++i) bytes += static_cast<char>(i * 7919 >> 3);
  const Outcome outcome = perentie({"dump", folder.file("m.csp", bytes)});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.errors, HasSubstr("does not look like a CSPM script"));
  EXPECT_LT(outcome.errors.size(), 100'000U);
}

TEST(DumpTest, DeepNestingIsRefusedNotACrash) {
  const TemporaryFolder folder;
  const std::string deep = std::string(100'000, '(') + "1" + std::string(100'000, ')');
  const Outcome outcome = perentie({"dump", folder.file("m.csp", "x = " + deep + "\n")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.errors, HasSubstr("error:"));
}

}  // namespace
}  // namespace perentie::test

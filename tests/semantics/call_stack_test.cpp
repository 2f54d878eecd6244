// Errors with the calls that led to them (CSPM reference 3.9).
#include <gtest/gtest.h>

#include <string>

#include "script_support.hpp"

namespace perentie::semantics {
namespace {

// The notes of the error that an expression ends with, as `line: note` or `note`.
std::string calls_of(const std::string& expression, const std::string& definitions) {
  TestScript script(definitions);
  EXPECT_TRUE(script.loaded()) << script.messages();
  script.script().show_calls(true);
  EXPECT_EQ(script.evaluate(expression), std::nullopt);
  EXPECT_EQ(script.diagnostics().error_count(), 1U);
  std::string text;
  for (const base::Note& note : script.diagnostics().all().front().notes) {
    if (note.span) {
      text += std::to_string(script.sources().position(note.span->begin).line) + ": ";
    }
    text += note.message + '\n';
  }
  return text;
}

TEST(CallStackTest, IsShownOnDemandOnly) {
  TestScript script("f(x) = 1 + 1 / x");
  EXPECT_EQ(script.evaluate("1 + f(0)"), std::nullopt);
  EXPECT_TRUE(script.diagnostics().all().front().notes.empty());
}

TEST(CallStackTest, HasTheInnermostCallFirst) {
  EXPECT_EQ(calls_of("1 + g(0)", "f(x, s) = 1 / x\n\ng(x) = 2 +\n  f(x, \"a\") + 1"),
            "4: in `f(0, \"a\")`, which is needed here\n"
            "1: in `g(0)`, which is needed here\n");
}

TEST(CallStackTest, ShowsArgumentsAsFarAsTheyAreKnown) {
  EXPECT_EQ(calls_of("1 + f(<1, 2, 1 + 2>, (1, h(2)), h)(3)",
                     "f(s, t, g)(n) = if head(s) == 1 then 1 / 0 else n\nh(x) = x"),
            "1: in `f(<1, 2, …>, …, a function)(3)`, which is needed here\n");
}

TEST(CallStackTest, WhatIsNeededLaterIsFoundWhereItIsNeeded) {
  EXPECT_EQ(calls_of("1 + f(1)", "f(x) = head(g(x)) + 1\ng(y) = <1 / (y - 1)>"),
            "1: in `g(1)`, which is needed here\n1: in `f(1)`, which is needed here\n");
}

TEST(CallStackTest, CallsOfConstantsAreTheirPlaces) {
  EXPECT_EQ(calls_of("x", "x = y + 1\ny = f(0) + 1\nf(n) = 1 / n"),
            "2: in `f(0)`, which is needed here\n");
}

TEST(CallStackTest, LongStacksLoseTheirMiddle) {
  const std::string calls = calls_of("f(100)", "f(n) = if n == 0 then 1 / n else 1 + f(n - 1)");
  EXPECT_EQ(calls.find("1: in `f(0)`, which is needed here\n1: in `f(1)`"), 0U) << calls;
  EXPECT_NE(calls.find("\n(and 82 more)\n"), std::string::npos) << calls;
  EXPECT_NE(calls.find("in `f(99)`"), std::string::npos) << calls;
}

TEST(CallStackTest, ProcessesAreCalls) {
  TestScript script(
      "channel c : {0..1}\nP(n) = c.0 -> P(n + 1) [] c!f(n) -> STOP\nf(n) = 1 / (n - 1)");
  script.script().show_calls(true);
  EXPECT_EQ(script.explore("P(0)"), std::nullopt);
  EXPECT_NE(script.messages().find("in `P("), std::string::npos) << script.messages();
}

}  // namespace
}  // namespace perentie::semantics

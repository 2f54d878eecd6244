// Diagnostics point at the right place and stay readable on hostile lines.
#include <gtest/gtest.h>

#include "perentie/base/diagnostic.hpp"

namespace perentie::base {
namespace {

constexpr DiagnosticCode example{"X001", Severity::error, "an example"};

Diagnostic at(Span span) { return {&example, span, "bad thing", {}}; }

TEST(DiagnosticTest, UnderlinesTheSpan) {
  SourceMap sources;
  sources.add("a.csp", "P = STOP\nQ = a -> R\n");
  EXPECT_EQ(render(at({18, 19}), sources),
            "a.csp:2:10: error: bad thing [X001]\nQ = a -> R\n         ^\n");
  EXPECT_EQ(render(at({13, 17}), sources),
            "a.csp:2:5: error: bad thing [X001]\nQ = a -> R\n    ^~~~\n");
}

TEST(DiagnosticTest, EndOfFileIsAPlace) {
  SourceMap sources;
  sources.add("a.csp", "P =");
  sources.add("b.csp", "Q =");
  EXPECT_EQ(render(at({3, 3}), sources), "a.csp:1:4: error: bad thing [X001]\nP =\n   ^\n");
  EXPECT_EQ(render(at({4, 5}), sources), "b.csp:1:1: error: bad thing [X001]\nQ =\n^\n");
}

TEST(DiagnosticTest, AnExcerptKeepsItsPlaceInTheFile) {
  SourceMap sources;
  sources.add("a.csp", "P = STOP\n");
  sources.add_excerpt({"trace.jsonl", 51, 1001}, "abc\nxyz");
  EXPECT_EQ(render(at({11, 12}), sources),
            "trace.jsonl:51:1002: error: bad thing [X001]\nabc\n ^\n");
  EXPECT_EQ(render(at({15, 16}), sources), "trace.jsonl:52:2: error: bad thing [X001]\nxyz\n ^\n");
}

TEST(DiagnosticTest, TabsAndUtf8AreOneColumn) {
  SourceMap sources;
  sources.add("a.csp", "\t\"\xE2\x98\x91\" x");
  EXPECT_EQ(render(at({7, 8}), sources),
            "a.csp:1:6: error: bad thing [X001]\n \"\xE2\x98\x91\" x\n     ^\n");
}

TEST(DiagnosticTest, LongLinesAreCutAroundTheCaret) {
  SourceMap sources;
  sources.add("a.csp", std::string(100000, 'x'));
  const std::string text = render(at({50000, 50001}), sources);
  EXPECT_LT(text.size(), 500U);
  EXPECT_NE(text.find("a.csp:1:50001:"), std::string::npos);
}

TEST(DiagnosticTest, KeepsTheFirstErrorsAndCountsTheRest) {
  SourceMap sources;
  sources.add("a.csp", "P");
  Diagnostics diagnostics;
  for (int i = 0; i < 150; ++i) diagnostics.report(example, {0, 1}, "bad thing");
  EXPECT_EQ(diagnostics.all().size(), Diagnostics::max_kept_errors);
  EXPECT_EQ(diagnostics.error_count(), 150U);
  EXPECT_TRUE(
      render_all(diagnostics, sources).ends_with("perentie: 50 more errors are not shown\n"));
}

}  // namespace
}  // namespace perentie::base

// Single expressions and assertions, several scripts in one map, many errors in one file.
#include "perentie/parser/parse.hpp"

#include <gtest/gtest.h>

#include <string>

#include "parse_support.hpp"

namespace perentie::parser {
namespace {

TEST(ParseExpressionTest, TakesTheWholeText) {
  EXPECT_EQ(parse_expression_text("1 + 2").printed(), "1 + 2");
  EXPECT_EQ(parse_expression_text("\n\n  f(x)\n  -- a comment\n").printed(), "f(x)");
  EXPECT_EQ(parse_expression_text("let x = 1\n y = 2 within x + y").messages(), "");
}

TEST(ParseExpressionTest, RefusesMoreOrLess) {
  for (const std::string text : {"", "  \n", "1 2", "1\n-2", "x = 1", "f(", "1 +", "c?x", "_",
                                 "x : S", "print 1", "include \"a\"", "a → b"}) {
    const ParsedExpression parsed = parse_expression_text(text);
    EXPECT_TRUE(parsed.expression.is_none()) << text;
    EXPECT_EQ(parsed.diagnostics.error_count(), 1U) << text << parsed.messages();
  }
}

TEST(ParseExpressionTest, AddsToATree) {
  Parsed parsed = parse_text("P = a -> STOP\n");
  const std::string before = parsed.dump();
  const base::FileId text = *parsed.sources.add("expression", "P [] P");
  const ExprId e = parse_expression(text, parsed.tree, parsed.sources, parsed.diagnostics);
  ASSERT_FALSE(e.is_none());
  EXPECT_EQ(print(parsed.tree, e), "P [] P");
  EXPECT_EQ(parsed.dump(), before);
}

// A name that begins with `not` is a name (11.3).
TEST(ParseAssertionTest, NegationIsAWord) {  // CSPM reference 1.6.6, 11.3
  EXPECT_EQ(parse_text("assert\n\n{- -} not -- what\n P [T= Q").printed(), "assert not P [T= Q\n");
  EXPECT_EQ(parse_text("assert notx [T= not_").printed(), "assert notx [T= not_\n");
  EXPECT_EQ(parse_text("assert not(P) [T= Q").printed(), "assert not P [T= Q\n");
}

TEST(ParseAssertionTest, WithAndWithoutTheWord) {
  for (const std::string text : {"assert not P [T= Q", "not P [T= Q", "\nassert\nnot P [T= Q\n"}) {
    Parsed parsed;
    const base::FileId file = *parsed.sources.add("assertion", text);
    const auto assertion = parse_assertion(file, parsed.tree, parsed.sources, parsed.diagnostics);
    ASSERT_TRUE(assertion.has_value()) << parsed.messages();
    EXPECT_EQ(print(parsed.tree, *assertion), "not P [T= Q");
  }
}

TEST(ParseAssertionTest, RefusesMoreOrLess) {
  for (const std::string text : {"", "assert", "P", "P [T= Q R", "P :[deadlock free] x",
                                 "assert assert P [T= Q", "P [T= _"}) {
    Parsed parsed;
    const base::FileId file = *parsed.sources.add("assertion", text);
    EXPECT_FALSE(parse_assertion(file, parsed.tree, parsed.sources, parsed.diagnostics)) << text;
    EXPECT_EQ(parsed.diagnostics.error_count(), 1U) << text << parsed.messages();
  }
}

TEST(ParseScriptTest, EmptyScripts) {
  for (const std::string text : {"", "\n", "-- nothing", "{- nothing -}", "\r\n\t "}) {
    const Parsed parsed = parse_text(text);
    EXPECT_EQ(parsed.messages(), "");
    EXPECT_EQ(parsed.printed(), "");
  }
}

TEST(ParseScriptTest, SecondScriptOfAMapHasItsOwnPositions) {
  Parsed parsed;
  parsed.sources.add("first.csp", "x = 1\n");
  const base::FileId second = *parsed.sources.add("second.csp", "y = (\n");
  parsed.tree = parse_script(second, parsed.sources, parsed.diagnostics);
  EXPECT_TRUE(parsed.messages().starts_with("second.csp:1:6: error: ")) << parsed.messages();
}

TEST(ParseScriptTest, ReportsEachSlipOnceAndKeepsTheRest) {
  std::string text;
  for (int i = 0; i < 200; ++i) {
    text += "good" + std::to_string(i) + " = 1\nbad" + std::to_string(i) + " = (1\n";
  }
  const Parsed parsed = parse_text(text);
  EXPECT_EQ(parsed.diagnostics.error_count(), 200U);
  EXPECT_EQ(parsed.diagnostics.all().size(), base::Diagnostics::max_kept_errors);
  EXPECT_EQ(parsed.tree.declarations.count, 200U);
}

// A declaration with an error is not in the tree; nothing else is lost, and nothing is made twice.
TEST(ParseScriptTest, DropsOnlyWhatFailed) {
  const Parsed parsed = parse_text(
      "a = 1\nb = _\nf(0) = 1\nf(x + 1) = 2\nf(2) = 3\nmodule M\n c = )\n d = 1\nexports\n"
      " e = 2\nendmodule\ng = 3\n");
  EXPECT_EQ(parsed.codes(), "P008 P004 P025");
  EXPECT_EQ(parsed.printed(),
            "a = 1\nf(0) = 1\nf(2) = 3\nmodule M\n  d = 1\nexports\n  e = 2\nendmodule\ng = 3\n");
}

TEST(ParseScriptTest, DepthLimitIsAnOption) {
  ParseOptions options;
  options.max_depth = 3;
  EXPECT_EQ(parse_text("x = ((1))\n", options).codes(), "");
  EXPECT_EQ(parse_text("x = (((1)))\ny = 1\n", options).codes(), "P002");
  EXPECT_EQ(parse_text("x = (((1)))\ny = 1\n", options).printed(), "y = 1\n");
  EXPECT_EQ(parse_text("x = - - 1\n", options).codes(), "");
  EXPECT_EQ(parse_text("x = - - - 1\n", options).codes(), "P002");
}

}  // namespace
}  // namespace perentie::parser

// Hostile input: deep nesting, long chains, cut-off and binary texts. Work is counted in nodes, not
// in time.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "parse_support.hpp"
#include "perentie/test/paths.hpp"

namespace perentie::parser {
namespace {

std::string repeat(const std::string& text, std::size_t count) {
  std::string result;
  result.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

struct Nest {
  std::string name, before, middle, after;
};
void PrintTo(const Nest& nest, std::ostream* out) { *out << nest.before << nest.after; }

const std::vector<Nest> nests = {
    {"parentheses", "(", "1", ")"},
    {"sets", "{", "1", "}"},
    {"sequences", "<", "1", ">"},
    {"productions", "{| ", "1", " |}"},
    {"maps", "(| 1 => ", "1", " |)"},
    {"tuples", "(1, ", "1", ")"},
    {"calls", "f(", "1", ")"},
    {"comprehensions", "{x | x <- ", "S", "}"},
    {"filters", "<x | ", "b", ">"},
    {"renamings", "P[[a <- ", "b", "]]"},
    {"alphabets", "P [| ", "A", " |] Q"},
    {"two_alphabets", "P [A || ", "B", "] Q"},
    {"links", "P [a <-> ", "b", "] Q"},
    {"sync_choices", "P [+ ", "A", " +] Q"},
    {"sync_interrupts", "P /+ ", "A", " +\\ Q"},
    {"lets", "let x = ", "1", " within x"},
    {"let_bodies", "let x = 1 within ", "x", ""},
    {"conditions", "if ", "b", " then 1 else 2"},
    {"branches", "if b then ", "1", " else 2"},
    {"else_branches", "if b then 1 else ", "2", ""},
    {"lambdas", "\\ x @ ", "x", ""},
    {"patterns", "\\ y @ f(", "x", ")"},
    {"replicated", "[] x : S @ ", "P", ""},
    {"replicated_sources", "[] x : ", "S", " @ P"},
    {"minus", "- ", "1", ""},
    {"not", "not ", "b", ""},
    {"length", "#", "s", ""},
    {"timed_lets", "let Timed { x = ", "1", "} within x"},
    {"field_sets", "c?x:{", "1", "} -> P"},
    {"channels", "(", "c", "?x -> P)?y -> P"},
};

class Nesting : public ::testing::TestWithParam<Nest> {};

std::string nest_name(const ::testing::TestParamInfo<Nest>& info) { return info.param.name; }

std::string nested(const Nest& nest, std::size_t depth) {
  return repeat(nest.before, depth) + nest.middle + repeat(nest.after, depth);
}

// 100 times as deep, 100 times the nodes: nothing is read twice on the way.
TEST_P(Nesting, TakesLinearWork) {
  const auto nodes = [&](std::size_t depth) {
    const ParsedExpression parsed = parse_expression_text(nested(GetParam(), depth));
    EXPECT_NE(parsed.codes(), "P002");
    return parsed.tree.exprs.size() + parsed.tree.patterns.size() + parsed.tree.statements.size() +
           parsed.tree.decls.size();
  };
  const std::size_t one = nodes(11) - nodes(10);
  EXPECT_LE(one, 10U);
  EXPECT_EQ(nodes(110) - nodes(10), 100 * one);
}

TEST_P(Nesting, AtTheLimitIsReadAndPrinted) {
  const std::size_t limit = ParseOptions{}.max_depth;
  std::size_t deepest = limit;
  while (parse_expression_text(nested(GetParam(), deepest)).codes() == "P002") --deepest;
  EXPECT_GE(deepest, limit / 2 - 2);
  const ParsedExpression parsed = parse_expression_text(nested(GetParam(), deepest));
  ASSERT_EQ(parsed.messages(), "");
  const ParsedExpression again = parse_expression_text(parsed.printed());
  ASSERT_EQ(again.messages(), "");
  EXPECT_TRUE(same_tree(parsed.tree, parsed.expression, again.tree, again.expression));
}

TEST_P(Nesting, FarTooDeepIsReported) {
  for (const std::string& text :
       {nested(GetParam(), 100'000), repeat(GetParam().before, 100'000)}) {
    const Parsed parsed = parse_text("x = " + text + "\ny = 1\n");
    EXPECT_EQ(parsed.codes(), "P002");
    EXPECT_EQ(parsed.printed(), "y = 1\n");
  }
}

INSTANTIATE_TEST_SUITE_P(Each, Nesting, ::testing::ValuesIn(nests), nest_name);

TEST(NestingTest, OfPatterns) {
  for (const Nest& nest : std::vector<Nest>{{"", "(", "x", ")"},
                                            {"", "<", "x", ">"},
                                            {"", "{", "x", "}"},
                                            {"", "(x, ", "_", ")"},
                                            {"", "(<x>^", "x", ")"},
                                            {"", "(x.", "x", ").y"},
                                            {"", "(x @@ ", "x", ")"}}) {
    for (const std::string before : {"f(", "x = \\ (", "x = {1 | (", "("}) {
      const bool definition = before == "f(" || before == "(";
      const std::string after = definition ? ") = 1" : before == "x = {1 | (" ? ") <- S}" : ") @ 1";
      EXPECT_EQ(parse_text(before + nested(nest, 100) + after).codes(), "") << before;
      EXPECT_EQ(parse_text(before + nested(nest, 100'000) + after).codes(), "P002") << before;
    }
  }
}

TEST(NestingTest, OfTypesBlocksAndPrintLines) {
  for (const Nest& nest : std::vector<Nest>{{"", "(", "Int", ")"},
                                            {"", "{", "Int", "}"},
                                            {"", "<", "Int", ">"},
                                            {"", "(| Int => ", "Int", " |)"},
                                            {"", "((", "Int", ") -> Int)"}}) {
    EXPECT_EQ(parse_text("x :: " + nested(nest, 100'000) + "\ny = 1\n").codes(), "P002");
    EXPECT_EQ(parse_text("x :: " + nested(nest, 100) + "\ny = 1\n").codes(), "");
  }
  EXPECT_EQ(parse_text("print " + nested({"", "(", "1", ")"}, 100'000)).codes(), "P019");
  // Modules and timed sections nest without limit: nothing recurses there.
  const Parsed modules = parse_text(repeat("module M\n", 1000) + "exports\n" +
                                    repeat("endmodule\nexports\n", 999) + "endmodule\n");
  EXPECT_EQ(modules.codes(), "");
  EXPECT_TRUE(same_tree(modules.tree, parse_text(modules.printed()).tree));
}

struct Chain {
  std::string name, operand, op;
};
void PrintTo(const Chain& chain, std::ostream* out) { *out << chain.operand << chain.op; }

class LongChain : public ::testing::TestWithParam<Chain> {};

// Chains of any length parse, print, parse back and dump, without recursion on the stack.
TEST_P(LongChain, ParsesAndPrints) {
  constexpr std::size_t length = 100'000;
  const Chain& chain = GetParam();
  const std::string text = repeat(chain.operand + chain.op, length) + chain.operand;
  const ParsedExpression parsed = parse_expression_text(text);
  ASSERT_EQ(parsed.messages(), "");
  EXPECT_LE(parsed.tree.exprs.size(), 5 * length + 10);
  const ParsedExpression again = parse_expression_text(parsed.printed());
  EXPECT_EQ(again.messages(), "");
  EXPECT_TRUE(same_tree(parsed.tree, parsed.expression, again.tree, again.expression));
  EXPECT_GT(parsed.dump().size(), length);
}

INSTANTIATE_TEST_SUITE_P(Each, LongChain,
                         ::testing::Values(Chain{"prefix", "a", " ->\n"},
                                           Chain{"sequential", "P", " ;\n"},
                                           Chain{"concat", "s", "^"}, Chain{"dot", "a", "."},
                                           Chain{"conjunction", "b", " and "},
                                           Chain{"choice", "P", " [] "}, Chain{"sum", "x", " + "},
                                           Chain{"guard", "b", " & "}, Chain{"hiding", "P", " \\ "},
                                           Chain{"hiding_and_yielding", "P \\ A", " ||| "},
                                           Chain{"two_levels", "a -> P", " [] "}),
                         [](const auto& chain) { return chain.param.name; });

TEST(LongChainTest, OfPostfixesFieldsAndPatterns) {
  const std::vector<std::string> scripts = {
      "x = f" + repeat("(1)", 20'000),
      "x = P" + repeat("[[a <- b]]", 20'000),
      "x = c" + repeat("?x", 20'000) + " -> P",
      "x = c?x" + repeat(".x", 20'000) + " -> P",
      "x = c!x" + repeat(".x:S", 20'000) + " -> P",
      "f(x" + repeat(".y", 20'000) + ") = 1",
      "f(<x>" + repeat("^<y>", 20'000) + ") = 1",
      "x = {" + repeat("1, ", 20'000) + "1}",
      "x = {1 | " + repeat("x <- S, ", 20'000) + "b}",
      "x = {1 | x" + repeat(".y", 20'000) + " : S}",
      "f" + repeat("(x)", 20'000) + " = 1",
      "x :: Int" + repeat(".Int", 20'000),
      "x :: Int" + repeat(" => Int", 20'000),
      "x :: (Int)" + repeat(" -> (Int)", 20'000) + " -> Int",
      "x = y" + repeat("::z", 20'000),
      "datatype T = A" + repeat(" | B.Int", 20'000),
      "channel a" + repeat(", b", 20'000),
      "x = let " + repeat("y = 1\n", 20'000) + " within y",
      repeat("f(0) = 1\n", 20'000),
      repeat("f(x) = _\n", 5'000) + "x = 1",
  };
  for (const std::string& script : scripts) {
    SCOPED_TRACE(script.substr(0, 40));
    const Parsed parsed = parse_text(script + "\n");
    if (parsed.diagnostics.has_errors()) {
      EXPECT_TRUE(parsed.codes().starts_with("P012") || parsed.codes().starts_with("P008"))
          << parsed.messages().substr(0, 1000);
      continue;
    }
    const Parsed again = parse_text(parsed.printed());
    EXPECT_EQ(again.diagnostics.error_count(), 0U) << again.messages().substr(0, 1000);
    EXPECT_TRUE(same_tree(parsed.tree, again.tree));
    EXPECT_GT(parsed.dump().size(), 100U);
  }
}

// One line of a megabyte, with as many errors as it can hold.
TEST(HostileTextTest, LongLinesWithErrors) {
  for (const std::string piece : {"\"a\" ", "'ab' ", ":[ [x ", "( ", ") ", "let ", "within ", "= ",
                                  "x = ", ":[a] ", "include ", "{- ", "f(x) = _ "}) {
    SCOPED_TRACE(piece);
    EXPECT_TRUE(parse_text(repeat(piece, 1'000'000 / piece.size())).diagnostics.has_errors());
  }
}

TEST(HostileTextTest, LinesWithErrors) {
  for (const std::string line :
       {"x = (\n", "let\n", "x = let y = (\n", "  z = 1 +\n", "}\n", "module M(\n", "Timed (\n",
        "endmodule\n", "assert\n", "x\n", "[] y\n", "x = \"\n", "print (\n", "channel\n"}) {
    SCOPED_TRACE(line);
    parse_text(repeat(line, 10'000));
    parse_text(repeat("x = 1\n" + line, 5'000));
  }
}

// Every beginning and every end of a script gives a tree or a message.
TEST(HostileTextTest, CutOffScripts) {
  for (const std::string name :
       {"pass/print_traps.csp", "pass/lex_sequence_brackets.csp", "pass/decl_modules.csp",
        "pass/decl_assertions.csp", "pass/expr_prefix.csp", "pass/type_annotations.csp",
        "fail/recovery.csp", "fail/syntax_slips.csp"}) {
    const std::string text =
        *base::read_file((test::corpus() / "parser" / name).generic_string()).text;
    for (std::size_t i = 0; i <= text.size(); ++i) {
      const Parsed begun = parse_text(text.substr(0, i));
      if (!begun.diagnostics.has_errors()) begun.printed();
      parse_text(text.substr(i));
    }
  }
}

TEST(HostileTextTest, BinaryTexts) {
  for (int step = 1; step < 256; step += 2) {
    std::string text;
    for (int i = 0; i < 4096; ++i) text.push_back(static_cast<char>((i * step + i / 256) % 256));
    const Parsed parsed = parse_text(text);
    EXPECT_TRUE(parsed.diagnostics.has_errors());
    EXPECT_FALSE(parsed.messages().empty());
  }
  EXPECT_TRUE(parse_text(std::string(1'000'000, '\0')).diagnostics.has_errors());
}

}  // namespace
}  // namespace perentie::parser

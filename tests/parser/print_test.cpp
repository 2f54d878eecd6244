// How text is laid out; what is printed is held to its golden files and to parsing back elsewhere.
#include "perentie/parser/print.hpp"

#include <gtest/gtest.h>

#include <string>

#include "parse_support.hpp"

namespace perentie::parser {
namespace {

std::string printed(const std::string& text, std::size_t width) {
  const Parsed parsed = parse_text(text);
  EXPECT_EQ(parsed.messages(), "");
  return print_script(parsed.tree, {width});
}

TEST(PrintTest, ShortThingsStayOnOneLine) {
  EXPECT_EQ(printed("P =\n let x = 1 within\n if x == 1\n then a -> P else\n STOP\n", 100),
            "P = let x = 1 within if x == 1 then a -> P else STOP\n");
}

TEST(PrintTest, LongThingsAreBrokenWhereLinesMayEnd) {
  EXPECT_EQ(printed("P = if condition then first_process [] second_process else other\n", 30),
            "P =\n"
            "  if condition\n"
            "  then first_process\n"
            "    [] second_process\n"
            "  else other\n");
  EXPECT_EQ(printed("f(x) = let y = x\n z = y within y + z\n", 100),
            "f(x) =\n"
            "  let\n"
            "    y = x\n"
            "    z = y\n"
            "  within\n"
            "    y + z\n");
  EXPECT_EQ(printed("x = first_number - second_number - third_number\n", 30),
            "x =\n"
            "  first_number -\n"
            "  second_number -\n"
            "  third_number\n");
  EXPECT_EQ(printed("s = {alpha, beta, gamma, delta, epsilon}\n", 24),
            "s =\n"
            "  {alpha, beta, gamma,\n"
            "    delta, epsilon}\n");
  EXPECT_EQ(printed("P = a -> b -> c -> STOP\n", 12),
            "P =\n"
            "  a ->\n"
            "  b ->\n"
            "  c ->\n"
            "  STOP\n");
  EXPECT_EQ(printed("P = || i : S @ [A(i)] Q(i)\n", 20),
            "P =\n"
            "  || i : S @ [A(i)]\n"
            "    Q(i)\n");
  EXPECT_EQ(printed("datatype Colour = Red | Green | Blue.Int\n", 24),
            "datatype Colour = Red\n"
            "  | Green | Blue.Int\n");
}

TEST(PrintTest, ZeroWidthBreaksOnlyWhereItMust) {
  const std::string names(200, 'x');
  EXPECT_EQ(printed("P = " + names + " [] " + names + "\n", 0),
            "P = " + names + " [] " + names + "\n");
  EXPECT_EQ(printed("P = let a = 1\n b = 2 within a\n", 0),
            "P =\n  let\n    a = 1\n    b = 2\n  within\n    a\n");
}

TEST(PrintTest, NeverWiderThanAskedIfItCanBeHelped) {
  const Parsed parsed = parse_file("corpus/parser/pass/print_traps.csp");
  for (const std::size_t width : {60U, 100U}) {
    std::istringstream lines(print_script(parsed.tree, {width}));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), width) << line;
  }
}

TEST(PrintTest, Parts) {
  const Parsed parsed = parse_text(
      "f(<x>^xs) = x\ng :: (Int) -> {Bool}\nassert not let x = 0 within M::P(x) :[deadlock "
      "free]\n");
  const std::span<const DeclId> decls = parsed.tree.list(parsed.tree.declarations);
  EXPECT_EQ(print(parsed.tree, decls[0]), "f(<x>^xs) = x");
  const auto& f = std::get<FunctionDecl>(parsed.tree.decls[decls[0]].node);
  const Clause& clause = parsed.tree.list(f.clauses)[0];
  EXPECT_EQ(print(parsed.tree, parsed.tree.list(clause.parameters)[0]), "<x>^xs");
  EXPECT_EQ(print(parsed.tree, clause.body), "x");
  const auto& g = std::get<AnnotationDecl>(parsed.tree.decls[decls[1]].node);
  EXPECT_EQ(print(parsed.tree, g.type), "(Int) -> {Bool}");
  // The form that tools show assertions in (CSPM reference 2.6.10).
  const auto& a = std::get<AssertDecl>(parsed.tree.decls[decls[2]].node);
  EXPECT_EQ(print(parsed.tree, a.assertion), "not let x = 0 within M::P(x) :[deadlock free]");
}

}  // namespace
}  // namespace perentie::parser

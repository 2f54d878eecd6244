// The operator table, held against a second copy of CSPM reference 1.7 written down here, for every
// ordered pair of infix operators and for prefix operators among them; then the special rules.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "parse_support.hpp"
#include "perentie/parser/operators.hpp"

namespace perentie::parser {
namespace {

struct Operator {
  std::string text;    // as written between two operands
  int level;           // smaller binds tighter
  char associativity;  // left, right or none
};

// The infix operators that expressions are left with; fields and patterns are tested apart.
const std::vector<Operator> operators = {
    {"^", 3, 'l'},         {"*", 5, 'l'},         {"/", 5, 'l'},        {"%", 5, 'l'},
    {"+", 6, 'l'},         {"-", 6, 'l'},         {"==", 7, 'n'},       {"!=", 7, 'n'},
    {"<", 7, 'n'},         {"<=", 7, 'n'},        {">", 7, 'n'},        {">=", 7, 'n'},
    {"and", 9, 'l'},       {"or", 10, 'l'},       {".", 12, 'r'},       {"&", 14, 'r'},
    {"->", 14, 'r'},       {";", 15, 'l'},        {"[>", 16, 'l'},      {"/\\", 17, 'l'},
    {"/+ x +\\", 17, 'l'}, {"[]", 18, 'l'},       {"[+ x +]", 18, 'l'}, {"|~|", 19, 'l'},
    {"[| x |]", 20, 'n'},  {"[x || y]", 20, 'n'}, {"[| x |>", 20, 'n'}, {"[x <-> y]", 20, 'n'},
    {"|||", 21, 'l'},      {"\\", 22, 'l'},       {"|\\", 22, 'l'},
};

// The prefix operators, with an operand to the right to come.
const std::vector<Operator> prefixes = {
    {"#", 4, ' '},
    {"-", 6, ' '},
    {"not", 8, ' '},
    {"|| x : y @ [z]", 20, ' '},
    {"[] x : y @", 23, ' '},
    {"[| z |] x : y @", 23, ' '},
    {"[z <-> z] x <- y @", 23, ' '},
    {"if x then y else", 25, ' '},
    {"let x = y within", 25, ' '},
    {"\\ x @", 25, ' '},
};

// The operators that give way to hiding before them (1.7.7).
bool yields(const Operator& op) {
  return op.level >= 15 && op.level <= 21 && op.text != "[x <-> y]";
}
bool hides(const Operator& op) { return op.level == 22; }

enum class Grouping { left, right, clash };

// What `a first b second c` means.
Grouping expected(const Operator& first, const Operator& second) {
  if (first.level < second.level) return Grouping::left;
  if (first.level > second.level) {
    return hides(first) && yields(second) ? Grouping::left : Grouping::right;
  }
  if (first.associativity == 'n') return Grouping::clash;
  return first.associativity == 'l' ? Grouping::left : Grouping::right;
}

bool same(const ParsedExpression& a, const ParsedExpression& b) {
  return same_tree(a.tree, a.expression, b.tree, b.expression);
}

std::size_t parentheses_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '('));
}

TEST(OperatorTableTest, HasTheLevelsOfTheReference) {
  EXPECT_EQ(infix_table.size(), operators.size() + 5);  // and `:`, `?`, `!`, `$`, `@@`
  for (const Operator& op : operators) {
    const std::string spelling = [&] {
      std::string s;
      for (const char c : op.text) {
        if (c != ' ' && c != 'x' && c != 'y') s += c;
      }
      return s;
    }();
    const auto found = std::find_if(infix_table.begin(), infix_table.end(), [&](const auto& row) {
      std::string row_spelling(row.spelling);
      row_spelling.erase(std::remove(row_spelling.begin(), row_spelling.end(), '.'),
                         row_spelling.end());
      return (op.text == "." ? row.spelling == "." : row_spelling == spelling);
    });
    ASSERT_NE(found, infix_table.end()) << op.text;
    EXPECT_EQ(found->level, op.level) << op.text;
  }
}

TEST(OperatorPairTest, GroupAsTheTableSays) {
  for (const Operator& first : operators) {
    for (const Operator& second : operators) {
      const std::string text = "a " + first.text + " b " + second.text + " c";
      SCOPED_TRACE(text);
      const ParsedExpression bare = parse_expression_text(text);
      const ParsedExpression left =
          parse_expression_text("(a " + first.text + " b) " + second.text + " c");
      const ParsedExpression right =
          parse_expression_text("a " + first.text + " (b " + second.text + " c)");
      ASSERT_FALSE(left.diagnostics.has_errors()) << left.messages();
      ASSERT_FALSE(right.diagnostics.has_errors()) << right.messages();
      switch (expected(first, second)) {
        case Grouping::left:
          EXPECT_TRUE(same(bare, left)) << bare.dump();
          break;
        case Grouping::right:
          EXPECT_TRUE(same(bare, right)) << bare.dump();
          break;
        case Grouping::clash:
          EXPECT_EQ(bare.codes(), "P003");
          break;
      }
    }
  }
}

// Parentheses are printed exactly where the table, or giving way to hiding, makes them necessary.
TEST(OperatorPairTest, PrintWithMinimalParentheses) {
  for (const Operator& first : operators) {
    for (const Operator& second : operators) {
      const Grouping natural = expected(first, second);
      for (const Grouping wanted : {Grouping::left, Grouping::right}) {
        const std::string text = wanted == Grouping::left
                                     ? "(a " + first.text + " b) " + second.text + " c"
                                     : "a " + first.text + " (b " + second.text + " c)";
        SCOPED_TRACE(text);
        const ParsedExpression parsed = parse_expression_text(text);
        const std::string printed = parsed.printed();
        const ParsedExpression again = parse_expression_text(printed);
        EXPECT_TRUE(same(parsed, again)) << printed;
        EXPECT_EQ(again.printed(), printed);
        EXPECT_EQ(parentheses_in(printed), wanted == natural ? 0U : 1U) << printed;
      }
    }
  }
}

// `p a first b`: the prefix operator takes in what binds tighter than itself.
TEST(PrefixOperatorTest, TakeInWhatBindsTighter) {
  for (const Operator& prefix : prefixes) {
    for (const Operator& op : operators) {
      const std::string text = prefix.text + " a " + op.text + " b";
      SCOPED_TRACE(text);
      const ParsedExpression bare = parse_expression_text(text);
      const ParsedExpression inside = parse_expression_text(prefix.text + " (a " + op.text + " b)");
      const ParsedExpression outside =
          parse_expression_text("(" + prefix.text + " a) " + op.text + " b");
      ASSERT_FALSE(inside.diagnostics.has_errors()) << inside.messages();
      ASSERT_FALSE(outside.diagnostics.has_errors()) << outside.messages();
      if (op.level < prefix.level) {
        EXPECT_TRUE(same(bare, inside)) << bare.dump();
      } else if (op.level > prefix.level || op.associativity == 'l') {
        EXPECT_TRUE(same(bare, outside)) << bare.dump();
      } else {
        EXPECT_EQ(bare.codes(), "P003");
      }
      for (const ParsedExpression* parsed : {&inside, &outside}) {
        const ParsedExpression again = parse_expression_text(parsed->printed());
        EXPECT_TRUE(same(*parsed, again)) << parsed->printed();
      }
    }
  }
}

// `a first p b second c`: after a prefix operator only its level counts.
TEST(PrefixOperatorTest, StandAsRightOperandsWithoutParentheses) {
  for (const Operator& first : operators) {
    for (const Operator& prefix : prefixes) {
      for (const Operator& second : operators) {
        const std::string text = "a " + first.text + " " + prefix.text + " b " + second.text + " c";
        SCOPED_TRACE(text);
        const bool taken_in = second.level < prefix.level;
        const bool clash = second.level == prefix.level && second.associativity == 'n';
        if (clash) {
          EXPECT_EQ(parse_expression_text(text).codes(), "P003");
          continue;
        }
        const std::string operand = taken_in ? "(" + prefix.text + " (b " + second.text + " c))"
                                             : "(" + prefix.text + " b)";
        const ParsedExpression bare = parse_expression_text(text);
        const ParsedExpression grouped = parse_expression_text(
            taken_in ? "a " + first.text + " " + operand
                     : "a " + first.text + " " + operand + " " + second.text + " c");
        ASSERT_EQ(bare.diagnostics.has_errors(), grouped.diagnostics.has_errors())
            << bare.messages() << grouped.messages();
        if (bare.diagnostics.has_errors()) continue;
        EXPECT_TRUE(same(bare, grouped)) << bare.dump();
        const ParsedExpression again = parse_expression_text(bare.printed());
        EXPECT_TRUE(same(bare, again)) << bare.printed();
      }
    }
  }
}

void expect_same(const std::string& bare, const std::string& grouped) {
  SCOPED_TRACE(bare + "   is   " + grouped);
  const ParsedExpression a = parse_expression_text(bare);
  const ParsedExpression b = parse_expression_text(grouped);
  EXPECT_EQ(a.messages(), "");
  EXPECT_EQ(b.messages(), "");
  EXPECT_TRUE(same(a, b)) << a.dump() << b.dump();
}

TEST(SpecialRulesTest, DotIsLooserThanArithmetic) {  // 1.7.1
  expect_same("c.x+1", "c.(x+1)");
  expect_same("picks.i.(i+1)%N", "picks.i.((i+1)%N)");
  expect_same("c.x and y.z", "c.((x and y).z)");
}

TEST(SpecialRulesTest, ComparisonBetweenDots) {  // 1.7.1
  const ParsedExpression parsed = parse_expression_text("c.x == d.y");
  EXPECT_EQ(parsed.codes(), "P020");
  const ParsedExpression grouped = parse_expression_text("c.((x == d).y)");
  EXPECT_TRUE(same(parsed, grouped));
  EXPECT_EQ(parse_expression_text("c.x == 1").codes(), "");
  EXPECT_EQ(parse_expression_text("(c.x) == (d.y)").codes(), "");
  EXPECT_EQ(parse_expression_text("c.(x == d).y").codes(), "");
}

TEST(SpecialRulesTest, DotIsTighterThanFields) {  // 1.7.2
  expect_same("c?x.y -> P", "c?x?y -> P");
  expect_same("c!x.y -> P", "c!x!y -> P");
  expect_same("c$x.y -> P", "c$x$y -> P");
  expect_same("c?x.y!z.w -> P", "c?x?y!z!w -> P");
  expect_same("c.a.b?x -> P", "(c.a.b)?x -> P");
}

TEST(SpecialRulesTest, RestrictionIsTighterThanDot) {  // 1.7.3
  expect_same("c?x:A.y:B -> P", "c?x:A?y:B -> P");
  expect_same("c?x:(A.B) -> P", "(c)?x:(A.B) -> P");
  expect_same("c$x:A.y -> P", "c$x:A$y -> P");
}

TEST(SpecialRulesTest, UnaryMinusIsAsLooseAsBinary) {  // 1.7.4
  expect_same("-1%3", "-(1%3)");
  expect_same("-x*y", "-(x*y)");
  expect_same("-x+y", "(-x)+y");
  expect_same("-1%1 == 0", "(-(1%1)) == 0");
}

TEST(SpecialRulesTest, NotIsLooserThanComparison) {  // 1.7.5
  expect_same("not a == b", "not (a == b)");
  expect_same("not a and b", "(not a) and b");
}

TEST(SpecialRulesTest, ComparisonsAndParallelsDoNotChain) {  // 1.7.6
  EXPECT_EQ(parse_expression_text("a < b < c").codes(), "P003");
  EXPECT_EQ(parse_expression_text("P [|A|] Q [|B|] R").codes(), "P003");
  EXPECT_EQ(parse_expression_text("a < b < c < d < e").codes(), "P003");
}

TEST(SpecialRulesTest, ProcessOperatorsYieldToHiding) {  // 1.7.7
  expect_same("P ||| Q \\ A", "(P ||| Q) \\ A");
  expect_same("P \\ A ||| Q", "(P \\ A) ||| Q");
  expect_same("P \\ A [] Q ||| R", "((P \\ A) [] Q) ||| R");
  expect_same("P \\ A ||| Q \\ B ||| R", "(((P \\ A) ||| Q) \\ B) ||| R");
  expect_same("P \\ A ; Q [> R /\\ S [] T |~| U [|X|] V ||| W",
              "(((P \\ A) ; Q [> R /\\ S [] T |~| U) [|X|] V) ||| W");
  expect_same("a -> P \\ A [] Q", "((a -> P) \\ A) [] Q");
  expect_same("P |\\ A [B || C] Q", "(P |\\ A) [B || C] Q");
  expect_same("P \\ a -> Q", "P \\ (a -> Q)");
  expect_same("P \\ a & Q", "P \\ (a & Q)");
  expect_same("P \\ A [a <-> b] Q", "P \\ (A [a <-> b] Q)");
  const ParsedExpression grouped = parse_expression_text("P \\ (A ||| Q)");
  EXPECT_FALSE(same(grouped, parse_expression_text("P \\ A ||| Q")));
  expect_same("P \\ (A ||| B) ||| Q", "(P \\ (A ||| B)) ||| Q");
}

TEST(SpecialRulesTest, TheManualsExamples) {  // 1.7.8
  expect_same("STOP [] STOP ; STOP", "STOP [] (STOP ; STOP)");
  expect_same("a -> P ; Q", "(a -> P) ; Q");
  expect_same("b & P [] Q", "(b & P) [] Q");
  expect_same("a -> P [] Q", "(a -> P) [] Q");
  expect_same("a -> P \\ A", "(a -> P) \\ A");
  expect_same("a -> P[[x <- y]]", "a -> (P[[x <- y]])");
}

TEST(SpecialRulesTest, OpenFormsReachFarRight) {  // 1.7.9
  expect_same("[] x:X @ P \\ A", "[] x:X @ (P \\ A)");
  expect_same("if b then P else Q [] R", "if b then P else (Q [] R)");
  expect_same("\\ x @ x + 1", "\\ x @ (x + 1)");
  expect_same("let x = 1 within x ||| y", "let x = 1 within (x ||| y)");
  expect_same("if a then b else if c then d else e", "if a then b else (if c then d else e)");
}

TEST(SpecialRulesTest, ReplicatedAlphabetisedParallelEndsEarlier) {  // CSPM reference 11.1
  expect_same("|| i:S @ [A] P ||| Q", "(|| i:S @ [A] P) ||| Q");
  expect_same("|| i:S @ [A] P \\ B", "(|| i:S @ [A] P) \\ B");
  expect_same("|| i:S @ [A] P |\\ B", "(|| i:S @ [A] P) |\\ B");
  for (const std::string op : {"[]", "|~|", "/\\", "[>", ";", "[+ X +]", "/+ X +\\"}) {
    expect_same("|| i:S @ [A] P " + op + " Q", "|| i:S @ [A] (P " + op + " Q)");
  }
  for (const std::string op : {"[| X |]", "[| X |>", "[X || Y]", "[a <-> b]"}) {
    EXPECT_EQ(parse_expression_text("|| i:S @ [A] P " + op + " Q").codes(), "P003") << op;
  }
  for (const std::string head : {"[]", "|~|", "|||", ";", "[| X |]", "[+ X +]", "[a <-> b]"}) {
    expect_same(head + " i:S @ P ||| Q", head + " i:S @ (P ||| Q)");
  }
}

TEST(SpecialRulesTest, PostfixBindsTighterThanEverything) {
  expect_same("#f(x)", "#(f(x))");
  expect_same("-f(x)(y)", "-((f(x))(y))");
  expect_same("P [] Q[[a <- b]]", "P [] (Q[[a <- b]])");
  expect_same("a.f(x)", "a.(f(x))");
}

TEST(SpecialRulesTest, DoublePatternIsLoosest) {
  const Parsed parsed = parse_text("f(x.y @@ z^<w>) = x\ng((x.y) @@ (z^<w>)) = x\n");
  EXPECT_EQ(parsed.messages(), "");
  EXPECT_EQ(parsed.printed(), "f(x.y @@ z^<w>) = x\ng(x.y @@ z^<w>) = x\n");
}

}  // namespace
}  // namespace perentie::parser

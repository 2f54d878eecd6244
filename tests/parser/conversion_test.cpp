// Patterns, fields and generators made from expressions: the shapes that matter, and what is left
// when nothing takes a `_` or a field. The errors themselves are in the failing corpus.
#include <gtest/gtest.h>

#include <string>

#include "parse_support.hpp"

namespace perentie::parser {
namespace {

TEST(FieldsTest, OneForEachComponent) {
  const ParsedExpression parsed = parse_expression_text("c.1?x.y:A.(z.w)$u!v.(1.2) -> P");
  EXPECT_EQ(parsed.codes(), "P011");
  EXPECT_EQ(parse_expression_text("c.1$u?x.y:A.(z.w)!v.(1.2) -> P").dump(),
            "prefix @1:1\n"
            "  channel: infix . @1:1\n"
            "    name c @1:1\n"
            "    integer 1 @1:3\n"
            "  nondeterministic input $ @1:4\n"
            "    pattern name u @1:5\n"
            "  input ? @1:6\n"
            "    pattern name x @1:7\n"
            "  input ? @1:8\n"
            "    pattern name y @1:9\n"
            "    from: name A @1:11\n"
            "  input ? @1:12\n"
            "    pattern . @1:14\n"
            "      pattern name z @1:14\n"
            "      pattern name w @1:16\n"
            "  output ! @1:18\n"
            "    name v @1:19\n"
            "  output ! @1:20\n"
            "    infix . @1:22\n"
            "      integer 1 @1:22\n"
            "      integer 2 @1:24\n"
            "  body: name P @1:30\n");
}

TEST(FieldsTest, NestedCommunicationsKeepTheirFieldsApart) {
  const ParsedExpression parsed = parse_expression_text("c?x:{d?y!1 -> P}!(e?z -> Q) -> f?u -> R");
  EXPECT_EQ(parsed.messages(), "");
  EXPECT_EQ(parsed.printed(), "c?x:{d?y!1 -> P}!(e?z -> Q) -> f?u -> R");
}

// Fields that no `->` takes must not end up with another prefix.
TEST(FieldsTest, AbandonedFieldsAreForgotten) {
  for (const std::string text : {"c?x:{d?y}?z -> P", "c?x?z:{d?y} -> P", "{d?y, c?x -> P}",
                                 "f(d?y)!z -> P", "c?(d?y)!z -> P", "[] (d?y) <- S @ c?z -> P"}) {
    const ParsedExpression parsed = parse_expression_text(text);
    EXPECT_TRUE(parsed.diagnostics.has_errors()) << text;
    for (const base::Diagnostic& d : parsed.diagnostics.all()) {
      EXPECT_TRUE(d.code->id == "P010" || d.code->id == "P004") << text << parsed.messages();
    }
  }
}

TEST(StatementsTest, ColonAfterDotsAndDoublePatterns) {
  EXPECT_EQ(parse_expression_text("{1 | x.y @@ z : S}").dump(),
            "set @1:1\n"
            "  integer 1 @1:2\n"
            "  generator @1:6\n"
            "    pattern @@ @1:6\n"
            "      pattern . @1:6\n"
            "        pattern name x @1:6\n"
            "        pattern name y @1:8\n"
            "      pattern name z @1:13\n"
            "    from: name S @1:17\n");
  EXPECT_EQ(parse_expression_text("{1 | x.(y : S)}").codes(), "P009");
  EXPECT_EQ(parse_expression_text("{1 | (x : S)}").codes(), "");
}

TEST(SuspectsTest, EachIsReportedOnceAtItsPlace) {
  const ParsedExpression parsed = parse_expression_text("f(_, \\ _ @ _, {_ | _ <- x @@ y})");
  EXPECT_EQ(parsed.codes(), "P008 P008 P008 P008");
}

TEST(PatternsTest, GroupingIsKeptWhereItMatters) {
  const Parsed parsed = parse_text("f(a.b.c, (a.b).c, a.(b.c), x^(<y>^<z>), (x^<y>)^<z>) = 1\n");
  EXPECT_EQ(parsed.printed(), "f(a.b.c, (a.b).c, a.b.c, x^(<y>^<z>), x^<y>^<z>) = 1\n");
}

}  // namespace
}  // namespace perentie::parser

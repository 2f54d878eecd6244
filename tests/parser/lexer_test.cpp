// The lexer's rules one by one; whole files are compared with golden dumps in corpus_test.cpp.
#include "perentie/parser/lexer.hpp"

#include <gtest/gtest.h>

#include <string>

#include "parse_support.hpp"

namespace perentie::parser {
namespace {

std::string kinds(const std::string& text) { return lex_text(text).kinds(); }

std::string codes(const std::string& text) {
  const Lexed lexed = lex_text(text);
  std::string result;
  for (const base::Diagnostic& d : lexed.diagnostics.all()) {
    if (!result.empty()) result += ' ';
    result += d.code->id;
  }
  return result;
}

TEST(LexerTest, EndsWithTheEndOfTheFile) {
  const Lexed lexed = lex_text("x");
  ASSERT_EQ(lexed.stream.tokens.size(), 2U);
  EXPECT_EQ(lexed.stream.tokens[1].kind, TokenKind::end_of_file);
  EXPECT_EQ(lexed.stream.tokens[1].span, (base::Span{1, 1}));
  EXPECT_EQ(lex_text("").stream.tokens.size(), 1U);
}

TEST(LexerTest, SpansCoverTheTokens) {
  const Lexed lexed = lex_text("ab +\t'c'");
  EXPECT_EQ(lexed.stream.tokens[0].span, (base::Span{0, 2}));
  EXPECT_EQ(lexed.stream.tokens[1].span, (base::Span{3, 4}));
  EXPECT_EQ(lexed.stream.tokens[2].span, (base::Span{5, 8}));
}

TEST(LexerTest, WhiteSpace) {  // CSPM reference 1.1.1
  EXPECT_EQ(kinds("a \t\f\v\r b"), "identifier identifier");
  EXPECT_EQ(kinds("a\r\nb\r\n"), "identifier newline identifier");
  EXPECT_EQ(kinds("a +\r\n\f\v1"), "identifier add integer");
}

TEST(LexerTest, ATabIsOneColumn) {  // CSPM reference 1.1.2
  EXPECT_EQ(lex_text("\tx\n\t\ty").dump(),
            "1:2 identifier x\n1:3 newline\n2:3 identifier y\n2:4 end_of_file\n");
}

// Every symbol, keyword and literal against the rule of CSPM reference 1.1.4 and 1.1.5, which is
// written down here once more: these keep a newline before them.
TEST(LexerTest, NewlinesBeforeTokens) {
  const std::vector<std::string> keep = {
      "x",        "(",           "{",        "{|",           "(| ",      "<",
      "-",        "#",           "channel",  "assert",       "datatype", "subtype",
      "external", "transparent", "nametype", "module",       "exports",  "endmodule",
      "instance", "Timed",       "print x",  "include \"x\""};
  const std::vector<std::string> swallow = {
      "[]",     "|~|", "|||",   "/\\",  "->",    "[>",  "|>",  "||", ";",  "&",    "|\\",  "/+",
      "+\\",    "[+",  "+]",    "and",  "or",    "not", "==",  "!=", "<=", ">=",   ">",    ")",
      "|}",     "}",   "|)",    "[[",   "]]",    "[|",  "|]",  "[",  "]",  "|",    ",",    "..",
      ".",      "?",   "!",     "$",    "<-",    "<->", ":",   "=",  "if", "then", "else", "let",
      "within", "\\",  "@",     "@@",   "+",     "*",   "/",   "%",  "^",  "_",    "=>",   "=>*",
      "1",      "'a'", "\"s\"", "true", "false", ":[",  "[T=", ":: "};
  for (const std::string& text : keep) {
    EXPECT_TRUE(kinds("a\n" + text).starts_with("identifier newline ")) << text;
  }
  for (const std::string& text : swallow) {
    EXPECT_FALSE(kinds("a\n" + text).starts_with("identifier newline ")) << text;
  }
}

TEST(LexerTest, NewlinesAfterTokens) {
  for (const std::string text : {"+", "-", "->", "(", "{", "<", "[|", ",", "=", "let", "within",
                                 "if", "and", "@", "channel", "|]", "#", "assert"}) {
    EXPECT_EQ(kinds(text + "\n-- comment\n{- block -}\nx").find("newline"), std::string::npos)
        << text;
  }
  for (const std::string text : {"x", ")", "}", "|}", "]]", "1", "'a'", "true", "_"}) {
    EXPECT_NE(kinds(text + "\nx").find("newline"), std::string::npos) << text;
  }
}

TEST(LexerTest, NewlinesInsideBlockCommentsDoNotCount) {
  EXPECT_EQ(kinds("x {-\n-} y"), "identifier identifier");
  EXPECT_EQ(kinds("x {- -}\n y"), "identifier newline identifier");
}

TEST(LexerTest, SequenceBrackets) {
  EXPECT_EQ(kinds("<x>"), "left_sequence identifier right_sequence");
  EXPECT_EQ(kinds("x < y"), "identifier less identifier");
  EXPECT_EQ(kinds("x > y"), "identifier greater identifier");
  EXPECT_EQ(kinds("<(3 > 2)>"),
            "left_sequence left_paren integer greater integer right_paren right_sequence");
  EXPECT_EQ(kinds("<>"), "left_sequence right_sequence");
  EXPECT_EQ(kinds("<\n>"), "left_sequence right_sequence");
  EXPECT_EQ(kinds("<x>=="), "left_sequence identifier right_sequence equal");
  EXPECT_EQ(kinds("<x>="), "left_sequence identifier greater_equal");
  EXPECT_EQ(kinds("x >== y"), "identifier greater_equal define identifier");
}

// An unclosed `<` does not spoil the declarations after it.
TEST(LexerTest, SequencesEndWithTheirDeclaration) {
  EXPECT_EQ(kinds("<1, 2\nx > y"),
            "left_sequence integer comma integer newline identifier greater identifier");
  EXPECT_EQ(kinds("(<1\nx > y"),
            "left_paren left_sequence integer newline identifier greater "
            "identifier");
}

TEST(LexerTest, Maps) {
  EXPECT_EQ(kinds("(| |)"), "left_map right_map");
  EXPECT_EQ(kinds("(|\n|)"), "left_map right_map");
  EXPECT_EQ(kinds("(||)"), "left_paren alphabet_parallel right_paren");
  EXPECT_EQ(kinds("(|~|"), "left_paren internal_choice");
  EXPECT_EQ(kinds("(|||"), "left_paren interleave");
}

TEST(LexerTest, LongestMatch) {  // CSPM reference 1.6.1, 1.6.2
  EXPECT_EQ(kinds("x<-1"), "identifier drawn_from integer");
  EXPECT_EQ(kinds("a<->b"), "identifier tie identifier");
  EXPECT_EQ(kinds("1->2"), "integer prefix integer");
  EXPECT_EQ(kinds("a--b"), "identifier");
  EXPECT_EQ(kinds("a- -b"), "identifier subtract subtract identifier");
  EXPECT_EQ(kinds("x+\\y"), "identifier right_interrupt identifier");
  EXPECT_EQ(kinds("[|{|a|}|]"),
            "left_parallel left_productions identifier right_productions right_parallel");
  EXPECT_EQ(kinds("=>*=>="), "extendable yields define");
  EXPECT_EQ(kinds("...."), "dots dots");
  EXPECT_EQ(kinds("||||"), "interleave bar");
}

TEST(LexerTest, ScopeAndAnnotation) {  // CSPM reference 1.6.4
  EXPECT_EQ(kinds("a::b"), "identifier scope identifier");
  EXPECT_EQ(kinds("a ::b"), "identifier annotate identifier");
  EXPECT_EQ(kinds("a:: b"), "identifier annotate identifier");
  EXPECT_EQ(kinds("a::\nb"), "identifier annotate identifier");
  EXPECT_EQ(kinds("a::"), "identifier annotate");
}

TEST(LexerTest, KeywordsEndWhereWordsEnd) {
  EXPECT_EQ(kinds("let letter let' let_x"), "let_ identifier identifier identifier");
  EXPECT_EQ(kinds("type True STOP"), "identifier identifier identifier");
}

TEST(LexerTest, BlockCommentsNestAndDashesPairUp) {  // CSPM reference 1.2.2, 1.2.3
  EXPECT_EQ(kinds("{- {- -} -} x"), "identifier");
  EXPECT_EQ(kinds("{- --} still -} x"), "identifier");
  EXPECT_EQ(kinds("{-{{- -} x"), "identifier");
  EXPECT_EQ(codes("x {- {- -}"), "L001");
}

TEST(LexerTest, CharactersAndEscapes) {
  const Lexed lexed = lex_text("'a' '\\n' '\\'' '\\\\' '\\q' '''");
  const std::vector<unsigned> values = {'a', '\n', '\'', '\\', 'q', '\''};
  ASSERT_EQ(lexed.stream.tokens.size(), values.size() + 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(lexed.stream.tokens[i].kind, TokenKind::character);
    EXPECT_EQ(lexed.stream.tokens[i].value, values[i]);
  }
  for (const std::string text : {"''", "'ab'", "'a", "'", "'\n", "'\xC3\xA9'", "'\\\xC3\xA9'"}) {
    EXPECT_EQ(codes(text), "L004") << text;
  }
}

TEST(LexerTest, StringsHoldAnyByte) {
  const Lexed lexed = lex_text("\"a\\\"\\\\\\n\\t\\r\\q\xFF--{-\"");
  ASSERT_EQ(lexed.stream.tokens.size(), 2U);
  EXPECT_EQ(lexed.names[lexed.stream.tokens[0].name()], "a\"\\\n\t\rq\xFF--{-");
  EXPECT_EQ(codes("\"abc\n"), "L003");
  EXPECT_EQ(codes("\"abc\\"), "L003");
}

TEST(LexerTest, Integers) {
  const Lexed lexed = lex_text("0 007 4611686018427387903 4611686018427387904");
  EXPECT_EQ(lexed.stream.integers,
            (std::vector<std::int64_t>{0, 7, 4611686018427387903, 461168601842738790}));
  EXPECT_EQ(lexed.diagnostics.error_count(), 1U);
}

TEST(LexerTest, PrintLines) {  // CSPM reference 1.3.5
  EXPECT_EQ(lex_text("print 1 + 2 \r\nprint\tx\n").dump(),
            "1:7 print \"1 + 2\"\n1:12 newline\n2:7 print \"x\"\n3:1 end_of_file\n");
  EXPECT_EQ(kinds("print(x)"), "identifier left_paren identifier right_paren");
  EXPECT_EQ(kinds("f(print x)"), "identifier left_paren identifier identifier right_paren");
  EXPECT_EQ(kinds("print"), "identifier");
  EXPECT_EQ(kinds("print \t\nx"), "identifier newline identifier");
}

TEST(LexerTest, IncludeLines) {  // CSPM reference 1.3.5, 2.8
  EXPECT_EQ(lex_text("include \"a b.csp\" -- x\n").dump(),
            "1:9 include \"a b.csp\"\n2:1 end_of_file\n");
  for (const std::string text :
       {"include", "include x", "include \"x", "include \"\"", "x include \"y\""}) {
    EXPECT_EQ(codes(text), "L007") << text;
  }
}

TEST(LexerTest, Properties) {  // CSPM reference 1.6.3
  EXPECT_EQ(kinds("P :[deadlock free [FD]]"),
            "identifier property_open property property_model property_close");
  EXPECT_EQ(kinds("P :[ livelock-free\n[ F ] ]:"),
            "identifier property_open property property_model property_close");
  EXPECT_EQ(kinds("P :[partial order reduce [fast]]"),
            "identifier property_open property property_reduction property_close");
  EXPECT_EQ(kinds("x : [y"), "identifier restrict left_bracket identifier");
  EXPECT_EQ(codes("P :[deadlock"), "L009 L010");
  EXPECT_EQ(codes("P :[deterministic\nQ = P"), "L010");
}

TEST(LexerTest, Refinements) {  // CSPM reference 1.6.5
  EXPECT_EQ(lex_text("[T= [F= [FD= [V= [VD= [R= [RD=").dump(),
            "1:1 refines T\n1:5 refines F\n1:9 refines FD\n1:14 refines V\n1:18 refines VD\n"
            "1:23 refines R\n1:27 refines RD\n1:31 end_of_file\n");
  EXPECT_EQ(kinds("[T =="), "left_bracket identifier equal");
  EXPECT_EQ(kinds("[T==x"), "left_bracket identifier equal identifier");
}

TEST(LexerTest, UnreadableTextBecomesErrorTokens) {
  EXPECT_EQ(kinds("a → b"), "identifier error identifier");
  EXPECT_EQ(kinds("a \x01\x02\xFF b"), "identifier error identifier");
  EXPECT_EQ(kinds("a ~ b"), "identifier error identifier");
  EXPECT_EQ(kinds("\xEF\xBB\xBFx"), "identifier");
}

TEST(LexerTest, RichTextIsNotRead) {  // CSPM reference 1.1.11
  const Lexed lexed = lex_text("{\\rtf1\\ansi x = 1}");
  EXPECT_EQ(lexed.stream.tokens.size(), 1U);
  EXPECT_EQ(lexed.diagnostics.error_count(), 1U);
}

TEST(LexerTest, AbandonsWhatIsNoScript) {
  const std::string binary(100000, '\x01');
  std::string spaced;
  for (const char c : binary) spaced += {c, ' '};
  const Lexed lexed = lex_text(spaced);
  EXPECT_LT(lexed.diagnostics.error_count(), 100U);
  EXPECT_EQ(lexed.diagnostics.all().back().code->id, "L008");
}

}  // namespace
}  // namespace perentie::parser

// Properties of the parser on random trees, random tokens, random bytes and damaged scripts.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "parse_support.hpp"
#include "perentie/parser/copy.hpp"
#include "perentie/parser/operators.hpp"
#include "perentie/parser/print.hpp"
#include "perentie/test/paths.hpp"
#include "random_tree.hpp"

namespace perentie::parser {
namespace {

/// Up to `most` choices for a random tree.
rc::Gen<std::vector<std::uint32_t>> choices(std::size_t most) {
  return rc::gen::mapcat(rc::gen::inRange<std::size_t>(0, most), [](std::size_t size) {
    return rc::gen::resize(100, rc::gen::container<std::vector<std::uint32_t>>(
                                    size, rc::gen::inRange<std::uint32_t>(0, 1U << 16U)));
  });
}

/// The first way in which a tree does not survive being printed; empty if it does.
std::string broken_by_printing(const SyntaxTree& tree, std::size_t width) {
  const std::string printed = print_script(tree, {width});
  const Parsed again = parse_text(printed);
  if (again.diagnostics.has_errors()) {
    return "printed text does not parse:\n" + printed + again.messages();
  }
  if (!same_tree(tree, again.tree)) {
    return "printed text parses to another tree:\n" + printed + again.printed();
  }
  if (print_script(again.tree, {width}) != printed) return "printing is not stable:\n" + printed;
  return {};
}

RC_GTEST_PROP(PrintPropertyTest, WhatIsPrintedParsesBack, ()) {
  const SyntaxTree tree = random_script(*choices(400));
  const auto width = *rc::gen::element<std::size_t>(0, 20, 60, 100);
  const std::string broken = broken_by_printing(tree, width);
  if (!broken.empty()) RC_FAIL(broken);
}

// Makes all nodes below the given sizes trivial.
void erase_nodes(SyntaxTree& tree, const SyntaxTree& sizes) {
  const auto erase = [](auto& store, std::size_t count, const auto& node) {
    for (std::uint32_t i = 0; i < count; ++i) store[{i}].node = node;
  };
  erase(tree.exprs, sizes.exprs.size(), WildcardExpr{});
  erase(tree.patterns, sizes.patterns.size(), WildcardPattern{});
  erase(tree.statements, sizes.statements.size(), Filter{});
  erase(tree.types, sizes.types.size(), NamedType{});
  erase(tree.decls, sizes.decls.size(), PrintDecl{});
  for (std::uint32_t i = 0; i < sizes.fields.size(); ++i) tree.fields[FieldId{i}] = Field{};
}

RC_GTEST_PROP(CopyPropertyTest, ACopyIsTheSameAndSharesNoNode, ()) {
  SyntaxTree tree = random_script(*choices(400));
  const SyntaxTree original = tree;
  std::vector<std::string> printed;
  std::vector<DeclId> copies;
  for (const DeclId id : original.list(original.declarations)) {
    printed.push_back(print(original, id));
    copies.push_back(copy_declaration(tree, id));
  }
  erase_nodes(tree, original);
  for (std::size_t i = 0; i < copies.size(); ++i) RC_ASSERT(print(tree, copies[i]) == printed[i]);
}

// The generator reaches every kind of expression, pattern and declaration.
TEST(PrintPropertyTest, TheGeneratorMakesEveryKindOfNode) {
  std::map<std::size_t, int> exprs;
  std::map<std::size_t, int> patterns;
  std::map<std::size_t, int> types;
  std::map<std::size_t, int> decls;
  std::map<InfixOp, int> operators;
  const auto gen = choices(400);
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const SyntaxTree tree = random_script(gen(rc::Random(seed), 100).value());
    for (const Expr& e : tree.exprs) {
      ++exprs[e.node.index()];
      if (const auto* infix = std::get_if<InfixExpr>(&e.node)) ++operators[infix->op];
    }
    for (const Pattern& p : tree.patterns) ++patterns[p.node.index()];
    for (const Type& t : tree.types) ++types[t.node.index()];
    for (const Decl& d : tree.decls) ++decls[d.node.index()];
  }
  // All but WildcardExpr and CommunicationExpr, which no finished tree holds.
  EXPECT_EQ(exprs.size(), std::variant_size_v<decltype(Expr::node)> - 2);
  EXPECT_EQ(patterns.size(), std::variant_size_v<decltype(Pattern::node)>);
  EXPECT_EQ(types.size(), std::variant_size_v<decltype(Type::node)>);
  EXPECT_EQ(decls.size(), std::variant_size_v<decltype(Decl::node)>);
  EXPECT_EQ(operators.size(), infix_table.size() - 12);
}

/// Texts of tokens, every kind of them, beginnings of declarations, and some that are no tokens.
std::vector<std::string> all_words() {
  std::vector<std::string> words = {"x",      "y",           "f",         "P",
                                    "c",      "1",           "'a'",       "\"s\"",
                                    "(| ",    "<",           ">",         "[T=",
                                    ":[",     "[F]",         "]:",        "deadlock free",
                                    "M::x",   "--",          "{-",        "-}",
                                    "~",      "\n",          "print 1\n", "a -> ",
                                    "\nx = ", "x = ",        "\nf(x) = ", "\nchannel c",
                                    "\nP = ", "\xE2\x86\x92"};
#define PERENTIE_TOKEN(id, token_class, spelling, before, after, operand) \
  if (TokenClass::token_class != TokenClass::special) words.emplace_back(spelling);
#include "perentie/parser/token_kinds.def"
#undef PERENTIE_TOKEN
  return words;
}

/// Parses, and prints what has no errors: whatever the text, nothing may break.
void expect_survives(const std::string& text) {
  const Parsed parsed = parse_text(text);
  if (parsed.diagnostics.has_errors()) {
    RC_ASSERT(!parsed.messages().empty());
  } else {
    const std::string broken = broken_by_printing(parsed.tree, 100);
    if (!broken.empty()) RC_FAIL(broken);
  }
}

RC_GTEST_PROP(ParsePropertyTest, AnyTokens, ()) {
  static const std::vector<std::string> words = all_words();
  const auto picks = *rc::gen::container<std::vector<std::string>>(rc::gen::elementOf(words));
  std::string text;
  for (const std::string& word : picks) text += word + (*rc::gen::arbitrary<bool>() ? " " : "");
  expect_survives(text);
}

RC_GTEST_PROP(ParsePropertyTest, AnyBytes, ()) {
  expect_survives(*rc::gen::arbitrary<std::string>());
}

// A script of the corpus with a stretch removed, doubled or replaced.
RC_GTEST_PROP(ParsePropertyTest, DamagedScripts, ()) {
  static const std::vector<std::filesystem::path> files =
      scripts_in(test::corpus() / "parser/pass");
  static const std::vector<std::string> words = all_words();
  std::string text = *base::read_file((*rc::gen::elementOf(files)).generic_string()).text;
  const std::size_t begin = *rc::gen::inRange<std::size_t>(0, text.size());
  const std::size_t length = *rc::gen::inRange<std::size_t>(0, 40);
  const std::string stretch = text.substr(begin, length);
  const std::string instead = *rc::gen::oneOf(
      rc::gen::just(std::string()), rc::gen::just(stretch + stretch), rc::gen::elementOf(words));
  // A tree whose clauses come from two files cannot be printed into one.
  text.replace(begin, stretch.size(), instead);
  RC_PRE(text.find("include") == std::string::npos);
  expect_survives(text);
}

// Positions of every node lie in the text, and parents cover their operands.
RC_GTEST_PROP(ParsePropertyTest, SpansLieInTheText, ()) {
  const Parsed parsed = parse_text(print_script(random_script(*choices(200))));
  const auto size = static_cast<base::Offset>(parsed.sources.text(base::FileId{0}).size());
  for (const Expr& e : parsed.tree.exprs) {
    RC_ASSERT(e.span.begin < e.span.end);
    RC_ASSERT(e.span.end <= size);
    if (const auto* infix = std::get_if<InfixExpr>(&e.node)) {
      RC_ASSERT(e.span.begin <= parsed.tree.exprs[infix->left].span.begin);
      RC_ASSERT(e.span.end >= parsed.tree.exprs[infix->right].span.end);
    }
  }
  for (const Decl& d : parsed.tree.decls) RC_ASSERT(d.span.begin < d.span.end);
}

}  // namespace
}  // namespace perentie::parser

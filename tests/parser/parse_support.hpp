// Texts parsed for tests: the tree with its sources and diagnostics, and short ways to look at
// them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/source.hpp"
#include "perentie/parser/dump.hpp"
#include "perentie/parser/lexer.hpp"
#include "perentie/parser/parse.hpp"
#include "perentie/parser/print.hpp"
#include "perentie/test/corpus.hpp"

namespace perentie::parser {

struct Parsed {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  SyntaxTree tree;

  std::string messages() const { return base::render_all(diagnostics, sources); }
  std::string dump() const { return dump_ast(tree, sources); }
  std::string printed() const { return print_script(tree); }
  /// The codes of all diagnostics, in order.
  std::string codes() const {
    std::string text;
    for (const base::Diagnostic& d : diagnostics.all()) {
      if (!text.empty()) text += ' ';
      text += d.code->id;
    }
    return text;
  }
};

inline Parsed parse_text(std::string text, const ParseOptions& options = {}) {
  Parsed parsed;
  const base::FileId file = *parsed.sources.add("test.csp", std::move(text));
  parsed.tree = parse_script(file, parsed.sources, parsed.diagnostics, options);
  return parsed;
}

inline Parsed parse_file(const std::filesystem::path& path) {
  Parsed parsed;
  base::FileText text = base::read_file(path.generic_string());
  const base::FileId file =
      *parsed.sources.add(path.generic_string(), std::move(text.text).value_or(""));
  parsed.tree = parse_script(file, parsed.sources, parsed.diagnostics);
  return parsed;
}

struct Lexed {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  base::Interner names;
  TokenStream stream;

  std::string messages() const { return base::render_all(diagnostics, sources); }
  std::string dump() const { return dump_tokens(stream, names, sources); }
  /// The kinds and values of all tokens but the last, in one line.
  std::string kinds() const {
    std::string text;
    for (std::size_t i = 0; i + 1 < stream.tokens.size(); ++i) {
      if (i > 0) text += ' ';
      text += info(stream.tokens[i].kind).id;
    }
    return text;
  }
};

inline Lexed lex_text(std::string text, std::string path = "test.csp") {
  Lexed lexed;
  const base::FileId file = *lexed.sources.add(std::move(path), std::move(text));
  lexed.stream = lex(file, lexed.sources, lexed.names, lexed.diagnostics);
  return lexed;
}

/// An expression with its tree.
struct ParsedExpression : Parsed {
  ExprId expression;

  std::string dump() const { return dump_ast(tree, expression, sources); }
  std::string printed() const { return print(tree, expression); }
};

inline ParsedExpression parse_expression_text(std::string text, const ParseOptions& options = {}) {
  ParsedExpression parsed;
  const base::FileId file = *parsed.sources.add("test.csp", std::move(text));
  parsed.expression =
      parse_expression(file, parsed.tree, parsed.sources, parsed.diagnostics, options);
  return parsed;
}

using test::scripts_in;

}  // namespace perentie::parser

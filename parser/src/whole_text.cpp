#include "whole_text.hpp"

#include "grammar/grammar.hpp"
#include "lexer_state.hpp"
#include "syntax_error.hpp"

namespace perentie::parser {
namespace {

const Token* skip_newlines(const Token* t) {
  while (t->kind == TokenKind::newline) ++t;
  return t;
}

void require_end(const Token* t) {
  t = skip_newlines(t);
  if (t->kind == TokenKind::end_of_file) return;
  throw grammar::SyntaxError{t, "an operator or the end of the text"};
}

}  // namespace

ExprId read_whole_expression(Builder& builder) {
  const std::vector<Token>& tokens = builder.context.stream.tokens;
  const std::size_t errors = builder.context.diagnostics.error_count();
  const Token* end = tokens.data() + tokens.size();
  const Token* first = skip_newlines(tokens.data());
  ExprId result;
  const bool failed = attempt(builder, first, [&] {
                        require_end(grammar::parse_expression(first, end, builder, result));
                      }).has_value();
  return failed || builder.context.diagnostics.error_count() > errors ? ExprId{} : result;
}

std::optional<Assertion> read_whole_assertion(Builder& builder) {
  const std::vector<Token>& tokens = builder.context.stream.tokens;
  const std::size_t errors = builder.context.diagnostics.error_count();
  const Token* end = tokens.data() + tokens.size();
  const Token* first = skip_newlines(tokens.data());
  const bool failed = attempt(builder, first, [&] {
                        const Token* claim = first->kind == TokenKind::assert_ ? first + 1 : first;
                        require_end(grammar::parse_assertion(claim, end, builder));
                      }).has_value();
  if (failed || builder.context.diagnostics.error_count() > errors) return std::nullopt;
  return builder.assertions.finished();
}

TokenStream lex_stretch(base::Span stretch, const base::SourceMap& sources, base::Interner& names,
                        base::Diagnostics& diagnostics) {
  TokenStream stream;
  Lexer lexer(stretch, sources, names, diagnostics, stream);
  while (lexer.run() == Lexer::Stop::after_include) {
  }
  stream.tokens.push_back({TokenKind::end_of_file, 0, {stretch.end, stretch.end}});
  return stream;
}

}  // namespace perentie::parser

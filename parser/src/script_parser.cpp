#include "script_parser.hpp"

#include <optional>

#include "grammar/grammar.hpp"
#include "perentie/parser/diagnostic_codes.hpp"
#include "recovery.hpp"
#include "syntax_error.hpp"
#include "whole_text.hpp"

namespace perentie::parser {

using K = TokenKind;

ScriptParser::ScriptParser(Builder& builder)
    : builder_(builder),
      context_(builder.context),
      at_(context_.stream.tokens.data()),
      end_(at_ + context_.stream.tokens.size()) {}

DeclList ScriptParser::parse() {
  const DeclarationBuilder::Mark mark = builder_.declarations.mark();
  while (true) {
    while (at_->kind == K::newline) ++at_;
    if (at_->kind == K::end_of_file) break;
    parse_item();
  }
  report_open_blocks();
  return builder_.declarations.take(mark);
}

void ScriptParser::parse_item() {
  const Token* first = at_;
  const DeclarationBuilder::Mark mark = builder_.declarations.mark();
  const std::size_t errors = context_.diagnostics.error_count();
  const std::size_t blocks = blocks_.size();
  const std::optional<const Token*> failure = attempt(builder_, first, [this] { read_item(); });
  if (failure) {
    at_ = blocks_.size() > blocks && first->kind == K::timed_
              ? after_broken_head(*failure)
              : recover(first, *failure, in_timed_section(), context_.sources);
  }
  // At the end of a block `mark` may lie behind what is left, and nothing is dropped.
  if (failure || context_.diagnostics.error_count() > errors) builder_.declarations.drop(mark);
}

// Into the section, if its `{` follows on the line.
const Token* ScriptParser::after_broken_head(const Token* failure) const {
  while (failure->kind != K::newline && failure->kind != K::end_of_file) {
    if ((failure++)->kind == K::left_brace) break;
  }
  return failure;
}

void ScriptParser::read_item() {
  switch (at_->kind) {
    case K::module_:
      return open_module();
    case K::exports_:
      return export_module();
    case K::endmodule_:
      return close_module();
    case K::timed_:
      return open_timed();
    case K::print_:
      return read_print();
    case K::right_brace:
      if (in_timed_section()) return close_timed();
      break;
    default:
      break;
  }
  const Token* first = at_;
  at_ = grammar::parse_declaration(at_, end_, builder_);
  require_end();
  if (!same_file(first, at_ - 1)) {
    context_.report(codes::unexpected_token, first->span,
                    "this declaration does not end in the file in which it begins");
  }
}

// A declaration ends with its line, or where its block ends.
void ScriptParser::require_end() const {
  const K next = at_->kind;
  if (next == K::newline || next == K::end_of_file || next == K::exports_ ||
      next == K::endmodule_ || (next == K::right_brace && in_timed_section())) {
    return;
  }
  throw grammar::SyntaxError{at_, "an operator or the end of the line"};
}

bool ScriptParser::in_timed_section() const {
  return !blocks_.empty() && blocks_.back().kind == Block::Kind::timed;
}

// The text of a print line is an expression of its own. If it cannot be read, that matters only
// when it is to be printed (11.13).
void ScriptParser::read_print() {
  const Token* token = at_++;
  base::Diagnostics complaints;
  const TokenStream stream =
      lex_stretch(token->span, context_.sources, context_.tree.names, complaints);
  Builder builder({context_.tree, context_.sources, complaints, stream, context_.max_depth});
  ExprId expression = read_whole_expression(builder);
  if (complaints.has_errors()) {
    expression = {};
    const base::Diagnostic& first = complaints.all().front();
    context_
        .report(codes::unreadable_print, token->span, "the text after `print` is not an expression")
        .notes.push_back({first.span, first.message});
  }
  builder_.declarations.print(token, expression);
  require_end();
}

// ---------------------------------------------------------------------------------------------
// Blocks

ScriptParser::Block& ScriptParser::push_block(Block::Kind kind) {
  blocks_.push_back({kind, at_, place_, builder_.declarations.mark(), {}, {}, {}, {}, true});
  if (kind != Block::Kind::timed) place_ = Place::module;
  if (kind == Block::Kind::timed && place_ == Place::script) place_ = Place::timed_section;
  builder_.declarations.set_place(place_);
  return blocks_.back();
}

void ScriptParser::pop_block() {
  place_ = blocks_.back().outer_place;
  builder_.declarations.set_place(place_);
  blocks_.pop_back();
}

void ScriptParser::open_module() {
  Block& block = push_block(Block::Kind::hidden_part);
  grammar::ModuleHead head;
  at_ = grammar::parse_module_head(at_, end_, builder_, head);
  block.name = head.name;
  block.parameters = head.parameters;
  block.broken = false;
}

void ScriptParser::export_module() {
  const Token* keyword = at_++;
  if (blocks_.empty() || blocks_.back().kind != Block::Kind::hidden_part) {
    context_.report(codes::unbalanced_block, keyword->span,
                    "`exports` stands once in a module, and nowhere else");
    return;
  }
  blocks_.back().hidden = builder_.declarations.take(blocks_.back().mark);
  blocks_.back().kind = Block::Kind::exported_part;
}

void ScriptParser::close_module() {
  const Token* keyword = at_++;
  if (blocks_.empty() || in_timed_section()) {
    context_.report(codes::unbalanced_block, keyword->span,
                    "no module is open here that `endmodule` closes");
    return;
  }
  const Block block = blocks_.back();
  if (block.kind == Block::Kind::hidden_part && !block.broken) {
    context_
        .report(codes::unbalanced_block, keyword->span,
                "a module needs the word `exports` before `endmodule`, even if it exports nothing")
        .notes.push_back({block.keyword->span, "the module begins here"});
  }
  const DeclList exported = builder_.declarations.take(block.mark);
  pop_block();
  if (block.broken) return;
  builder_.declarations.module(span_of(block.keyword, keyword), block.name, block.parameters,
                               block.hidden, exported);
  require_end();
}

void ScriptParser::open_timed() {
  Block& block = push_block(Block::Kind::timed);
  at_ = grammar::parse_timed_head(at_, end_, builder_, block.duration);
  block.broken = false;
}

void ScriptParser::close_timed() {
  const Token* brace = at_++;
  const Block block = blocks_.back();
  const DeclList declarations = builder_.declarations.take(block.mark);
  pop_block();
  if (block.broken) return;
  builder_.declarations.timed(span_of(block.keyword, brace), block.duration, declarations);
  require_end();
}

void ScriptParser::report_open_blocks() {
  for (; !blocks_.empty(); pop_block()) {
    const Block& block = blocks_.back();
    if (block.broken) continue;
    const bool is_timed = block.kind == Block::Kind::timed;
    context_.report(codes::unbalanced_block, block.keyword->span,
                    is_timed ? "this timed section is not closed by `}`"
                             : "this module is not closed by `endmodule`");
  }
}

// A block may be closed in another file than it was opened in; a span may not.
Span ScriptParser::span_of(const Token* first, const Token* last) const {
  return same_file(first, last) ? cover(first, last) : first->span;
}

bool ScriptParser::same_file(const Token* first, const Token* last) const {
  return context_.sources.file_of(first->span.begin) == context_.sources.file_of(last->span.begin);
}

}  // namespace perentie::parser

// The operands of expressions: names, literals, brackets, calls and renamings.
#include <fmt/format.h>

#include "builder/operator_run.hpp"
#include "perentie/parser/diagnostic_codes.hpp"

namespace perentie::parser {
namespace {

Collection collection_of(TokenKind open) {
  switch (open) {
    case TokenKind::left_brace:
      return Collection::set;
    case TokenKind::left_productions:
      return Collection::productions;
    default:
      return Collection::sequence;
  }
}

}  // namespace

ExprId ExpressionBuilder::name(QualifiedName name, const Token* last) {
  // A name of n parts is 2n - 1 tokens.
  const Token* first = last - 2 * (name.parts.count - 1);
  return context_->add(cover(first, last), NameExpr{name});
}

ExprId ExpressionBuilder::literal(const Token* token) {
  switch (token->kind) {
    case TokenKind::integer:
      return context_->add(token->span, IntExpr{context_->stream.integers[token->value]});
    case TokenKind::true_:
      return context_->add(token->span, BoolExpr{true});
    case TokenKind::false_:
      return context_->add(token->span, BoolExpr{false});
    case TokenKind::character:
      return context_->add(token->span, CharExpr{static_cast<unsigned char>(token->value)});
    case TokenKind::string:
      return context_->add(token->span, StringExpr{token->name()});
    default:
      break;
  }
  const ExprId wildcard = context_->add(token->span, WildcardExpr{});
  converter_->suspect(wildcard);
  return wildcard;
}

ExprId ExpressionBuilder::paren(const Token* open, ExprList items, const Token* close) {
  if (items.count == 1) return context_->tree.list(items)[0];
  return context_->add(cover(open, close), TupleExpr{items});
}

ExprId ExpressionBuilder::map(const Token* open, ExprList pairs, const Token* close) {
  const Ties split = ties(context_->tree.list(pairs), std::nullopt);
  return context_->add(cover(open, close), MapExpr{split.from, split.to});
}

ExprId ExpressionBuilder::collection(const Token* open, ExprList items,
                                     std::optional<RangeEnd> range,
                                     std::optional<StatementList> statements, const Token* close) {
  const Span span = cover(open, close);
  const Collection kind = collection_of(open->kind);
  if (!range) {
    return context_->add(span, CollectionExpr{kind, items, statements.value_or(StatementList{})});
  }
  if (kind == Collection::productions || items.count != 1) {
    context_->report(
        codes::bad_range, span,
        kind == Collection::productions
            ? "`{| |}` holds events or values, not a range"
            : fmt::format("a range has one expression before `..`, this has {}", items.count));
    return context_->add(span, CollectionExpr{kind, items, statements.value_or(StatementList{})});
  }
  const ExprId first = context_->tree.list(items)[0];
  return context_->add(span,
                       RangeExpr{kind, first, range->last, statements.value_or(StatementList{})});
}

void ExpressionBuilder::apply(ExprList arguments, const Token* close) {
  Operand& top = operands_.back();
  top.span = base::cover(top.span, close->span);
  top.expr = context_->add(top.span, ApplyExpr{top.expr, arguments});
}

void ExpressionBuilder::rename(ExprList pairs, std::optional<StatementList> statements,
                               const Token* close) {
  Operand& top = operands_.back();
  top.span = base::cover(top.span, close->span);
  top.expr =
      context_->add(top.span, RenameExpr{top.expr, ties(context_->tree.list(pairs), statements)});
}

// The members of the pairs come in turns: from, to, from, to.
Ties ExpressionBuilder::ties(std::span<const ExprId> pairs,
                             std::optional<StatementList> statements) {
  std::vector<ExprId> from;
  std::vector<ExprId> to;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    from.push_back(pairs[i]);
    to.push_back(pairs[i + 1]);
  }
  SyntaxTree& tree = context_->tree;
  return {tree.expr_lists.add(from), tree.expr_lists.add(to), statements.value_or(StatementList{})};
}

}  // namespace perentie::parser

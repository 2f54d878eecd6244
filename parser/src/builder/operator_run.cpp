#include "builder/operator_run.hpp"

#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "perentie/base/check.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/parser/diagnostic_codes.hpp"

namespace perentie::parser {
namespace {

/// The operator that a token is between two operands, for those that are one token.
InfixOp infix_op_of(TokenKind kind) {
  switch (kind) {
#define PERENTIE_SIMPLE_INFIX(id) \
  case TokenKind::id:             \
    return InfixOp::id
    PERENTIE_SIMPLE_INFIX(concat);
    PERENTIE_SIMPLE_INFIX(multiply);
    PERENTIE_SIMPLE_INFIX(divide);
    PERENTIE_SIMPLE_INFIX(modulo);
    PERENTIE_SIMPLE_INFIX(add);
    PERENTIE_SIMPLE_INFIX(subtract);
    PERENTIE_SIMPLE_INFIX(equal);
    PERENTIE_SIMPLE_INFIX(not_equal);
    PERENTIE_SIMPLE_INFIX(less);
    PERENTIE_SIMPLE_INFIX(less_equal);
    PERENTIE_SIMPLE_INFIX(greater);
    PERENTIE_SIMPLE_INFIX(greater_equal);
    PERENTIE_SIMPLE_INFIX(restrict);
    PERENTIE_SIMPLE_INFIX(dot);
    PERENTIE_SIMPLE_INFIX(input);
    PERENTIE_SIMPLE_INFIX(output);
    PERENTIE_SIMPLE_INFIX(nondet_input);
    PERENTIE_SIMPLE_INFIX(guard);
    PERENTIE_SIMPLE_INFIX(prefix);
    PERENTIE_SIMPLE_INFIX(sequential);
    PERENTIE_SIMPLE_INFIX(sliding_choice);
    PERENTIE_SIMPLE_INFIX(interrupt);
    PERENTIE_SIMPLE_INFIX(external_choice);
    PERENTIE_SIMPLE_INFIX(internal_choice);
    PERENTIE_SIMPLE_INFIX(interleave);
    PERENTIE_SIMPLE_INFIX(hide);
    PERENTIE_SIMPLE_INFIX(project);
    PERENTIE_SIMPLE_INFIX(double_pattern);
#undef PERENTIE_SIMPLE_INFIX
    case TokenKind::and_:
      return InfixOp::logical_and;
    case TokenKind::or_:
      return InfixOp::logical_or;
    default:
      PERENTIE_CHECK(false, "a token that is no infix operator");
  }
}

ReplicatedOp replicated_op_of(TokenKind kind) {
  switch (kind) {
    case TokenKind::sequential:
      return ReplicatedOp::sequential;
    case TokenKind::external_choice:
      return ReplicatedOp::external_choice;
    case TokenKind::internal_choice:
      return ReplicatedOp::internal_choice;
    case TokenKind::interleave:
      return ReplicatedOp::interleave;
    case TokenKind::left_parallel:
      return ReplicatedOp::parallel;
    case TokenKind::left_sync:
      return ReplicatedOp::sync_choice;
    default:
      PERENTIE_CHECK(false, "a token that is no replicated operator");
  }
}

/// The infix operators that give way when they stand at the root of a hiding's right operand
/// (1.7.7): `P \ A ||| Q` is `(P \ A) ||| Q`. Returns the slot of the left operand.
ExprId* yielding_left(Expr& e) {
  const auto left_of = [](auto& node) { return &node.left; };
  return std::visit(base::overload{
                        [](InfixExpr& n) -> ExprId* {
                          switch (n.op) {
                            case InfixOp::interleave:
                            case InfixOp::internal_choice:
                            case InfixOp::external_choice:
                            case InfixOp::interrupt:
                            case InfixOp::sliding_choice:
                            case InfixOp::sequential:
                              return &n.left;
                            default:
                              return nullptr;
                          }
                        },
                        [&](ParallelExpr& n) { return left_of(n); },
                        [&](AlphabetParallelExpr& n) { return left_of(n); },
                        [&](ExceptionExpr& n) { return left_of(n); },
                        [&](SyncChoiceExpr& n) { return left_of(n); },
                        [&](SyncInterruptExpr& n) { return left_of(n); },
                        [](auto&) -> ExprId* { return nullptr; },
                    },
                    e.node);
}

std::string spelling_of(const Expr& pending, bool is_prefix) {
  if (is_prefix) return "|| .. @";
  return std::visit(base::overload{
                        [](const InfixExpr& n) { return std::string(info(n.op).spelling); },
                        [](const ParallelExpr&) { return std::string("[| |]"); },
                        [](const AlphabetParallelExpr&) { return std::string("[ || ]"); },
                        [](const ExceptionExpr&) { return std::string("[| |>"); },
                        [](const LinkParallelExpr&) { return std::string("[ <-> ]"); },
                        [](const auto&) { return std::string("this operator"); },
                    },
                    pending.node);
}

}  // namespace

// ---------------------------------------------------------------------------------------------
// Runs

ExpressionBuilder::Run ExpressionBuilder::begin_run(const Token* first) {
  const Run run{operands_.size(), operators_.size(), base_, context_->depth, complained_};
  context_->descend(first);
  base_ = operators_.size();
  complained_ = false;
  return run;
}

ExprId ExpressionBuilder::end_run(const Run& run) {
  while (operators_.size() > run.operators) reduce();
  PERENTIE_CHECK(operands_.size() == run.operands + 1, "an expression is not one operand");
  const ExprId result = operands_.back().expr;
  abandon_run(run);
  return result;
}

void ExpressionBuilder::abandon_run(const Run& run) {
  operands_.resize(run.operands);
  operators_.resize(run.operators, Operator{{{}, WildcardExpr{}}, 0, Associativity::none, false});
  base_ = run.outer_base;
  context_->depth = run.depth;
  complained_ = run.outer_complained;
}

void ExpressionBuilder::clear() {
  operands_.clear();
  operators_.clear();
  base_ = 0;
  complained_ = false;
}

// ---------------------------------------------------------------------------------------------
// Prefix operators

void ExpressionBuilder::push_prefix(const Token* op, std::uint8_t level, Expr node) {
  context_->descend(op);
  operators_.push_back({std::move(node), level, Associativity::none, true});
}

void ExpressionBuilder::unary(const Token* op) {
  switch (op->kind) {
    case TokenKind::subtract:
      return push_prefix(op, level_negate, {op->span, NegateExpr{}});
    case TokenKind::not_:
      return push_prefix(op, level_not, {op->span, NotExpr{}});
    default:
      return push_prefix(op, level_length, {op->span, LengthExpr{}});
  }
}

void ExpressionBuilder::if_head(const Token* op, ExprId condition, ExprId then_branch) {
  push_prefix(op, level_open, {op->span, IfExpr{condition, then_branch, {}}});
}

void ExpressionBuilder::let_head(const Token* op, DeclList declarations) {
  push_prefix(op, level_open, {op->span, LetExpr{declarations, {}}});
}

void ExpressionBuilder::lambda_head(const Token* op, PatternList parameters) {
  push_prefix(op, level_open, {op->span, LambdaExpr{parameters, {}}});
}

void ExpressionBuilder::replicated_head(const Token* op, StatementList statements) {
  bracket_head(op, {}, statements);
}

void ExpressionBuilder::bracket_head(const Token* op, ExprId alphabet, StatementList statements) {
  push_prefix(op, level_replicated,
              {op->span, ReplicatedExpr{replicated_op_of(op->kind), alphabet, statements, {}}});
}

// The body of `|| s @ [A] P` reaches only as far as that of a level-20 operator (11.1).
void ExpressionBuilder::alphabet_head(const Token* op, StatementList statements, ExprId alphabet) {
  push_prefix(
      op, info(InfixOp::alphabet_parallel).level,
      {op->span, ReplicatedExpr{ReplicatedOp::alphabet_parallel, alphabet, statements, {}}});
}

void ExpressionBuilder::link_head(const Token* op, ExprList pairs,
                                  std::optional<StatementList> tie_statements,
                                  StatementList statements) {
  const Ties links = ties(context_->tree.list(pairs), tie_statements);
  push_prefix(op, level_replicated, {op->span, ReplicatedLinkExpr{links, statements, {}}});
}

// ---------------------------------------------------------------------------------------------
// Infix operators

void ExpressionBuilder::infix(const Token* op) {
  const InfixOp o = infix_op_of(op->kind);
  push_infix(o, {op->span, InfixExpr{o, {}, {}}});
}

void ExpressionBuilder::bracket_infix(const Token* open, ExprId alphabet, const Token* close) {
  switch (close->kind) {
    case TokenKind::right_parallel:
      return push_infix(InfixOp::parallel, {open->span, ParallelExpr{{}, alphabet, {}}});
    case TokenKind::right_exception:
      return push_infix(InfixOp::exception, {open->span, ExceptionExpr{{}, alphabet, {}}});
    case TokenKind::right_sync:
      return push_infix(InfixOp::sync_choice, {open->span, SyncChoiceExpr{{}, alphabet, {}}});
    default:
      return push_infix(InfixOp::sync_interrupt, {open->span, SyncInterruptExpr{{}, alphabet, {}}});
  }
}

void ExpressionBuilder::square_infix(const Token* open, ExprId first, BracketRest rest) {
  if (rest.alphabet) {
    return push_infix(InfixOp::alphabet_parallel,
                      {open->span, AlphabetParallelExpr{{}, first, rest.alphabet, {}}});
  }
  std::vector<ExprId> pairs{first, rest.first_to};
  const std::span<const ExprId> more = context_->tree.list(rest.more_ties);
  pairs.insert(pairs.end(), more.begin(), more.end());
  push_infix(InfixOp::link_parallel,
             {open->span, LinkParallelExpr{{}, ties(pairs, rest.statements), {}}});
}

void ExpressionBuilder::push_infix(InfixOp op, Expr node) {
  const InfixInfo& i = info(op);
  Operator incoming{std::move(node), i.level, i.associativity, false};
  while (operators_.size() > base_) {
    const Operator& top = operators_.back();
    if (top.level > incoming.level) break;
    if (top.level == incoming.level && incoming.associativity == Associativity::right) break;
    if (top.level == incoming.level && incoming.associativity == Associativity::none) {
      complain_about_association(top, incoming);
    }
    reduce();
  }
  operators_.push_back(std::move(incoming));
}

void ExpressionBuilder::complain_about_association(const Operator& first, const Operator& second) {
  if (std::exchange(complained_, true)) return;
  const std::string before = spelling_of(first.node, first.is_prefix);
  const std::string after = spelling_of(second.node, second.is_prefix);
  context_
      ->report(codes::does_not_associate, second.node.span,
               before == after ? fmt::format("`{}` does not associate: write parentheses", after)
                               : fmt::format("`{}` and `{}` do not associate: write parentheses",
                                             before, after))
      .notes.push_back({first.node.span, fmt::format("the first `{}` is here", before)});
}

// ---------------------------------------------------------------------------------------------
// Completing operators

void ExpressionBuilder::reduce() {
  Operator op = std::move(operators_.back());
  operators_.pop_back();
  const Operand right = operands_.back();
  operands_.pop_back();
  if (op.is_prefix) {
    --context_->depth;
    const Span span = base::cover(op.node.span, right.span);
    std::visit(base::overload{
                   [&](NegateExpr& n) { n.operand = right.expr; },
                   [&](NotExpr& n) { n.operand = right.expr; },
                   [&](LengthExpr& n) { n.operand = right.expr; },
                   [&](IfExpr& n) { n.else_branch = right.expr; },
                   [&](LetExpr& n) { n.body = right.expr; },
                   [&](LambdaExpr& n) { n.body = right.expr; },
                   [&](ReplicatedExpr& n) { n.body = right.expr; },
                   [&](ReplicatedLinkExpr& n) { n.body = right.expr; },
                   [](auto&) { PERENTIE_CHECK(false, "not a prefix operator"); },
               },
               op.node.node);
    operands_.push_back({context_->tree.exprs.add({span, std::move(op.node.node)}), span});
    return;
  }
  const Operand left = operands_.back();
  operands_.pop_back();
  const Span span = base::cover(left.span, right.span);
  operands_.push_back({finish_infix(std::move(op.node), left, right), span});
}

ExprId ExpressionBuilder::finish_infix(Expr node, Operand left, Operand right) {
  if (const auto* simple = std::get_if<InfixExpr>(&node.node)) {
    return finish_simple(*simple, node.span, left, right);
  }
  const auto fill = [&](auto& n) {
    n.left = left.expr;
    n.right = right.expr;
  };
  std::visit(base::overload{
                 [&](ParallelExpr& n) { fill(n); },
                 [&](AlphabetParallelExpr& n) { fill(n); },
                 [&](ExceptionExpr& n) { fill(n); },
                 [&](SyncChoiceExpr& n) { fill(n); },
                 [&](SyncInterruptExpr& n) { fill(n); },
                 [&](LinkParallelExpr& n) { fill(n); },
                 [](auto&) { PERENTIE_CHECK(false, "not an infix operator"); },
             },
             node.node);
  node.span = base::cover(left.span, right.span);
  return context_->tree.exprs.add(std::move(node));
}

ExprId ExpressionBuilder::finish_simple(InfixExpr infix, Span op, Operand left, Operand right) {
  const Span span = base::cover(left.span, right.span);
  switch (infix.op) {
    case InfixOp::prefix:
      return finish_prefix_arrow(span, left, right.expr);
    case InfixOp::hide:
    case InfixOp::project:
      return finish_hiding(infix.op, span, left, right);
    case InfixOp::input:
      return converter_->communication(FieldKind::input, op, left, right);
    case InfixOp::output:
      return converter_->communication(FieldKind::output, op, left, right);
    case InfixOp::nondet_input:
      return converter_->communication(FieldKind::nondet_input, op, left, right);
    default:
      break;
  }
  if (infix.op == InfixOp::dot) warn_about_comparison(right.expr);
  infix.left = left.expr;
  infix.right = right.expr;
  const ExprId result = context_->add(span, infix);
  if (infix.op == InfixOp::restrict || infix.op == InfixOp::double_pattern) {
    converter_->suspect(result);
  }
  return result;
}

ExprId ExpressionBuilder::finish_prefix_arrow(Span span, Operand left, ExprId body) {
  const Expr& channel = context_->tree.exprs[left.expr];
  const auto* communication = std::get_if<CommunicationExpr>(&channel.node);
  if (communication == nullptr || left.span != channel.span) {
    return context_->add(span, PrefixExpr{left.expr, {}, body});
  }
  const ExprId base = communication->channel;
  return context_->add(span, PrefixExpr{base, converter_->take_fields(left.expr), body});
}

// `P \ A ||| Q` is read as `P \ (A ||| Q)` by the table. The operators that yield are re-rooted
// above the hiding, from the root of the right operand down its left operands (1.7.7).
ExprId ExpressionBuilder::finish_hiding(InfixOp op, Span span, Operand left, Operand right) {
  SyntaxTree& tree = context_->tree;
  ExprId hidden = right.expr;
  ExprId parent;
  bool in_parentheses = right.span != tree.exprs[hidden].span;
  while (!in_parentheses) {
    const ExprId* next = yielding_left(tree.exprs[hidden]);
    if (next == nullptr) break;
    parent = hidden;
    hidden = *next;
    in_parentheses = left_in_parentheses(tree, parent, hidden);
    tree.exprs[parent].span.begin = span.begin;
  }
  if (parent.is_none()) return context_->add(span, InfixExpr{op, left.expr, hidden});
  const Span hiding{span.begin, tree.exprs[hidden].span.end};
  *yielding_left(tree.exprs[parent]) = context_->add(hiding, InfixExpr{op, left.expr, hidden});
  return right.expr;
}

// `c.x == d.y` is `c.(x == d).y` (1.7.1), and hardly ever meant.
void ExpressionBuilder::warn_about_comparison(ExprId right) {
  const SyntaxTree& tree = context_->tree;
  const auto* rest = std::get_if<InfixExpr>(&tree.exprs[right].node);
  if (rest == nullptr || rest->op != InfixOp::dot) return;
  const auto* comparison = std::get_if<InfixExpr>(&tree.exprs[rest->left].node);
  if (comparison == nullptr || info(comparison->op).level != info(InfixOp::equal).level) return;
  if (left_in_parentheses(tree, right, rest->left)) return;
  const std::string_view sign = info(comparison->op).spelling;
  context_
      ->report(codes::comparison_in_dot, tree.exprs[rest->left].span,
               fmt::format("`.` binds looser than `{}`, so this comparison is one component of a "
                           "dotted value",
                           sign))
      .notes.push_back(
          {std::nullopt, fmt::format("to compare events write `(c.x) {} (d.y)`", sign)});
}

}  // namespace perentie::parser

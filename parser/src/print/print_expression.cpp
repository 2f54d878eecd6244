// Expressions: which parentheses they need, and how long ones are broken.
#include <algorithm>
#include <optional>
#include <utility>

#include "perentie/base/overload.hpp"
#include "perentie/parser/operators.hpp"
#include "print/printer.hpp"

namespace perentie::parser {
namespace {

std::optional<InfixOp> infix_of(const Expr& e) {
  using Result = std::optional<InfixOp>;
  return std::visit(
      base::overload{
          [](const InfixExpr& n) { return Result(n.op); },
          [](const PrefixExpr&) { return Result(InfixOp::prefix); },
          [](const ParallelExpr&) { return Result(InfixOp::parallel); },
          [](const AlphabetParallelExpr&) { return Result(InfixOp::alphabet_parallel); },
          [](const ExceptionExpr&) { return Result(InfixOp::exception); },
          [](const LinkParallelExpr&) { return Result(InfixOp::link_parallel); },
          [](const SyncChoiceExpr&) { return Result(InfixOp::sync_choice); },
          [](const SyncInterruptExpr&) { return Result(InfixOp::sync_interrupt); },
          [](const auto&) { return Result(); },
      },
      e.node);
}

/// The left and right operands of an infix node; a prefix's left operand is its channel.
std::pair<ExprId, ExprId> operands_of(const Expr& e) {
  using Result = std::pair<ExprId, ExprId>;
  return std::visit(base::overload{
                        [](const InfixExpr& n) { return Result(n.left, n.right); },
                        [](const PrefixExpr& n) { return Result(n.channel, n.body); },
                        [](const ParallelExpr& n) { return Result(n.left, n.right); },
                        [](const AlphabetParallelExpr& n) { return Result(n.left, n.right); },
                        [](const ExceptionExpr& n) { return Result(n.left, n.right); },
                        [](const LinkParallelExpr& n) { return Result(n.left, n.right); },
                        [](const SyncChoiceExpr& n) { return Result(n.left, n.right); },
                        [](const SyncInterruptExpr& n) { return Result(n.left, n.right); },
                        [](const auto&) { return Result(); },
                    },
                    e.node);
}

/// The level of an operator that stands before its only operand, or before its last one.
std::optional<std::uint8_t> prefix_level_of(const Expr& e) {
  using Result = std::optional<std::uint8_t>;
  return std::visit(base::overload{
                        [](const NegateExpr&) { return Result(level_negate); },
                        [](const NotExpr&) { return Result(level_not); },
                        [](const LengthExpr&) { return Result(level_length); },
                        [](const IfExpr&) { return Result(level_open); },
                        [](const LetExpr&) { return Result(level_open); },
                        [](const LambdaExpr&) { return Result(level_open); },
                        [](const ReplicatedExpr& n) {
                          return Result(n.op == ReplicatedOp::alphabet_parallel
                                            ? info(InfixOp::alphabet_parallel).level
                                            : level_replicated);
                        },
                        [](const ReplicatedLinkExpr&) { return Result(level_replicated); },
                        [](const auto&) { return Result(); },
                    },
                    e.node);
}

constexpr std::uint8_t tighter(std::uint8_t level) { return static_cast<std::uint8_t>(level - 1); }

bool is_hiding(InfixOp op) { return op == InfixOp::hide || op == InfixOp::project; }

/// The operators that are re-rooted above a hiding to their left (1.7.7).
bool gives_way(InfixOp op) {
  const std::uint8_t level = info(op).level;
  return level >= info(InfixOp::sequential).level && level < info(InfixOp::hide).level &&
         op != InfixOp::link_parallel;
}

/// Whether the operator may begin a line: `-` and `<` may not, they would begin a declaration.
bool may_begin_line(InfixOp op) { return op != InfixOp::subtract && op != InfixOp::less; }

}  // namespace

void Printer::print_expression(ExprId e, Place place) {
  const Expr& expr = tree_.exprs[e];
  const std::optional<InfixOp> op = infix_of(expr);
  const std::optional<std::uint8_t> prefix = prefix_level_of(expr);
  bool parentheses = false;
  if (op) {
    const bool may_hide = is_hiding(*op) && place.side == Side::start;
    parentheses = (info(*op).level > place.level && !may_hide) ||
                  (*op == InfixOp::greater && place.in_sequence);
  } else if (prefix) {
    // The operator that follows would be taken into the operand; at its own level `|| .. @`
    // clashes.
    parentheses =
        place.followed_by < *prefix || (place.followed_by == *prefix && *prefix != level_negate);
  }
  if (parentheses) {
    text("(");
    indent();
    place = {};
  }
  if (op) {
    print_infix(e, place);
  } else if (prefix) {
    print_prefix_operator(expr, place);
  } else {
    print_operand(expr, place);
  }
  if (parentheses) {
    dedent();
    text(")");
  }
}

// ---------------------------------------------------------------------------------------------
// Operands

void Printer::print_operand(const Expr& expr, Place place) {
  const auto range = [&](const RangeExpr& n) {
    const bool is_sequence = n.kind == Collection::sequence;
    text(is_sequence ? "<" : "{");
    expression(n.first, {loosest, no_operator, is_sequence});
    text("..");
    if (n.last) expression(n.last, {loosest, no_operator, is_sequence});
    print_such_that(n.statements, is_sequence);
    text(is_sequence ? ">" : "}");
  };
  const auto collection = [&](const CollectionExpr& n) {
    const bool is_sequence = n.kind == Collection::sequence;
    const bool is_set = n.kind == Collection::set;
    if (n.items.empty() && n.statements.empty()) {
      return text(is_sequence ? "<>" : is_set ? "{}" : "{||}");
    }
    text(is_sequence ? "<" : is_set ? "{" : "{|");
    print_items(tree_.list(n.items), is_sequence);
    print_such_that(n.statements, is_sequence);
    text(is_sequence ? ">" : is_set ? "}" : "|}");
  };
  const auto map = [&](const MapExpr& n) {
    text("(| ");
    const std::span<const ExprId> keys = tree_.list(n.keys);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      expression(keys[i], {});
      text(" => ");
      expression(tree_.list(n.values)[i], {});
      text(i + 1 < keys.size() ? "," : " ");
      if (i + 1 < keys.size()) fill();
    }
    text("|)");
  };
  std::visit(base::overload{
                 [&](const NameExpr& n) { print_operand_name(n.name); },
                 [&](const IntExpr& n) { own(std::to_string(n.value)); },
                 [&](const BoolExpr& n) { text(n.value ? "true" : "false"); },
                 [&](const CharExpr& n) { own(quote(static_cast<char>(n.value))); },
                 [&](const StringExpr& n) { own(quote(name(n.text))); },
                 [&](const WildcardExpr&) { text("_"); },
                 [&](const TupleExpr& n) {
                   text("(");
                   print_items(tree_.list(n.items), false);
                   text(")");
                 },
                 map, collection, range,
                 [&](const ApplyExpr& n) {
                   expression(n.function, {level_postfix, 0, place.in_sequence, Side::left});
                   text("(");
                   print_items(tree_.list(n.arguments), false);
                   text(")");
                 },
                 [&](const RenameExpr& n) {
                   expression(n.process, {level_postfix, 0, place.in_sequence, Side::left});
                   text("[[");
                   print_ties(n.pairs, " <- ", false);
                   text("]]");
                 },
                 [&](const CommunicationExpr& n) { expression(n.channel, place); },
                 [](const auto&) {},  // operators: printed elsewhere
             },
             expr.node);
}

void Printer::print_items(std::span<const ExprId> items, bool in_sequence) {
  if (items.size() == 1) return expression(items[0], {loosest, no_operator, in_sequence});
  open_group();
  indent();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) {
      text(",");
      fill();
    }
    expression(items[i], {loosest, no_operator, in_sequence});
  }
  dedent();
  close_group();
}

void Printer::print_ties(const Ties& ties, std::string_view arrow, bool in_sequence) {
  open_group();
  indent();
  const std::span<const ExprId> from = tree_.list(ties.from);
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (i > 0) {
      text(",");
      fill();
    }
    expression(from[i], {loosest, no_operator, in_sequence});
    text(arrow);
    expression(tree_.list(ties.to)[i], {loosest, no_operator, in_sequence});
  }
  print_such_that(ties.statements, in_sequence);
  dedent();
  close_group();
}

// ---------------------------------------------------------------------------------------------
// Statements

void Printer::print_such_that(StatementList statements, bool in_sequence) {
  if (statements.empty()) return;
  text(" | ");
  print_statements(statements, false, in_sequence);
}

void Printer::print_statements(StatementList statements, bool colon, bool in_sequence) {
  open_group();
  indent();
  bool first = true;
  for (const StatementId s : tree_.list(statements)) {
    if (!first) {
      text(",");
      fill();
    }
    print_statement(s, colon, in_sequence);
    first = false;
  }
  dedent();
  close_group();
}

void Printer::print_statement(StatementId s, bool colon, bool in_sequence) {
  const Place place{loosest, no_operator, in_sequence};
  const Statement& statement = tree_.statements[s];
  if (const auto* filter = std::get_if<Filter>(&statement.node)) {
    return expression(filter->condition, place);
  }
  const auto& generator = std::get<Generator>(statement.node);
  const bool with_colon = colon && fits_after_colon(generator.source);
  pattern(generator.pattern,
          {loosest, with_colon ? info(InfixOp::restrict).level : no_operator, in_sequence});
  text(with_colon ? " : " : " <- ");
  expression(generator.source, place);
}

/// Whether the expression may follow `:` without parentheses.
bool Printer::fits_after_colon(ExprId e) const {
  const std::optional<InfixOp> op = infix_of(tree_.exprs[e]);
  return !op || info(*op).level < info(InfixOp::restrict).level;
}

// ---------------------------------------------------------------------------------------------
// Prefix operators

void Printer::print_prefix_operator(const Expr& expr, Place place) {
  const auto last_operand = [&](ExprId e, std::uint8_t level) {
    const Side side = level == loosest ? Side::start : Side::right;
    expression(e, {level, place.followed_by, place.in_sequence, side});
  };
  const auto body = [&](ExprId e, std::uint8_t level = loosest) {
    indent();
    line();
    last_operand(e, level);
    dedent();
    close_group();
  };
  const Place inner{loosest, no_operator, place.in_sequence};
  std::visit(base::overload{
                 [&](const NegateExpr& n) {
                   text("-");
                   last_operand(n.operand, tighter(level_negate));
                 },
                 [&](const NotExpr& n) {
                   text("not ");
                   last_operand(n.operand, tighter(level_not));
                 },
                 [&](const LengthExpr& n) {
                   text("#");
                   last_operand(n.operand, tighter(level_length));
                 },
                 [&](const IfExpr& n) {
                   open_group();
                   const IfExpr* branch = &n;
                   while (true) {
                     text("if ");
                     expression(branch->condition, inner);
                     line();
                     text("then ");
                     indent();
                     expression(branch->then_branch, inner);
                     dedent();
                     line();
                     text("else ");
                     const auto* next = std::get_if<IfExpr>(&tree_.exprs[branch->else_branch].node);
                     if (next == nullptr) break;
                     branch = next;
                   }
                   indent();
                   last_operand(branch->else_branch, loosest);
                   dedent();
                   close_group();
                 },
                 [&](const LetExpr& n) {
                   open_group();
                   text("let");
                   indent();
                   line();
                   print_declarations(n.declarations);
                   dedent();
                   line();
                   text("within");
                   body(n.body);
                 },
                 [&](const LambdaExpr& n) {
                   open_group();
                   text("\\ ");
                   print_patterns(tree_.list(n.parameters), place.in_sequence);
                   text(" @");
                   body(n.body);
                 },
                 [&](const ReplicatedExpr& n) {
                   print_replicated(n, place);
                   const bool is_alphabet = n.op == ReplicatedOp::alphabet_parallel;
                   body(n.body,
                        is_alphabet ? tighter(info(InfixOp::alphabet_parallel).level) : loosest);
                 },
                 [&](const ReplicatedLinkExpr& n) {
                   open_group();
                   text("[");
                   print_ties(n.links, " <-> ", place.in_sequence);
                   text("] ");
                   print_statements(n.statements, false, place.in_sequence);
                   text(" @");
                   body(n.body);
                 },
                 [](const auto&) {},
             },
             expr.node);
}

/// `[] x : S @` and its like, with a group left open for the body.
void Printer::print_replicated(const ReplicatedExpr& e, Place place) {
  open_group();
  const bool from_sequence = e.op == ReplicatedOp::sequential;
  const auto with_statements = [&](std::string_view op) {
    text(op);
    print_statements(e.statements, !from_sequence, place.in_sequence);
    text(" @");
  };
  switch (e.op) {
    case ReplicatedOp::sequential:
      return with_statements("; ");
    case ReplicatedOp::external_choice:
      return with_statements("[] ");
    case ReplicatedOp::internal_choice:
      return with_statements("|~| ");
    case ReplicatedOp::interleave:
      return with_statements("||| ");
    case ReplicatedOp::parallel:
      text("[| ");
      expression(e.alphabet, {});
      return with_statements(" |] ");
    case ReplicatedOp::sync_choice:
      text("[+ ");
      expression(e.alphabet, {loosest, no_operator, place.in_sequence});
      return with_statements(" +] ");
    case ReplicatedOp::alphabet_parallel:
      with_statements("|| ");
      text(" [");
      expression(e.alphabet, {loosest, no_operator, place.in_sequence});
      text("]");
  }
}

// ---------------------------------------------------------------------------------------------
// Infix operators

// A chain of operators of one level is one group, so that a long one has one operator a line.
void Printer::print_infix(ExprId e, Place place) {
  const InfixInfo level = info(*infix_of(tree_.exprs[e]));
  const bool to_right = level.associativity == Associativity::right;
  const bool to_left = level.associativity == Associativity::left;
  const auto same_level = [&](ExprId next) {
    const std::optional<InfixOp> op = infix_of(tree_.exprs[next]);
    return op && info(*op).level == level.level;
  };
  std::vector<ExprId> chain{e};
  if (to_left) {
    while (same_level(operands_of(tree_.exprs[chain.back()]).first)) {
      chain.push_back(operands_of(tree_.exprs[chain.back()]).first);
    }
    std::reverse(chain.begin(), chain.end());
  } else if (to_right) {
    while (same_level(operands_of(tree_.exprs[chain.back()]).second)) {
      chain.push_back(operands_of(tree_.exprs[chain.back()]).second);
    }
  }
  const Place between{tighter(level.level), level.level, place.in_sequence, Side::right};
  Place leftmost = between;
  const InfixOp first_op = *infix_of(tree_.exprs[chain.front()]);
  const bool keeps_start = gives_way(first_op) || is_hiding(first_op);
  leftmost.side = place.side == Side::start && keeps_start ? Side::start : Side::left;

  open_group();
  if (place.side == Side::right) indent();
  if (!to_right) expression(operands_of(tree_.exprs[chain.front()]).first, leftmost);
  for (const ExprId node : chain) {
    const Expr& expr = tree_.exprs[node];
    const auto* prefix = std::get_if<PrefixExpr>(&expr.node);
    if (prefix != nullptr) {
      print_communication(*prefix, between);
    } else if (to_right) {
      expression(operands_of(expr).first, between);
    }
    print_infix_operator(expr, place);
    if (to_right && node != chain.back()) continue;  // the next node begins with our right operand
    Place right = between;
    if (node == chain.back()) right.followed_by = place.followed_by;
    const InfixOp op = *infix_of(expr);
    const ExprId operand = operands_of(expr).second;
    if (is_hiding(op)) {
      // Neither may the hidden set be re-rooted itself, nor stand looser than an operator after it
      // that gives way to this hiding.
      const std::optional<InfixOp> hidden = infix_of(tree_.exprs[operand]);
      right.level = hidden && gives_way(*hidden)
                        ? tighter(info(InfixOp::sequential).level)
                        : std::min(right.level, tighter(right.followed_by));
    }
    expression(operand, right);
  }
  if (place.side == Side::right) dedent();
  close_group();
}

/// The operator with what its brackets hold and the blanks around it.
void Printer::print_infix_operator(const Expr& expr, Place place) {
  const Place inner{loosest, no_operator, place.in_sequence};
  const auto bracketed = [&](std::string_view open, ExprId alphabet, std::string_view close,
                             Place within) {
    line();
    text(open);
    text(" ");
    expression(alphabet, within);
    text(" ");
    text(close);
    text(" ");
  };
  std::visit(base::overload{
                 [&](const InfixExpr& n) {
                   const std::string_view spelling = info(n.op).spelling;
                   if (n.op == InfixOp::dot) return text(spelling);
                   if (n.op == InfixOp::guard) {
                     text(" &");
                     return line();
                   }
                   if (may_begin_line(n.op)) {
                     line();
                     text(spelling);
                     text(" ");
                   } else {
                     text(" ");
                     text(spelling);
                     line();
                   }
                 },
                 [&](const PrefixExpr&) {
                   text(" ->");
                   line();
                 },
                 [&](const ParallelExpr& n) { bracketed("[|", n.alphabet, "|]", {}); },
                 [&](const ExceptionExpr& n) { bracketed("[|", n.alphabet, "|>", {}); },
                 [&](const SyncChoiceExpr& n) { bracketed("[+", n.alphabet, "+]", inner); },
                 [&](const SyncInterruptExpr& n) { bracketed("/+", n.alphabet, "+\\", inner); },
                 [&](const AlphabetParallelExpr& n) {
                   line();
                   text("[");
                   expression(n.left_alphabet, inner);
                   text(" || ");
                   expression(n.right_alphabet, inner);
                   text("] ");
                 },
                 [&](const LinkParallelExpr& n) {
                   line();
                   text("[");
                   print_ties(n.links, " <-> ", place.in_sequence);
                   text("] ");
                 },
                 [](const auto&) {},
             },
             expr.node);
}

/// The channel and fields of a prefix, before its arrow.
void Printer::print_communication(const PrefixExpr& prefix, Place place) {
  const std::span<const FieldId> fields = tree_.list(prefix.fields);
  if (fields.empty()) return expression(prefix.channel, place);
  const std::uint8_t field_level = info(InfixOp::input).level;
  expression(prefix.channel, {tighter(field_level), field_level, place.in_sequence, Side::left});
  for (std::size_t i = 0; i < fields.size(); ++i) {
    print_field(tree_.fields[fields[i]], i + 1 < fields.size() ? field_level : place.followed_by,
                place.in_sequence);
  }
}

void Printer::print_field(const Field& field, std::uint8_t followed_by, bool in_sequence) {
  // Looser than this, a field would be read as several, or as something else.
  const std::uint8_t restrict = info(InfixOp::restrict).level;
  const std::uint8_t level = tighter(restrict);
  if (field.kind == FieldKind::output) {
    text("!");
    return expression(field.expression, {level, followed_by, in_sequence, Side::right});
  }
  text(field.kind == FieldKind::input ? "?" : "$");
  pattern(field.pattern, {level, field.expression ? restrict : followed_by, in_sequence});
  if (!field.expression) return;
  text(":");
  expression(field.expression, {level, followed_by, in_sequence, Side::right});
}

}  // namespace perentie::parser

#include "builder/conversion.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "perentie/base/check.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/parser/diagnostic_codes.hpp"

namespace perentie::parser {
namespace {

const InfixExpr* infix_of(const Expr& e, InfixOp op) {
  const auto* infix = std::get_if<InfixExpr>(&e.node);
  return infix != nullptr && infix->op == op ? infix : nullptr;
}

/// What an expression is, for the message that it is no pattern.
std::string what(const Expr& e) {
  return std::visit(
      base::overload{
          [](const ApplyExpr&) { return std::string("a function call"); },
          [](const RangeExpr&) { return std::string("a range"); },
          [](const CollectionExpr& c) {
            return std::string(c.kind == Collection::productions ? "`{|..|}`" : "a comprehension");
          },
          [](const MapExpr&) { return std::string("a map"); },
          [](const LambdaExpr&) { return std::string("a lambda"); },
          [](const LetExpr&) { return std::string("a `let`"); },
          [](const IfExpr&) { return std::string("an `if`"); },
          [](const NegateExpr&) { return std::string("the negation of anything but a number"); },
          [](const NotExpr&) { return std::string("a `not`"); },
          [](const LengthExpr&) { return std::string("a `#`"); },
          [](const InfixExpr& i) { return fmt::format("`{}`", info(i.op).spelling); },
          [](const PrefixExpr&) { return std::string("a prefix"); },
          [](const RenameExpr&) { return std::string("a renaming"); },
          [](const CommunicationExpr&) { return std::string("a communication field"); },
          [](const auto&) { return std::string("a process"); },
      },
      e.node);
}

}  // namespace

bool left_in_parentheses(const SyntaxTree& tree, ExprId node, ExprId left) {
  return tree.exprs[node].span.begin != tree.exprs[left].span.begin;
}

bool right_in_parentheses(const SyntaxTree& tree, ExprId node, ExprId right) {
  return tree.exprs[node].span.end != tree.exprs[right].span.end;
}

// ---------------------------------------------------------------------------------------------
// Patterns

PatternId Converter::pattern(ExprId e) {
  refused_ = false;
  return convert(e);
}

PatternId Converter::refuse(const base::DiagnosticCode& code, Span span, std::string message) {
  if (!refused_) context_->report(code, span, std::move(message));
  refused_ = any_refused_ = true;
  return add(span, WildcardPattern{});
}

// Recursion goes as deep as brackets nest; the operands of `.` and `^` are looped over.
PatternId Converter::convert(ExprId e) {
  const Expr expr = at(e);  // a copy: converting its parts may move the node
  const Span span = expr.span;
  return std::visit(
      base::overload{
          [&](const NameExpr& n) { return add(span, NamePattern{n.name}); },
          [&](const WildcardExpr&) {
            acquit(e);
            return add(span, WildcardPattern{});
          },
          [&](const IntExpr& i) { return add(span, IntPattern{i.value}); },
          [&](const BoolExpr& b) { return add(span, BoolPattern{b.value}); },
          [&](const CharExpr& c) { return add(span, CharPattern{c.value}); },
          [&](const StringExpr& s) { return add(span, StringPattern{s.text}); },
          [&](const TupleExpr& t) { return add(span, TuplePattern{convert_all(t.items)}); },
          [&](const NegateExpr&) { return convert_negation(e); },
          [&](const CollectionExpr&) { return convert_collection(e); },
          [&](const InfixExpr&) { return convert_infix(e); },
          [&](const auto&) {
            return refuse(codes::not_a_pattern, span,
                          fmt::format("{} cannot stand in a pattern", what(expr)));
          },
      },
      expr.node);
}

PatternId Converter::convert_negation(ExprId e) {
  const Expr& expr = at(e);
  const auto* number = std::get_if<IntExpr>(&at(std::get<NegateExpr>(expr.node).operand).node);
  if (number != nullptr) return add(expr.span, IntPattern{-number->value});
  return refuse(codes::not_a_pattern, expr.span,
                fmt::format("{} cannot stand in a pattern", what(expr)));
}

PatternId Converter::convert_collection(ExprId e) {
  const Expr expr = at(e);
  const auto& collection = std::get<CollectionExpr>(expr.node);
  if (collection.kind == Collection::productions || !collection.statements.empty()) {
    return refuse(codes::not_a_pattern, expr.span,
                  fmt::format("{} cannot stand in a pattern", what(expr)));
  }
  if (collection.kind == Collection::set && collection.items.count > 1) {
    return refuse(codes::set_pattern_too_large, expr.span,
                  "a set pattern matches the empty set or a single element, not more");
  }
  const PatternList items = convert_all(collection.items);
  if (collection.kind == Collection::set) return add(expr.span, SetPattern{items});
  return add(expr.span, SequencePattern{items});
}

PatternId Converter::convert_infix(ExprId e) {
  const Expr expr = at(e);
  const auto& infix = std::get<InfixExpr>(expr.node);
  switch (infix.op) {
    case InfixOp::dot:
      return convert_dots(e);
    case InfixOp::concat:
      return convert_concat(e);
    case InfixOp::double_pattern: {
      if (in_field_) {
        return refuse(codes::double_pattern_in_field, expr.span,
                      "`@@` cannot stand in a communication field");
      }
      acquit(e);
      const PatternId left = convert(infix.left);
      const PatternId right = convert(infix.right);
      return add(expr.span, DoublePattern{left, right});
    }
    case InfixOp::restrict:
      return refuse(codes::stray_restriction, expr.span,
                    "`:` cannot stand inside a pattern; it follows the whole pattern of a "
                    "generator or field");
    default:
      return refuse(codes::not_a_pattern, expr.span,
                    fmt::format("{} cannot stand in a pattern", what(expr)));
  }
}

PatternId Converter::convert_dots(ExprId e) {
  std::vector<std::pair<PatternId, Span>> lefts;
  ExprId rest = e;
  while (const InfixExpr* dot = infix_of(at(rest), InfixOp::dot)) {
    const Span span = at(rest).span;
    const ExprId next = dot->right;
    lefts.emplace_back(convert(dot->left), span);
    rest = next;
  }
  PatternId result = convert(rest);
  for (auto left = lefts.rbegin(); left != lefts.rend(); ++left) {
    result = add(left->second, DotPattern{left->first, result});
  }
  return result;
}

PatternId Converter::convert_concat(ExprId e) {
  std::vector<std::pair<ExprId, Span>> rights;
  ExprId first = e;
  while (const InfixExpr* concat = infix_of(at(first), InfixOp::concat)) {
    rights.emplace_back(concat->right, at(first).span);
    first = concat->left;
  }
  PatternId result = convert(first);
  unsigned variable = variable_parts(result);
  for (auto right = rights.rbegin(); right != rights.rend(); ++right) {
    const PatternId part = convert(right->first);
    variable += variable_parts(part);
    result = add(right->second, ConcatPattern{result, part});
  }
  if (variable > 1) {
    return refuse(codes::ambiguous_concat, at(e).span,
                  "this pattern has two parts of variable length: only one part of a "
                  "concatenation may be anything but a sequence `<..>`");
  }
  return result;
}

// How many parts of a concatenation pattern stand for sequences of unknown length (1.9.4). Goes no
// deeper than parentheses nest: the left operands of `^` are looped over.
unsigned Converter::variable_parts(PatternId p) const {
  unsigned count = 0;
  while (true) {
    const auto& node = context_->tree.patterns[p].node;
    if (std::holds_alternative<NamePattern>(node) ||
        std::holds_alternative<WildcardPattern>(node)) {
      return count + 1;
    }
    if (const auto* both = std::get_if<DoublePattern>(&node)) {
      return count + std::min(variable_parts(both->left), variable_parts(both->right));
    }
    const auto* concat = std::get_if<ConcatPattern>(&node);
    if (concat == nullptr) return count;
    count += variable_parts(concat->right);
    p = concat->left;
  }
}

PatternList Converter::convert_all(ExprList items) {
  const std::size_t mark = context_->scratch.mark<PatternId>();
  for (std::uint32_t i = 0; i < items.count; ++i) {
    context_->scratch.push(convert(context_->tree.list(items)[i]));
  }
  return context_->scratch.take<PatternId>(context_->tree, mark);
}

// ---------------------------------------------------------------------------------------------
// Statements

StatementId Converter::statement(ExprId e, std::optional<ExprId> source) {
  SyntaxTree& tree = context_->tree;
  const Span span = at(e).span;
  if (source) {
    return tree.statements.add(
        {base::cover(span, at(*source).span), Generator{pattern(e), *source}});
  }

  // `x.y : S` was read as `x.(y : S)`, since `:` binds tighter; likewise with `@@`.
  std::vector<ExprId> outer;
  ExprId last = e;
  while (true) {
    const auto* infix = std::get_if<InfixExpr>(&at(last).node);
    const bool goes_on = infix != nullptr && !right_in_parentheses(tree, last, infix->right) &&
                         (infix->op == InfixOp::dot || infix->op == InfixOp::double_pattern);
    if (!goes_on) break;
    outer.push_back(last);
    last = infix->right;
  }
  const InfixExpr* found = infix_of(at(last), InfixOp::restrict);
  if (found == nullptr) return tree.statements.add({span, Filter{e}});

  const InfixExpr restriction = *found;
  acquit(last);
  for (const ExprId node : outer) tree.exprs[node].span.end = at(restriction.left).span.end;
  if (!outer.empty()) std::get<InfixExpr>(tree.exprs[outer.back()].node).right = restriction.left;
  const PatternId p = pattern(outer.empty() ? restriction.left : e);
  return tree.statements.add({span, Generator{p, restriction.right}});
}

// ---------------------------------------------------------------------------------------------
// Communication fields

ExprId Converter::communication(FieldKind kind, Span token, Operand left, Operand right) {
  SyntaxTree& tree = context_->tree;
  const Span span = base::cover(left.span, right.span);
  auto* open = std::get_if<CommunicationExpr>(&tree.exprs[left.expr].node);
  const bool goes_on = open != nullptr && left.span == at(left.expr).span;
  const auto first = static_cast<std::uint32_t>(goes_on ? open->fields.first : fields_.size());
  // Fields of another communication that was never finished may lie above ours: move ours up.
  if (goes_on && first + open->fields.count != fields_.size()) {
    fields_.resize(first + open->fields.count);
  }

  // `c?x.y` is `c?x?y`: one field for each component (1.7.2).
  ExprId rest = right.expr;
  bool in_parentheses = right.span != at(rest).span;
  while (const InfixExpr* dot = in_parentheses ? nullptr : infix_of(at(rest), InfixOp::dot)) {
    const ExprId next = dot->right;
    const ExprId component = dot->left;
    const bool next_in_parentheses = right_in_parentheses(tree, rest, next);
    add_field(kind, token, component, left_in_parentheses(tree, rest, component));
    token = {at(component).span.end, at(component).span.end};
    rest = next;
    in_parentheses = next_in_parentheses;
  }
  add_field(kind, token, rest, in_parentheses);

  ExprId node = left.expr;
  const FieldList fields{first, static_cast<std::uint32_t>(fields_.size()) - first};
  if (goes_on) {
    auto& expr = tree.exprs[node];
    expr.span = span;
    std::get<CommunicationExpr>(expr.node).fields = fields;
  } else {
    node = context_->add(span, CommunicationExpr{left.expr, fields});
    suspect(node);
  }
  return node;
}

void Converter::add_field(FieldKind kind, Span token, ExprId component, bool in_parentheses) {
  SyntaxTree& tree = context_->tree;
  const Span whole = base::cover(token, at(component).span);
  ExprId set;
  if (!in_parentheses) {
    if (const InfixExpr* found = infix_of(at(component), InfixOp::restrict)) {
      const InfixExpr restriction = *found;
      acquit(component);
      component = restriction.left;
      set = restriction.right;
    }
  }
  Field field{whole, kind, PatternId{}, ExprId{}};
  if (kind == FieldKind::output) {
    if (set) {
      context_->report(codes::restricted_output, at(set).span,
                       "an output `!` has no set of values: `:` follows inputs only");
    }
    field.expression = component;
  } else {
    in_field_ = true;
    field.pattern = pattern(component);
    in_field_ = false;
    field.expression = set;
  }
  fields_.push_back(tree.fields.add(field));
}

FieldList Converter::take_fields(ExprId communication) {
  acquit(communication);
  const FieldList pending = std::get<CommunicationExpr>(at(communication).node).fields;
  const std::span<const FieldId> fields =
      std::span<const FieldId>(fields_).subspan(pending.first, pending.count);
  bool resolved = false;  // a field that is no `$` has been seen
  for (const FieldId id : fields) {
    const Field& field = context_->tree.fields[id];
    if (resolved && field.kind == FieldKind::nondet_input) {
      context_->report(codes::late_nondet_field, field.span,
                       "the fields with `$` must come before those with `?` and `!`");
      break;
    }
    resolved = resolved || field.kind != FieldKind::nondet_input;
  }
  const FieldList list = context_->tree.field_lists.add(fields);
  fields_.resize(pending.first);
  return list;
}

// ---------------------------------------------------------------------------------------------
// Suspects

// Suspects are in the order of their ids; those who are acquitted leave an empty place.
void Converter::acquit(ExprId e) {
  const auto found =
      std::lower_bound(suspects_.begin(), suspects_.end(), e,
                       [](const Suspect& suspect, ExprId id) { return suspect.expr < id; });
  if (found != suspects_.end() && found->expr == e) found->acquitted = true;
  while (!suspects_.empty() && suspects_.back().acquitted) suspects_.pop_back();
}

void Converter::report_suspects() {
  for (const auto& [e, acquitted] : suspects_) {
    // Who is left of a pattern that was refused is no news.
    if (acquitted || any_refused_) continue;
    const Expr& expr = at(e);
    if (std::holds_alternative<WildcardExpr>(expr.node)) {
      context_->report(codes::pattern_in_expression, expr.span,
                       "`_` stands for anything in a pattern and is no expression");
    } else if (infix_of(expr, InfixOp::double_pattern) != nullptr) {
      context_->report(codes::pattern_in_expression, expr.span,
                       "`@@` joins two patterns and is no operator of expressions");
    } else if (infix_of(expr, InfixOp::restrict) != nullptr) {
      context_->report(codes::stray_restriction, expr.span,
                       "`:` stands only in generators such as `x : S` and in fields such as "
                       "`c?x:S`");
    } else {
      context_
          ->report(codes::stray_field, expr.span,
                   "`?`, `!` and `$` make the fields of a prefix: `->` must follow")
          .notes.push_back({std::nullopt, "an event as a value is written with dots: `c.x`"});
    }
  }
  clear();
}

void Converter::clear() {
  // A communication that nobody took refers to fields that are about to go.
  for (const Suspect& suspect : suspects_) {
    auto* open = std::get_if<CommunicationExpr>(&context_->tree.exprs[suspect.expr].node);
    if (open != nullptr) open->fields = {};
  }
  suspects_.clear();
  fields_.clear();
  in_field_ = any_refused_ = false;
}

}  // namespace perentie::parser

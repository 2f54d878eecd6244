// Patterns: the same operator table, with fewer operators.
#include <algorithm>
#include <optional>
#include <utility>

#include "perentie/base/overload.hpp"
#include "perentie/parser/operators.hpp"
#include "print/printer.hpp"

namespace perentie::parser {
namespace {

std::optional<InfixOp> infix_of(const Pattern& p) {
  if (std::holds_alternative<ConcatPattern>(p.node)) return InfixOp::concat;
  if (std::holds_alternative<DotPattern>(p.node)) return InfixOp::dot;
  if (std::holds_alternative<DoublePattern>(p.node)) return InfixOp::double_pattern;
  return std::nullopt;
}

std::pair<PatternId, PatternId> operands_of(const Pattern& p) {
  using Result = std::pair<PatternId, PatternId>;
  return std::visit(base::overload{
                        [](const ConcatPattern& n) { return Result(n.left, n.right); },
                        [](const DotPattern& n) { return Result(n.left, n.right); },
                        [](const DoublePattern& n) { return Result(n.left, n.right); },
                        [](const auto&) { return Result(); },
                    },
                    p.node);
}

bool is_negative(const Pattern& p) {
  const auto* number = std::get_if<IntPattern>(&p.node);
  return number != nullptr && number->value < 0;
}

}  // namespace

void Printer::print_pattern(PatternId id, Place place) {
  const Pattern& p = tree_.patterns[id];
  const auto bracketed = [&](std::string_view open, PatternList items, std::string_view close) {
    text(open);
    print_patterns(tree_.list(items), open == "<");
    text(close);
  };
  const std::optional<InfixOp> op = infix_of(p);
  if (op) {
    const InfixInfo& i = info(*op);
    const auto [left, right] = operands_of(p);
    const bool parentheses = i.level > place.level;
    if (parentheses) {
      text("(");
      place = {};
    }
    const auto tighter = static_cast<std::uint8_t>(i.level - 1);
    const bool to_left = i.associativity == Associativity::left;
    const bool to_right = i.associativity == Associativity::right;
    pattern(left, {to_left ? i.level : tighter, i.level, place.in_sequence});
    if (*op == InfixOp::double_pattern) {
      text(" @@ ");
    } else {
      text(i.spelling);
    }
    pattern(right, {to_right ? i.level : tighter, place.followed_by, place.in_sequence});
    if (parentheses) text(")");
    return;
  }
  // The sign of a negative number is an operator.
  if (is_negative(p) && place.followed_by < level_negate) {
    text("(");
    own(std::to_string(std::get<IntPattern>(p.node).value));
    return text(")");
  }
  std::visit(base::overload{
                 [&](const NamePattern& n) { print_operand_name(n.name); },
                 [&](const WildcardPattern&) { text("_"); },
                 [&](const IntPattern& n) { own(std::to_string(n.value)); },
                 [&](const BoolPattern& n) { text(n.value ? "true" : "false"); },
                 [&](const CharPattern& n) { own(quote(static_cast<char>(n.value))); },
                 [&](const StringPattern& n) { own(quote(name(n.text))); },
                 [&](const TuplePattern& n) { bracketed("(", n.items, ")"); },
                 [&](const SequencePattern& n) {
                   if (n.items.empty()) return text("<>");
                   bracketed("<", n.items, ">");
                 },
                 [&](const SetPattern& n) { bracketed("{", n.items, "}"); },
                 [](const auto&) {},
             },
             p.node);
}

void Printer::print_patterns(std::span<const PatternId> items, bool in_sequence) {
  bool first = true;
  for (const PatternId p : items) {
    if (!first) text(", ");
    pattern(p, {loosest, no_operator, in_sequence});
    first = false;
  }
}

/// Whether the pattern's first token would swallow the newline that separates its declaration from
/// the one before (1.1.5): literals and `_` do.
bool Printer::soaks_newline_before(PatternId p) const {
  while (infix_of(tree_.patterns[p])) p = operands_of(tree_.patterns[p]).first;
  const Pattern& first = tree_.patterns[p];
  return std::visit(base::overload{
                        [](const IntPattern& n) { return n.value >= 0; },
                        [](const WildcardPattern&) { return true; },
                        [](const BoolPattern&) { return true; },
                        [](const CharPattern&) { return true; },
                        [](const StringPattern&) { return true; },
                        [](const auto&) { return false; },
                    },
                    first.node);
}

}  // namespace perentie::parser

#include "builder/type_builder.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "perentie/base/check.hpp"
#include "perentie/base/text.hpp"
#include "perentie/parser/diagnostic_codes.hpp"

namespace perentie::parser {
namespace {

constexpr auto constraint_names =
    std::to_array<std::string_view>({"Eq", "Ord", "Complete", "Set", "Yieldable"});

int level(TokenKind op) {
  switch (op) {
    case TokenKind::dot:
      return 1;
    case TokenKind::prefix:
      return 3;
    default:
      return 2;
  }
}

}  // namespace

TypeBuilder::Run TypeBuilder::begin_run(const Token* first) {
  const Run run{operands_.size(), operators_.size(), base_, context_->depth};
  context_->descend(first);
  base_ = operators_.size();
  return run;
}

TypeId TypeBuilder::end_run(const Run& run) {
  while (operators_.size() > run.operators) reduce();
  PERENTIE_CHECK(operands_.size() == run.operands + 1, "a type is not one operand");
  const TypeId result = type_of(operands_.back());
  abandon_run(run);
  return result;
}

void TypeBuilder::abandon_run(const Run& run) {
  operands_.resize(run.operands);
  operators_.resize(run.operators);
  base_ = run.outer_base;
  context_->depth = run.depth;
}

void TypeBuilder::clear() {
  operands_.clear();
  operators_.clear();
  base_ = 0;
}

void TypeBuilder::name(QualifiedName name, const Token* last) {
  const Token* first = last - 2 * (name.parts.count - 1);
  const Span span = cover(first, last);
  operands_.push_back({add(span, NamedType{name}), span, std::nullopt});
}

void TypeBuilder::group(const Token* open, TypeList items, const Token* close) {
  const Span span = cover(open, close);
  TypeId type;
  if (items.count == 1) type = context_->tree.list(items)[0];
  if (items.count > 1) type = add(span, TupleType{items});
  operands_.push_back({type, span, items});
}

void TypeBuilder::set(const Token* open, TypeId element, const Token* close) {
  const Span span = cover(open, close);
  operands_.push_back({add(span, SetType{element}), span, std::nullopt});
}

void TypeBuilder::sequence(const Token* open, TypeId element, const Token* close) {
  const Span span = cover(open, close);
  operands_.push_back({add(span, SequenceType{element}), span, std::nullopt});
}

void TypeBuilder::map(const Token* open, TypeId key, TypeId value, const Token* close) {
  const Span span = cover(open, close);
  operands_.push_back({add(span, MapType{key, value}), span, std::nullopt});
}

void TypeBuilder::infix(const Token* op) {
  while (operators_.size() > base_ && level(operators_.back()->kind) < level(op->kind)) reduce();
  operators_.push_back(op);
}

void TypeBuilder::reduce() {
  const Token* op = operators_.back();
  operators_.pop_back();
  const TypeId right = type_of(operands_.back());
  const Span right_span = operands_.back().span;
  operands_.pop_back();
  const Operand left = operands_.back();
  operands_.pop_back();
  const Span span = base::cover(left.span, right_span);
  TypeId result;
  switch (op->kind) {
    case TokenKind::dot:
      result = add(span, DotType{type_of(left), right});
      break;
    case TokenKind::yields:
      result = add(span, YieldType{type_of(left), right});
      break;
    case TokenKind::extendable:
      result = add(span, ExtendableType{type_of(left), right});
      break;
    default:
      if (!left.group) {
        context_->report(codes::bare_function_argument, left.span,
                         fmt::format("the arguments of a function type stand in parentheses: "
                                     "`({}) -> ..`",
                                     context_->sources.text(left.span)));
        throw Abandoned{};
      }
      result = add(span, FunctionType{*left.group, right});
  }
  operands_.push_back({result, span, std::nullopt});
}

TypeId TypeBuilder::type_of(const Operand& operand) {
  if (operand.type) return operand.type;
  context_->report(codes::unexpected_token, operand.span,
                   "expected a type: `()` stands only before `->`");
  throw Abandoned{};
}

Constraint TypeBuilder::constraint(const Token* constraint, const Token* variable) {
  const std::string_view name = context_->tree.names[constraint->name()];
  if (std::find(constraint_names.begin(), constraint_names.end(), name) == constraint_names.end()) {
    base::Diagnostic& diagnostic =
        context_->report(codes::unknown_constraint, constraint->span,
                         fmt::format("`{}` is not a type constraint: there are `Eq`, `Ord`, "
                                     "`Complete`, `Set` and `Yieldable`",
                                     name));
    for (const std::string_view near : base::nearest_words(name, constraint_names, 1)) {
      diagnostic.notes.push_back({std::nullopt, fmt::format("did you mean `{}`?", near)});
    }
  }
  return {identifier(constraint), identifier(variable)};
}

}  // namespace perentie::parser

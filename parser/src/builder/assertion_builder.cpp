#include "builder/assertion_builder.hpp"

#include <fmt/format.h>

#include "perentie/parser/diagnostic_codes.hpp"
#include "perentie/parser/spelling.hpp"

namespace perentie::parser {
namespace {

PropertyWord word_of(const Token* token) { return static_cast<PropertyWord>(token->value); }

}  // namespace

void AssertionBuilder::begin(std::optional<const Token*> negation, ExprId process) {
  process_ = process;
  assertion_ = {negation.has_value(), PropertyAssertion{process, {}, {}}, {ExprId{}, {}}};
}

void AssertionBuilder::refinement(const Token* sign, ExprId implementation) {
  assertion_.claim = RefinementAssertion{process_, static_cast<Model>(sign->value), implementation};
}

void AssertionBuilder::property(const Token* word, std::optional<const Token*> parameter) {
  Property property{};
  switch (word_of(word)) {
    case PropertyWord::deadlock_free:
      property = Property::deadlock_free;
      break;
    case PropertyWord::livelock_free:
    case PropertyWord::divergence_free:
      property = Property::divergence_free;
      break;
    case PropertyWord::deterministic:
      property = Property::deterministic;
      break;
    default:
      context_
          ->report(codes::bad_property, word->span,
                   fmt::format("`{}` is an option and follows what is asserted",
                               spelling(word_of(word))))
          .notes.push_back(
              {std::nullopt, "write for instance `assert P [T= Q :[tau priority]: S`"});
      throw Abandoned{};
  }
  assertion_.claim = PropertyAssertion{process_, property, model(parameter)};
}

void AssertionBuilder::trace(const Token*, std::optional<const Token*> parameter, ExprList trace) {
  assertion_.claim = HasTraceAssertion{process_, model(parameter), trace};
}

std::optional<Model> AssertionBuilder::model(std::optional<const Token*> parameter) {
  if (!parameter) return std::nullopt;
  if ((*parameter)->kind == TokenKind::property_model)
    return static_cast<Model>((*parameter)->value);
  context_->report(
      codes::bad_property, (*parameter)->span,
      "expected a model such as `[FD]`; a reduction belongs to `partial order reduce`");
  throw Abandoned{};
}

void AssertionBuilder::tau_priority(const Token* word, ExprId set) {
  once(!assertion_.options.tau_priority.is_none(), word);
  assertion_.options.tau_priority = set;
}

void AssertionBuilder::reduction(const Token* word, std::optional<const Token*> parameter) {
  once(assertion_.options.partial_order_reduce.has_value(), word);
  PartialOrderMode mode = PartialOrderMode::precise;
  if (parameter) {
    if ((*parameter)->kind != TokenKind::property_reduction) {
      context_->report(codes::bad_property, (*parameter)->span,
                       "a partial order reduction is `precise`, `hybrid` or `fast`");
      throw Abandoned{};
    }
    mode = static_cast<PartialOrderMode>((*parameter)->value);
  }
  assertion_.options.partial_order_reduce = mode;
}

void AssertionBuilder::second_property(const Token* word) {
  context_->report(codes::bad_property, word->span,
                   fmt::format("an assertion claims one thing: `{}` needs an assertion of its own",
                               spelling(word_of(word))));
  throw Abandoned{};
}

void AssertionBuilder::once(bool given, const Token* word) {
  if (!given) return;
  context_->report(codes::repeated_option, word->span,
                   fmt::format("the option `{}` is given twice", spelling(word_of(word))));
  throw Abandoned{};
}

}  // namespace perentie::parser

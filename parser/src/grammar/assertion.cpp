// Assertions (CSPM reference 2.6).
#include "grammar/rules.hpp"

namespace perentie::parser::grammar {

bool is_has_trace(const Token& t) {
  return t.kind == K::property && t.value == static_cast<std::uint32_t>(PropertyWord::has_trace);
}
bool is_tau_priority(const Token& t) {
  return t.kind == K::property && t.value == static_cast<std::uint32_t>(PropertyWord::tau_priority);
}
bool is_reduction(const Token& t) {
  return t.kind == K::property &&
         t.value == static_cast<std::uint32_t>(PropertyWord::partial_order_reduce);
}

const TokAt parameter(K::property_model, K::property_reduction, "a model");

const auto refinement = (tok_at(K::refines) > expression)[call<&AssertionBuilder::refinement>];
const auto trace =
    (TokIf<is_has_trace>{} > -parameter > tok(K::property_close) >
     tok(K::left_sequence, "a sequence of events such as `<a, b>`") > expression_list >
     tok(K::right_sequence, "`,` or `>`"))[call<&AssertionBuilder::trace>];
const auto property =
    (tok_at(K::property) > -parameter > tok(K::property_close))[call<&AssertionBuilder::property>];
const x3::rule<struct PropertyClaimClass> property_claim = "a property such as `deadlock free`";
const auto property_claim_def = trace | property;
const x3::rule<struct ClaimClass> claim =
    "a refinement such as `[T=` or a property such as `:[deadlock free]`";
const auto claim_def = refinement | (tok(K::property_open) > property_claim);

const auto tau_priority = (TokIf<is_tau_priority>{} > tok(K::property_close) >
                           expression)[call<&AssertionBuilder::tau_priority>];
const auto reduction = (TokIf<is_reduction>{} > -parameter >
                        tok(K::property_close))[call<&AssertionBuilder::reduction>];
const auto second_property = tok_at(K::property)[call<&AssertionBuilder::second_property>];
const x3::rule<struct OptionClass> option = "an option such as `tau priority`";
const auto option_def = tau_priority | reduction | second_property;

const auto begin = (-tok_at(K::not_) >> expression)[call<&AssertionBuilder::begin>];
const auto assertion_def = begin > claim > *(tok(K::property_open) > option);

BOOST_SPIRIT_DEFINE(property_claim, claim, option, assertion)

BOOST_SPIRIT_INSTANTIATE(AssertionRule, Iterator, Context)

}  // namespace perentie::parser::grammar

// Types in annotations, with their constraints (CSPM reference 1.8).
#include "grammar/rules.hpp"

namespace perentie::parser::grammar {

bool is_type_infix(const Token& t) {
  return t.kind == K::dot || t.kind == K::yields || t.kind == K::extendable || t.kind == K::prefix;
}
bool is_type_dot(const Token& t) { return t.kind == K::dot; }

const x3::rule<struct TypeClass, TypeId> type = "a type";
const x3::rule<struct DotTypeClass, TypeId> dot_type = "a type";
const auto types = list_of<TypeId>(-comma_separated(type[push]));

const auto type_name = (qualified_name >> previous)[call<&TypeBuilder::name>];
const auto type_group = (tok_at(K::left_paren) > types >
                         tok_at(K::right_paren, "`,` or `)`"))[call<&TypeBuilder::group>];
const auto set_type =
    (tok_at(K::left_brace) > type > tok_at(K::right_brace))[call<&TypeBuilder::set>];
const auto sequence_type =
    (tok_at(K::left_sequence) > type > tok_at(K::right_sequence))[call<&TypeBuilder::sequence>];
// The key stops at `=>`, which is the map's.
const auto map_type = (tok_at(K::left_map) > dot_type > tok(K::yields) > type >
                       tok_at(K::right_map))[call<&TypeBuilder::map>];

const x3::rule<struct TypeOperandClass> type_operand = "a type";
const auto type_operand_def = type_name | type_group | set_type | sequence_type | map_type;

const auto type_infix = TokIf<is_type_infix>{}[call<&TypeBuilder::infix>];
const auto type_dot = TokIf<is_type_dot>{}[call<&TypeBuilder::infix>];
const auto type_def = run_of<TypeBuilder, TypeId>(type_operand >> *(type_infix > type_operand));
const auto dot_type_def = run_of<TypeBuilder, TypeId>(type_operand >> *(type_dot > type_operand));

const x3::rule<struct ConstraintClass, Constraint> constraint = "a constraint such as `Eq a`";
const auto constraint_def =
    (tok_at(K::identifier, "a constraint such as `Eq a`") >
     tok_at(K::identifier, "a type variable"))[call<&TypeBuilder::constraint>];

// No type has two names in a row, so that two tokens tell constraints from types.
const auto two_names = tok(K::identifier) >> tok(K::identifier);
const auto one_constraint = (&two_names >> constraint[push]) > tok(K::yields);
const auto several_constraints = (&(tok(K::left_paren) >> two_names) >> tok(K::left_paren)) >
                                 comma_separated(constraint[push]) >
                                 tok(K::right_paren, "`,` or `)`") > tok(K::yields);
const auto constraints = list_of<Constraint>(-(one_constraint | several_constraints));

const auto set_annotated_type = [](auto& context) {
  with_parts(
      [&](ListRef<Constraint> given, TypeId t) {
        x3::_val(context) = AnnotatedType{given, t};
      },
      x3::_attr(context));
};
const auto annotated_type_def = (constraints >> type)[set_annotated_type];

BOOST_SPIRIT_DEFINE(type, dot_type, type_operand, constraint, annotated_type)

BOOST_SPIRIT_INSTANTIATE(AnnotatedTypeRule, Iterator, Context)

}  // namespace perentie::parser::grammar

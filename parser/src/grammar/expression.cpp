// Expressions and statements: operands, prefix operators, infix operators. Everything is
// left-factored on the first token; the operator table comes in only through the builder (CSPM
// reference 1.7, 4.3, 4.4).
#include "grammar/rules.hpp"

namespace perentie::parser::grammar {

// ---------------------------------------------------------------------------------------------
// Token classes

bool is_literal(const Token& t) {
  return t.kind == K::integer || t.kind == K::true_ || t.kind == K::false_ ||
         t.kind == K::character || t.kind == K::string || t.kind == K::wildcard;
}

bool is_unary(const Token& t) {
  return t.kind == K::subtract || t.kind == K::not_ || t.kind == K::length;
}

bool is_replicated(const Token& t) {
  return t.kind == K::external_choice || t.kind == K::internal_choice || t.kind == K::interleave ||
         t.kind == K::sequential;
}

bool is_infix(const Token& t) {
  static_assert(K::concat < K::subtract && K::equal < K::double_pattern && K::length < K::equal);
  if (t.kind == K::and_ || t.kind == K::or_) return true;
  return t.kind >= K::concat && t.kind <= K::double_pattern && t.kind != K::length &&
         t.kind != K::dots && t.kind != K::alphabet_parallel;
}

// ---------------------------------------------------------------------------------------------
// Names, lists, statements

const auto push_name = [](auto& context) {
  builder(context).context.scratch.push(x3::_attr(context)->name());
};
const auto name_part = tok_at(K::identifier)[push_name];
const auto set_qualified_name = [](auto& context) {
  x3::_val(context) = QualifiedName{x3::_attr(context)};
};
const auto qualified_name_def =
    list_of<NameId>(name_part >> *(tok(K::scope) > name_part))[set_qualified_name];

const auto expression_list_def = list_of<ExprId>(comma_separated(expression[push]));
const auto expressions = list_of<ExprId>(-comma_separated(expression[push]));

const x3::rule<struct PatternClass, PatternId> pattern = "a pattern";
const auto pattern_def = expression[call<&Converter::pattern>];
const auto pattern_list_def = list_of<PatternId>(comma_separated(pattern[push]));

const x3::rule<struct StatementClass, StatementId> statement = "a generator such as `x : S`";
const auto statement_def =
    (expression >> -(tok(K::drawn_from) > expression))[call<&Converter::statement>];
const auto statement_list_def = list_of<StatementId>(comma_separated(statement[push]));
const auto such_that_def = tok(K::bar) > statement_list;

// ---------------------------------------------------------------------------------------------
// Operands

using OperandRule = x3::rule<struct OperandClass, ExprId>;

const x3::rule<struct NameClass, ExprId> name = "a name";
const auto name_def = (qualified_name >> previous)[call<&ExpressionBuilder::name>];

const x3::rule<struct LiteralClass, ExprId> literal = "a literal";
const auto literal_def = TokIf<is_literal>{}[call<&ExpressionBuilder::literal>];

const x3::rule<struct ParenClass, ExprId> paren = "`(`";
const auto paren_def = (tok_at(K::left_paren) > expression_list >
                        tok_at(K::right_paren, "`,` or `)`"))[call<&ExpressionBuilder::paren>];

const auto map_pair = expression[push] > tok(K::yields) > expression[push];
const auto map_pairs = list_of<ExprId>(-comma_separated(map_pair));
const x3::rule<struct MapClass, ExprId> map = "`(|`";
const auto map_def = (tok_at(K::left_map) > map_pairs >
                      tok_at(K::right_map, "`,` or `|)`"))[call<&ExpressionBuilder::map>];

const auto set_range_end = [](auto& context) {
  x3::_val(context) = RangeEnd{x3::_attr(context).value_or(ExprId{})};
};
const x3::rule<struct RangeEndClass, RangeEnd> range_end = "`..`";
const auto range_end_def = (tok(K::dots) > -expression)[set_range_end];

const x3::rule<struct SetClass, ExprId> set = "`{`";
const auto set_def = (tok_at(K::left_brace) > expressions > -range_end > -such_that >
                      tok_at(K::right_brace, "`,` or `}`"))[call<&ExpressionBuilder::collection>];

const x3::rule<struct ProductionsClass, ExprId> productions = "`{|`";
const auto productions_def =
    (tok_at(K::left_productions) > expressions > -range_end > -such_that >
     tok_at(K::right_productions, "`,` or `|}`"))[call<&ExpressionBuilder::collection>];

const x3::rule<struct SequenceClass, ExprId> sequence = "`<`";
const auto sequence_def =
    (tok_at(K::left_sequence) > expressions > -range_end > -such_that >
     tok_at(K::right_sequence, "`,` or `>`"))[call<&ExpressionBuilder::collection>];

const OperandRule primary = "an expression";
const auto primary_def = name | literal | paren | set | sequence | productions | map;

// ---------------------------------------------------------------------------------------------
// Prefix operators: each ends where its last operand begins

const auto tie_pair = expression[push] > tok(K::tie) > expression[push];
const auto ties = list_of<ExprId>(comma_separated(tie_pair));

const auto enter_let = [](auto& context) { builder(context).declarations.enter_let(); };
const auto leave_let = [](auto& context) { builder(context).declarations.leave_let(); };

const auto unary_head = TokIf<is_unary>{}[call<&ExpressionBuilder::unary>];
const auto if_head = (tok_at(K::if_) > expression > tok(K::then_) > expression >
                      tok(K::else_))[call<&ExpressionBuilder::if_head>];
const auto let_head =
    (tok_at(K::let_)[enter_let] > local_declarations >
     tok(K::within_, "a declaration or `within`")[leave_let])[call<&ExpressionBuilder::let_head>];
const auto lambda_head = (tok_at(K::hide) > pattern_list >
                          tok(K::at, "`,` or `@`"))[call<&ExpressionBuilder::lambda_head>];
const auto replicated_head = (TokIf<is_replicated>{} > statement_list >
                              tok(K::at, "`,` or `@`"))[call<&ExpressionBuilder::replicated_head>];
const auto alphabet_head = (tok_at(K::alphabet_parallel) > statement_list >
                            tok(K::at, "`,` or `@`") > tok(K::left_bracket) > expression >
                            tok(K::right_bracket))[call<&ExpressionBuilder::alphabet_head>];
const auto parallel_head =
    (tok_at(K::left_parallel) > expression > tok(K::right_parallel) > statement_list >
     tok(K::at, "`,` or `@`"))[call<&ExpressionBuilder::bracket_head>];
const auto sync_head = (tok_at(K::left_sync) > expression > tok(K::right_sync) > statement_list >
                        tok(K::at, "`,` or `@`"))[call<&ExpressionBuilder::bracket_head>];
const auto link_head =
    (tok_at(K::left_bracket) > ties > -such_that > tok(K::right_bracket) > statement_list >
     tok(K::at, "`,` or `@`"))[call<&ExpressionBuilder::link_head>];

const x3::rule<struct PrefixOperatorClass> prefix_operator = "an expression";
const auto prefix_operator_def = unary_head | if_head | let_head | lambda_head | replicated_head |
                                 alphabet_head | parallel_head | sync_head | link_head;

// ---------------------------------------------------------------------------------------------
// Postfix and infix operators

const auto rename_pair = expression[push] > tok(K::drawn_from) > expression[push];
const auto rename_pairs = list_of<ExprId>(comma_separated(rename_pair));

const auto call_arguments = (tok(K::left_paren) > expressions >
                             tok_at(K::right_paren, "`,` or `)`"))[call<&ExpressionBuilder::apply>];
const auto renaming = (tok(K::left_rename) > rename_pairs > -such_that >
                       tok_at(K::right_rename, "`,` or `]]`"))[call<&ExpressionBuilder::rename>];

const auto set_alphabet_rest = [](auto& context) {
  x3::_val(context) = BracketRest{x3::_attr(context), {}, {}, {}};
};
const auto set_link_rest = [](auto& context) {
  with_parts(
      [&](ExprId to, ExprList more, std::optional<StatementList> statements) {
        x3::_val(context) = BracketRest{{}, to, more, statements};
      },
      x3::_attr(context));
};
const x3::rule<struct AlphabetRestClass, BracketRest> alphabet_rest = "`||`";
const auto alphabet_rest_def =
    (tok(K::alphabet_parallel) > expression > tok(K::right_bracket))[set_alphabet_rest];
const auto more_ties = list_of<ExprId>(*(tok(K::comma) > tie_pair));
const x3::rule<struct LinkRestClass, BracketRest> link_rest = "`<->`";
const auto link_rest_def = (tok(K::tie) > expression > more_ties > -such_that >
                            tok(K::right_bracket, "`,` or `]`"))[set_link_rest];
const x3::rule<struct SquareRestClass, BracketRest> square_rest = "`||` or `<->`";
const auto square_rest_def = alphabet_rest | link_rest;

const auto simple_infix = TokIf<is_infix>{}[call<&ExpressionBuilder::infix>];
const auto parallel_infix = (tok_at(K::left_parallel) > expression >
                             TokAt(K::right_parallel, K::right_exception,
                                   "`|]` or `|>`"))[call<&ExpressionBuilder::bracket_infix>];
const auto sync_infix = (tok_at(K::left_sync) > expression >
                         tok_at(K::right_sync))[call<&ExpressionBuilder::bracket_infix>];
const auto interrupt_infix = (tok_at(K::left_interrupt) > expression >
                              tok_at(K::right_interrupt))[call<&ExpressionBuilder::bracket_infix>];
const auto square_infix =
    (tok_at(K::left_bracket) > expression > square_rest)[call<&ExpressionBuilder::square_infix>];

const x3::rule<struct InfixOperatorClass> infix_operator = "an operator";
const auto infix_operator_def =
    simple_infix | parallel_infix | square_infix | sync_infix | interrupt_infix;

// ---------------------------------------------------------------------------------------------
// Expressions

const auto placed_primary = (here >> primary >> previous)[call<&ExpressionBuilder::operand>];
const x3::rule<struct FirstOperandClass> required_primary = "an expression";
const auto required_primary_def = placed_primary;
const x3::rule<struct TermClass> term = "an expression";
const auto term_def = (placed_primary | (+prefix_operator > required_primary)) >>
                      *(call_arguments | renaming);

const auto expression_def = run_of<ExpressionBuilder, ExprId>(term >> *(infix_operator > term));

BOOST_SPIRIT_DEFINE(qualified_name, expression_list, pattern, pattern_list, statement,
                    statement_list, such_that, name, literal, paren, map, range_end, set,
                    productions, sequence, primary, prefix_operator, alphabet_rest, link_rest,
                    square_rest, infix_operator, required_primary, term, expression)

BOOST_SPIRIT_INSTANTIATE(ExpressionRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(ExpressionListRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(StatementListRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(SuchThatRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(PatternListRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(QualifiedNameRule, Iterator, Context)

}  // namespace perentie::parser::grammar

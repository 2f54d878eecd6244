// Declarations, the heads of modules and timed sections, and the entry points of the grammar
// (CSPM reference 2).
#include "grammar/grammar.hpp"
#include "grammar/rules.hpp"

namespace perentie::parser::grammar {

/// The declarations that the subject makes, as a list in the tree.
template <class Subject>
struct DeclarationsDirective : x3::unary_parser<Subject, DeclarationsDirective<Subject>> {
  using base = x3::unary_parser<Subject, DeclarationsDirective<Subject>>;
  using attribute_type = DeclList;
  static constexpr bool has_attribute = true;
  static constexpr bool has_action = false;  // the actions inside are its own affair

  explicit DeclarationsDirective(const Subject& s) : base(s) {}

  template <class AnyContext, class RContext, class Attribute>
  bool parse(Iterator& first, const Iterator& last, const AnyContext& context, RContext& rcontext,
             Attribute& attribute) const {
    DeclarationBuilder& declarations = builder(context).declarations;
    const DeclarationBuilder::Mark mark = declarations.mark();
    if (!this->subject.parse(first, last, context, rcontext, x3::unused)) {
      declarations.drop(mark);
      return false;
    }
    x3::traits::move_to(declarations.take(mark), attribute);
    return true;
  }
};

template <class Subject>
auto declarations_of(const Subject& subject) {
  return DeclarationsDirective<typename x3::extension::as_parser<Subject>::value_type>(
      x3::as_parser(subject));
}

// ---------------------------------------------------------------------------------------------
// Definitions

const auto push_identifier = [](auto& context) {
  builder(context).context.scratch.push(identifier(x3::_attr(context)));
};
const auto name_token = tok_at(K::identifier);
const auto identifiers = list_of<Identifier>(comma_separated(name_token[push_identifier]));
const auto more_identifiers = list_of<Identifier>(*(tok(K::comma) > name_token[push_identifier]));

const auto set_equation = [](auto& context) {
  x3::_val(context) = DefinitionRest{x3::_attr(context), {}, {}, {}};
};
const auto set_annotation = [](auto& context) {
  with_parts(
      [&](IdentifierList names, const AnnotatedType& type) {
        x3::_val(context) = DefinitionRest{{}, names, type.constraints, type.type};
      },
      x3::_attr(context));
};
const x3::rule<struct EquationClass, DefinitionRest> equation = "`=`";
const auto equation_def = (tok(K::define) > expression)[set_equation];
const x3::rule<struct AnnotationClass, DefinitionRest> annotation = "`::`";
const auto annotation_def =
    ((more_identifiers >> tok(K::annotate)) > annotated_type)[set_annotation];
const x3::rule<struct DefinitionRestClass, DefinitionRest> definition_rest = "`=`";
const auto definition_rest_def = equation | annotation;

const auto definition = (expression > definition_rest)[call<&DeclarationBuilder::definition>];

// ---------------------------------------------------------------------------------------------
// The other declarations of one line

const x3::rule<struct ConstructorClass, Constructor> constructor = "a constructor's name";
const auto constructor_def = (tok_at(K::identifier, "a constructor's name") >>
                              -(tok(K::dot) > expression))[call<&DeclarationBuilder::constructor>];
const auto constructors =
    list_of<Constructor>(constructor[push] >> *(tok(K::bar) > constructor[push]));

const auto channel = (tok_at(K::channel_) > identifiers >
                      -(tok(K::restrict) > expression))[call<&DeclarationBuilder::channel>];
const auto datatype = (TokAt(K::datatype_, K::subtype_, {}) > name_token > tok(K::define) >
                       constructors)[call<&DeclarationBuilder::datatype>];
const auto nametype = (tok_at(K::nametype_) > name_token > tok(K::define) >
                       expression)[call<&DeclarationBuilder::nametype>];
const auto import =
    (TokAt(K::transparent_, K::external_, {}) > identifiers)[call<&DeclarationBuilder::import>];
const auto instance = (tok_at(K::instance_) > name_token > tok(K::define) > here > qualified_name >
                       -(tok(K::left_paren) > expression_list >
                         tok(K::right_paren, "`,` or `)`")))[call<&DeclarationBuilder::instance>];

const auto declare_assertion = [](auto& context) {
  Builder& b = builder(context);
  b.declarations.assertion(x3::_attr(context), b.assertions.finished());
};
const auto assert_declaration = (tok_at(K::assert_) > assertion)[declare_assertion];

const auto set_span = [](auto& context) {
  with_parts([&](const Token* first,
                 const Token* last) { builder(context).declarations.set_span(cover(first, last)); },
             x3::_attr(context));
};
const x3::rule<struct DeclarationBodyClass> declaration_body = "a declaration";
const auto declaration_body_def =
    definition | channel | assert_declaration | datatype | nametype | import | instance;
const x3::rule<struct DeclarationClass> declaration = "a declaration";
const auto declaration_def = (here >> declaration_body >> previous)[set_span];

// ---------------------------------------------------------------------------------------------
// Declarations inside `let`

const auto timed_duration = -(tok(K::left_paren) > expression > tok(K::right_paren)) >
                            *tok(K::newline) > tok(K::left_brace);

const auto blank_lines = *tok(K::newline);
const x3::rule<struct LocalEndClass> local_end = "an operator or the end of the line";
const auto local_end_def = +tok(K::newline) | &tok(K::within_) | &tok(K::right_brace);

const auto declare_timed = [](auto& context) {
  with_parts(
      [&](const Token* first, std::optional<ExprId> duration, DeclList declarations,
          const Token* last) {
        builder(context).declarations.timed(cover(first, last), duration.value_or(ExprId{}),
                                            declarations);
      },
      x3::_attr(context));
};
const x3::rule<struct LocalDeclarationClass> local_declaration = "a declaration";
const auto local_timed = (tok_at(K::timed_) > timed_duration >
                          declarations_of(blank_lines >> *(local_declaration > local_end)) >
                          tok_at(K::right_brace))[declare_timed];
const auto local_declaration_def = local_timed | declaration;
const auto local_declarations_def =
    declarations_of(blank_lines >> +(local_declaration > local_end));

// ---------------------------------------------------------------------------------------------
// Heads of blocks

const auto set_module_head = [](auto& context) {
  with_parts(
      [&](const Token* name, std::optional<PatternList> parameters) {
        x3::_val(context) = ModuleHead{identifier(name), parameters.value_or(PatternList{})};
      },
      x3::_attr(context));
};
const x3::rule<struct ModuleHeadClass, ModuleHead> module_head = "a module";
const auto module_head_def = (tok(K::module_) > name_token > -(tok(K::left_paren) > pattern_list >
                                                               tok(K::right_paren, "`,` or `)`")) >
                              tok(K::newline))[set_module_head];

const auto set_timed_head = [](auto& context) {
  x3::_val(context) = x3::_attr(context).value_or(ExprId{});
};
const x3::rule<struct TimedHeadClass, ExprId> timed_head = "a timed section";
const auto timed_head_def = (tok(K::timed_) > timed_duration)[set_timed_head];

BOOST_SPIRIT_DEFINE(equation, annotation, definition_rest, constructor, declaration_body,
                    declaration, local_end, local_declaration, local_declarations, module_head,
                    timed_head)

BOOST_SPIRIT_INSTANTIATE(LocalDeclarationsRule, Iterator, Context)

// ---------------------------------------------------------------------------------------------
// Entry points

namespace {

template <class Rule, class Attribute>
const Token* run(const Rule& rule, const Token* first, const Token* last, Builder& b,
                 Attribute& attribute) {
  const Context context = x3::make_context<BuilderTag>(b);
  const Token* at = first;
  try {
    if (!rule.parse(at, last, context, x3::unused, attribute)) {
      throw SyntaxError{first, rule.name};
    }
  } catch (const x3::expectation_failure<Iterator>& failure) {
    throw SyntaxError{failure.where(), failure.which()};
  }
  return at;
}

}  // namespace

const Token* parse_declaration(const Token* first, const Token* last, Builder& b) {
  return run(declaration, first, last, b, x3::unused);
}

const Token* parse_assertion(const Token* first, const Token* last, Builder& b) {
  return run(assertion, first, last, b, x3::unused);
}

const Token* parse_expression(const Token* first, const Token* last, Builder& b, ExprId& result) {
  return run(expression, first, last, b, result);
}

const Token* parse_module_head(const Token* first, const Token* last, Builder& b,
                               ModuleHead& result) {
  return run(module_head, first, last, b, result);
}

const Token* parse_timed_head(const Token* first, const Token* last, Builder& b, ExprId& result) {
  return run(timed_head, first, last, b, result);
}

}  // namespace perentie::parser::grammar

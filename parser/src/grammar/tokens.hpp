// X3 over tokens: the iterator, the context, and the few parsers that see tokens directly.
//
// No skipper: newlines are tokens. The context holds the Builder and is the same everywhere, so
// each rule is instantiated once. Attributes are token pointers, ids, and small structs of ids.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <boost/fusion/include/at_c.hpp>
#include <boost/fusion/include/is_sequence.hpp>
#include <boost/fusion/include/size.hpp>
#include <boost/optional.hpp>
#include <boost/spirit/home/x3.hpp>

#include "builder/builder.hpp"
#include "perentie/parser/token.hpp"

namespace perentie::parser::grammar {

namespace x3 = boost::spirit::x3;

using Iterator = const Token*;
struct BuilderTag;
using Context = decltype(x3::make_context<BuilderTag>(std::declval<Builder&>()));

template <class AnyContext>
Builder& builder(const AnyContext& context) {
  return x3::get<BuilderTag>(context);
}

// ---------------------------------------------------------------------------------------------
// Tokens

/// A token of one kind, without attribute. `expected` is what messages say in place of its
/// spelling.
struct Tok : x3::parser<Tok> {
  using attribute_type = x3::unused_type;
  static constexpr bool has_attribute = false;

  constexpr explicit Tok(TokenKind k, std::string_view e = {}) : kind(k), expected(e) {}

  template <class AnyContext, class RContext, class Attribute>
  bool parse(Iterator& first, const Iterator&, const AnyContext&, RContext&, Attribute&) const {
    if (first->kind != kind) return false;
    ++first;
    return true;
  }

  TokenKind kind;
  std::string_view expected;
};

/// A token of one of two kinds; the attribute is the token.
struct TokAt : x3::parser<TokAt> {
  using attribute_type = Iterator;
  static constexpr bool has_attribute = true;

  constexpr explicit TokAt(TokenKind k, std::string_view e = {}) : TokAt(k, k, e) {}
  constexpr TokAt(TokenKind k, TokenKind other, std::string_view e)
      : kind(k), alternative(other), expected(e) {}

  template <class AnyContext, class RContext, class Attribute>
  bool parse(Iterator& first, const Iterator&, const AnyContext&, RContext&,
             Attribute& attribute) const {
    if (first->kind != kind && first->kind != alternative) return false;
    x3::traits::move_to(first, attribute);
    ++first;
    return true;
  }

  TokenKind kind;
  TokenKind alternative;
  std::string_view expected;
};

/// A token for which `accepts` holds; the attribute is the token.
template <bool (*accepts)(const Token&)>
struct TokIf : x3::parser<TokIf<accepts>> {
  using attribute_type = Iterator;
  static constexpr bool has_attribute = true;

  template <class AnyContext, class RContext, class Attribute>
  bool parse(Iterator& first, const Iterator&, const AnyContext&, RContext&,
             Attribute& attribute) const {
    if (!accepts(*first)) return false;
    x3::traits::move_to(first, attribute);
    ++first;
    return true;
  }
};

/// Matches nothing; the attribute is the token that comes next.
struct Here : x3::parser<Here> {
  using attribute_type = Iterator;
  static constexpr bool has_attribute = true;

  template <class AnyContext, class RContext, class Attribute>
  bool parse(Iterator& first, const Iterator&, const AnyContext&, RContext&,
             Attribute& attribute) const {
    x3::traits::move_to(first, attribute);
    return true;
  }
};

/// Matches nothing; the attribute is the token read last.
struct Previous : x3::parser<Previous> {
  using attribute_type = Iterator;
  static constexpr bool has_attribute = true;

  template <class AnyContext, class RContext, class Attribute>
  bool parse(Iterator& first, const Iterator&, const AnyContext&, RContext&,
             Attribute& attribute) const {
    x3::traits::move_to(first - 1, attribute);
    return true;
  }
};

inline constexpr Here here{};
inline constexpr Previous previous{};
constexpr Tok tok(TokenKind kind, std::string_view expected = {}) { return Tok(kind, expected); }
constexpr TokAt tok_at(TokenKind kind, std::string_view expected = {}) {
  return TokAt(kind, expected);
}

// ---------------------------------------------------------------------------------------------
// Actions: `call<&Class::member>` calls one builder function with the parts of the attribute and
// makes its result the attribute of the rule.

inline Scratch& part(Builder& b, Scratch*) { return b.context.scratch; }
inline Converter& part(Builder& b, Converter*) { return b.converter; }
inline ExpressionBuilder& part(Builder& b, ExpressionBuilder*) { return b.expressions; }
inline TypeBuilder& part(Builder& b, TypeBuilder*) { return b.types; }
inline DeclarationBuilder& part(Builder& b, DeclarationBuilder*) { return b.declarations; }
inline AssertionBuilder& part(Builder& b, AssertionBuilder*) { return b.assertions; }

template <class T>
const T& plain(const T& value) {
  return value;
}
template <class T>
std::optional<T> plain(const boost::optional<T>& value) {
  if (!value) return std::nullopt;
  return *value;
}

/// Calls `function` with the members of a Fusion sequence, with nothing, or with the value itself.
template <class Function, class Attribute>
decltype(auto) with_parts(Function&& function, Attribute& attribute) {
  if constexpr (std::is_same_v<std::remove_cv_t<Attribute>, x3::unused_type>) {
    return function();
  } else if constexpr (boost::fusion::traits::is_sequence<Attribute>::value) {
    constexpr auto size =
        static_cast<std::size_t>(boost::fusion::result_of::size<Attribute>::value);
    return [&]<std::size_t... i>(std::index_sequence<i...>)->decltype(auto) {
      return function(plain(boost::fusion::at_c<static_cast<int>(i)>(attribute))...);
    }
    (std::make_index_sequence<size>{});
  } else {
    return function(plain(attribute));
  }
}

template <class Member>
struct ClassOf;
template <class C, class Result, class... Arguments>
struct ClassOf<Result (C::*)(Arguments...)> {
  using type = C;
  using result = Result;
};
template <class C, class Result, class... Arguments>
struct ClassOf<Result (C::*)(Arguments...) const> {
  using type = C;
  using result = Result;
};

template <auto member>
inline constexpr auto call = [](auto& context) {
  using Target = typename ClassOf<decltype(member)>::type;
  Target& target = part(builder(context), static_cast<Target*>(nullptr));
  const auto invoke = [&](const auto&... parts) -> decltype(auto) {
    return (target.*member)(parts...);
  };
  if constexpr (std::is_void_v<typename ClassOf<decltype(member)>::result>) {
    with_parts(invoke, x3::_attr(context));
  } else {
    x3::_val(context) = with_parts(invoke, x3::_attr(context));
  }
};

/// Pushes the attribute onto the scratch list of its type.
inline constexpr auto push = [](auto& context) {
  builder(context).context.scratch.push(x3::_attr(context));
};

// ---------------------------------------------------------------------------------------------
// Directives

/// The scratch items of type T that the subject pushes, as a list in the tree.
template <class T, class Subject>
struct ListDirective : x3::unary_parser<Subject, ListDirective<T, Subject>> {
  using base = x3::unary_parser<Subject, ListDirective<T, Subject>>;
  using attribute_type = ListRef<T>;
  static constexpr bool has_attribute = true;
  static constexpr bool has_action = false;  // the actions inside are its own affair

  explicit ListDirective(const Subject& s) : base(s) {}

  template <class AnyContext, class RContext, class Attribute>
  bool parse(Iterator& first, const Iterator& last, const AnyContext& context, RContext& rcontext,
             Attribute& attribute) const {
    Builder& b = builder(context);
    const std::size_t mark = b.context.scratch.template mark<T>();
    if (!this->subject.parse(first, last, context, rcontext, x3::unused)) {
      b.context.scratch.template drop<T>(mark);
      return false;
    }
    x3::traits::move_to(b.context.scratch.template take<T>(b.context.tree, mark), attribute);
    return true;
  }
};

template <class T, class Subject>
auto list_of(const Subject& subject) {
  return ListDirective<T, typename x3::extension::as_parser<Subject>::value_type>(
      x3::as_parser(subject));
}

/// One run of operands and operators (builder/operator_run.hpp, builder/type_builder.hpp), one
/// level deeper than what is around it.
template <class RunBuilder, class Result, class Subject>
struct RunDirective : x3::unary_parser<Subject, RunDirective<RunBuilder, Result, Subject>> {
  using base = x3::unary_parser<Subject, RunDirective<RunBuilder, Result, Subject>>;
  using attribute_type = Result;
  static constexpr bool has_attribute = true;
  static constexpr bool has_action = false;  // the actions inside are its own affair

  explicit RunDirective(const Subject& s) : base(s) {}

  template <class AnyContext, class RContext, class Attribute>
  bool parse(Iterator& first, const Iterator& last, const AnyContext& context, RContext& rcontext,
             Attribute& attribute) const {
    RunBuilder& runs = part(builder(context), static_cast<RunBuilder*>(nullptr));
    const auto run = runs.begin_run(first);
    if (!this->subject.parse(first, last, context, rcontext, x3::unused)) {
      runs.abandon_run(run);
      return false;
    }
    x3::traits::move_to(runs.end_run(run), attribute);
    return true;
  }
};

template <class RunBuilder, class Result, class Subject>
auto run_of(const Subject& subject) {
  return RunDirective<RunBuilder, Result, typename x3::extension::as_parser<Subject>::value_type>(
      x3::as_parser(subject));
}

/// `p, p, .., p`; after a comma another is required.
template <class Parser>
auto comma_separated(const Parser& p) {
  return p >> *(tok(TokenKind::comma) > p);
}

}  // namespace perentie::parser::grammar

// What an expectation failure says was expected: the name of the rule or token that came first.
namespace boost::spirit::x3 {

template <>
struct get_info<perentie::parser::grammar::Tok> {
  using result_type = std::string;
  std::string operator()(const perentie::parser::grammar::Tok& t) const {
    return t.expected.empty() ? perentie::parser::describe(t.kind) : std::string(t.expected);
  }
};

template <>
struct get_info<perentie::parser::grammar::TokAt> {
  using result_type = std::string;
  std::string operator()(const perentie::parser::grammar::TokAt& t) const {
    return t.expected.empty() ? perentie::parser::describe(t.kind) : std::string(t.expected);
  }
};

template <class Left, class Right>
struct get_info<sequence<Left, Right>> {
  using result_type = std::string;
  std::string operator()(const sequence<Left, Right>& p) const { return what(p.left); }
};

template <class Subject, class Action>
struct get_info<action<Subject, Action>> {
  using result_type = std::string;
  std::string operator()(const action<Subject, Action>& p) const { return what(p.subject); }
};

template <class T, class Subject>
struct get_info<perentie::parser::grammar::ListDirective<T, Subject>> {
  using result_type = std::string;
  std::string operator()(const perentie::parser::grammar::ListDirective<T, Subject>& p) const {
    return what(p.subject);
  }
};

}  // namespace boost::spirit::x3

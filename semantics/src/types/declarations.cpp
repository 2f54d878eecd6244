// The types that declarations give to what they define (CSPM reference 2).
#include <array>

#include <fmt/format.h>

#include "inference.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

using base::overload;

void TypeChecker::Impl::finish_decl(DeclId id) {
  std::visit(
      overload{
          [&](const parser::PatternDecl& d) { expect(d.value, of_pattern[d.pattern.value]); },
          [&](const parser::FunctionDecl&) {},  // its clauses have done it
          [&](const parser::ChannelDecl& d) { channel(id, d); },
          [&](const parser::DatatypeDecl& d) { d.is_subtype ? subtype(id, d) : datatype(id, d); },
          [&](const parser::NametypeDecl& d) {
            const TypeRef values = values_of(d.type);
            require(Constraint::complete, values, span(d.type));
            give(resolution.of_decl[id.value], types.set(values), span(d.type));
          },
          [&](const parser::AssertDecl& d) { assertion(d.assertion); },
          [&](const parser::TimedDecl& d) {
            if (!d.duration) return;
            const std::array<TypeRef, 2> parts{types.event(), types.integer()};
            expect(d.duration, types.function(parts));
          },
          [](const auto&) {},
      },
      tree.decls[id].node);
}

// The parameters of a clause have the types of those of the function, the body that of its result.
void TypeChecker::Impl::clause_types(SyntaxNode node) {
  const DeclId id{node.id};
  const auto& d = std::get<parser::FunctionDecl>(tree.decls[id].node);
  const parser::Clause& clause = tree.list(d.clauses)[node.index];
  const auto parameters = tree.list(clause.parameters);
  // From the outside: the type that is left of the function, then its parameters of this group.
  TypeRef function = mono(resolution.of_decl[id.value]);
  std::size_t next = 0;
  for (const std::uint32_t size : tree.list(clause.group_sizes)) {
    const auto known = unifier.known(function);
    if (known && types.kind(*known) == TypeKind::function &&
        types.children(*known).size() == size + 1) {
      for (std::uint32_t i = 0; i < size; ++i, ++next) {
        agree(types.child(*known, i), of_pattern[parameters[next].value],
              tree.patterns[parameters[next]].span);
      }
      function = types.children(*known).back();
      continue;
    }
    std::vector<TypeRef> parts;
    for (std::uint32_t i = 0; i < size; ++i) parts.push_back(of_pattern[parameters[next++].value]);
    parts.push_back(types.variable());
    const TypeRef result = parts.back();
    agree(function, types.function(parts), d.name.span);
    function = result;
  }
  results.push_back(function);
}

void TypeChecker::Impl::finish_clause(SyntaxNode node) {
  const auto& d = std::get<parser::FunctionDecl>(tree.decls[DeclId{node.id}].node);
  const TypeRef result = results.back();
  results.pop_back();
  expect(tree.list(d.clauses)[node.index].body, result);
}

// A declared symbol may have an annotated type, which the declaration has to have, too.
void TypeChecker::Impl::give(SymbolId symbol, TypeRef type, Span span) {
  agree(of_symbol[symbol.value].type, type, span);
}

// The type of the values that a type expression stands for: a tuple or a dot of sets is one of
// their values (2.3.2).
TypeRef TypeChecker::Impl::values_of(ExprId type_expression) {
  return elements_of(type(type_expression), span(type_expression));
}

TypeRef TypeChecker::Impl::elements_of(TypeRef set, Span span) {
  const auto known = unifier.known(set);
  if (!known) {
    report_clash(set, set, span);
    return types.any();
  }
  switch (types.kind(*known)) {
    case TypeKind::set:
      return types.child(*known, 0);
    case TypeKind::any:
      return *known;
    case TypeKind::tuple:
    case TypeKind::dot: {
      std::vector<TypeRef> parts;
      // The right spine of a dot is a loop: channels may have many fields.
      TypeRef rest = *known;
      while (types.kind(rest) == TypeKind::dot) {
        const TypeRef left = types.child(rest, 0);
        const TypeRef right = types.child(rest, 1);
        parts.push_back(elements_of(left, span));
        rest = types.find(right);
      }
      if (types.kind(*known) == TypeKind::dot) {
        parts.push_back(elements_of(rest, span));
        return types.dots(parts);
      }
      const std::vector<TypeRef> items(types.children(rest).begin(), types.children(rest).end());
      for (const TypeRef item : items) parts.push_back(elements_of(item, span));
      return types.tuple(parts);
    }
    default: {
      const TypeRef element = types.variable(Constraint::set);
      agree(types.set(element), *known, span);
      return element;
    }
  }
}

void TypeChecker::Impl::channel(DeclId id, const parser::ChannelDecl& d) {
  TypeRef channel_type = types.event();
  Span at = tree.decls[id].span;
  if (d.type) {
    at = span(d.type);
    const TypeRef fields = values_of(d.type);
    require(Constraint::eq, fields, at) && require(Constraint::complete, fields, at);
    channel_type = types.yield(fields, types.event());
  }
  for (const SymbolId symbol : resolution.members.at(id.value)) give(symbol, channel_type, at);
}

void TypeChecker::Impl::datatype(DeclId id, const parser::DatatypeDecl& d) {
  const SymbolId symbol = resolution.of_decl[id.value];
  const TypeRef whole = types.datatype(symbol);
  std::vector<TypeRef>& fields = fields_of[symbol.value];
  const auto& constructors = resolution.members.at(id.value);
  std::size_t i = 0;
  for (const parser::Constructor& c : tree.list(d.constructors)) {
    TypeRef constructor_type = whole;
    if (c.type) {
      fields.push_back(values_of(c.type));
      require(Constraint::complete, fields.back(), span(c.type));
      constructor_type = types.yield(fields.back(), whole);
    }
    give(constructors[i++], constructor_type, c.type ? span(c.type) : c.name.span);
  }
}

// Each part is a value of the datatype as far as it goes (2.3.7).
void TypeChecker::Impl::subtype(DeclId id, const parser::DatatypeDecl& d) {
  const TypeRef whole = types.variable(Constraint::yieldable);
  const auto& constructors = resolution.members.at(id.value);
  std::size_t i = 0;
  for (const parser::Constructor& c : tree.list(d.constructors)) {
    const TypeRef values = types.extendable(types.variable(), whole);
    TypeRef part = instance_of(constructors[i++], c.name.span);
    if (c.type) part = dotted({types.dot(part, values_of(c.type)), span(c.type)});
    agree(values, part, c.type ? span(c.type) : c.name.span);
  }
  give(resolution.of_decl[id.value], types.set(whole), d.name.span);
}

void TypeChecker::Impl::assertion(const parser::Assertion& assertion) {
  const TypeRef process = types.process();
  std::visit(overload{
                 [&](const parser::RefinementAssertion& a) {
                   expect(a.specification, process);
                   expect(a.implementation, process);
                 },
                 [&](const parser::PropertyAssertion& a) { expect(a.process, process); },
                 [&](const parser::HasTraceAssertion& a) {
                   expect(a.process, process);
                   for (const ExprId event : tree.list(a.trace)) expect(event, types.event());
                 },
             },
             assertion.claim);
  if (assertion.options.tau_priority) {
    expect(assertion.options.tau_priority, types.set(types.event()));
  }
}

}  // namespace perentie::semantics

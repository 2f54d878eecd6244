// The types that annotations say (CSPM reference 1.8, 2.2.5, 2.2.6).
#include <algorithm>

#include <fmt/format.h>

#include "inference.hpp"
#include "perentie/base/check.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

using base::NameId;
using base::overload;

std::optional<TypeChecker::Impl::Scheme> TypeChecker::Impl::annotation(SymbolId symbol) {
  const auto found = resolution.annotations.find(symbol.value);
  if (found == resolution.annotations.end()) return std::nullopt;
  const auto& d = std::get<parser::AnnotationDecl>(tree.decls[found->second].node);
  TypeVariables variables;
  Scheme scheme = annotated_type(d, variables);
  variables_of.insert_or_assign(symbol.value, std::move(variables));
  return scheme;
}

TypeChecker::Impl::Scheme TypeChecker::Impl::annotated_type(const parser::AnnotationDecl& d,
                                                            TypeVariables& variables) {
  std::vector<TypeRef> introduced;
  for (const parser::Constraint& c : tree.list(d.constraints)) {
    const std::string_view word = tree.names[c.constraint.name];
    const TypeRef variable = type_variable(c.variable.name, variables, introduced);
    if (!variables.contains(c.variable.name)) {
      report(codes::bad_annotation, c.variable.span,
             fmt::format("`{}` belongs to an annotation further out, where its constraints have "
                         "to be",
                         tree.names[c.variable.name]));
      continue;
    }
    const auto* constraint =
        std::ranges::find(all_constraints, word, [](Constraint known) { return name_of(known); });
    PERENTIE_CHECK(constraint != std::end(all_constraints), "the parser knows the constraints");
    ConstraintSet constraints;
    constraints.add(*constraint);
    types.constrain(variable, constraints);
  }
  const TypeRef type = type_of(d.type, variables, introduced);
  const std::vector<TypeRef> used = types.free_variables(type);
  for (const parser::Constraint& c : tree.list(d.constraints)) {
    const auto own = variables.find(c.variable.name);
    if (own == variables.end() || std::find(used.begin(), used.end(), own->second) != used.end()) {
      continue;
    }
    report(codes::bad_annotation, c.variable.span,
           fmt::format("`{}` is no variable of the type", tree.names[c.variable.name]));
  }
  return {type, std::move(introduced)};
}

// A variable of this annotation or of one further out; else it is introduced here.
TypeRef TypeChecker::Impl::type_variable(NameId name, TypeVariables& variables,
                                         std::vector<TypeRef>& introduced) {
  if (const auto found = variables.find(name); found != variables.end()) return found->second;
  for (auto scope = type_scopes.rbegin(); scope != type_scopes.rend(); ++scope) {
    if (const auto found = scope->find(name); found != scope->end()) return found->second;
  }
  const TypeRef variable = types.rigid_variable(name, {});
  variables.emplace(name, variable);
  introduced.push_back(variable);
  return variable;
}

TypeRef TypeChecker::Impl::named_type(parser::TypeId id, const parser::NamedType& name,
                                      TypeVariables& variables, std::vector<TypeRef>& introduced) {
  const SymbolId symbol =
      id.value < resolution.of_type.size() ? resolution.of_type[id.value] : SymbolId{};
  const auto parts = tree.list(name.name);
  if (symbol) {
    const Symbol& named = resolution.symbols[symbol];
    const auto* d = named.kind == SymbolKind::datatype
                        ? &std::get<parser::DatatypeDecl>(tree.decls[named.decl].node)
                        : nullptr;
    if (d != nullptr && !d->is_subtype) return types.datatype(symbol);
    report(codes::bad_annotation, tree.types[id].span,
           fmt::format("`{}` is {}, not a type", named.qualified,
                       d != nullptr ? "a subtype, whose values have the type of its datatype"
                                    : "not a datatype"));
    return types.any();
  }
  if (parts.size() > 1) return types.any();  // reported when names were resolved
  const std::string_view word = tree.names[parts[0]];
  if (word == "Int") return types.integer();
  if (word == "Bool") return types.boolean();
  if (word == "Char") return types.character();
  if (word == "Event") return types.event();
  if (word == "Proc") return types.process();
  return type_variable(parts[0], variables, introduced);
}

TypeRef TypeChecker::Impl::type_of(parser::TypeId id, TypeVariables& variables,
                                   std::vector<TypeRef>& introduced) {
  const auto of = [&](parser::TypeId part) { return type_of(part, variables, introduced); };
  // Dots, `=>` and `->` chain to the right without bound: the chain is a loop.
  struct Link {
    parser::TypeId id;
    std::vector<TypeRef> left;
  };
  std::vector<Link> chain;
  while (true) {
    const parser::TypeId next =
        std::visit(overload{
                       [&](const parser::DotType& t) {
                         chain.push_back({id, {of(t.left)}});
                         return t.right;
                       },
                       [&](const parser::YieldType& t) {
                         chain.push_back({id, {of(t.argument)}});
                         return t.result;
                       },
                       [&](const parser::ExtendableType& t) {
                         chain.push_back({id, {of(t.argument)}});
                         return t.result;
                       },
                       [&](const parser::FunctionType& t) {
                         Link link{id, {}};
                         for (const parser::TypeId a : tree.list(t.arguments))
                           link.left.push_back(of(a));
                         chain.push_back(std::move(link));
                         return t.result;
                       },
                       [](const auto&) { return parser::TypeId{}; },
                   },
                   tree.types[id].node);
    if (!next) break;
    id = next;
  }
  TypeRef type = std::visit(
      overload{
          [&](const parser::NamedType& t) { return named_type(id, t, variables, introduced); },
          [&](const parser::SetType& t) { return types.set(of(t.element)); },
          [&](const parser::SequenceType& t) { return types.sequence(of(t.element)); },
          [&](const parser::TupleType& t) {
            std::vector<TypeRef> items;
            for (const parser::TypeId item : tree.list(t.items)) items.push_back(of(item));
            return types.tuple(items);
          },
          [&](const parser::MapType& t) {
            const TypeRef key = of(t.key);
            return types.map(key, of(t.value));
          },
          [&](const auto&) { return types.any(); },  // a link, which the loop has taken
      },
      tree.types[id].node);
  for (auto link = chain.rbegin(); link != chain.rend(); ++link) {
    type =
        std::visit(overload{
                       [&](const parser::DotType&) { return types.dot(link->left[0], type); },
                       [&](const parser::YieldType&) { return types.yield(link->left[0], type); },
                       [&](const parser::ExtendableType& t) {
                         // Only a variable can stand for the fields that are missing (1.8).
                         const TypeRef missing = link->left[0];
                         if (types.kind(missing) == TypeKind::variable ||
                             types.kind(missing) == TypeKind::any) {
                           return types.extendable(missing, type);
                         }
                         report(codes::bad_annotation, tree.types[t.argument].span,
                                "the left side of `=>*` has to be a type variable");
                         return types.any();
                       },
                       [&](const parser::FunctionType&) {
                         link->left.push_back(type);
                         return types.function(link->left);
                       },
                       [&](const auto&) { return type; },
                   },
                   tree.types[link->id].node);
  }
  return type;
}

}  // namespace perentie::semantics

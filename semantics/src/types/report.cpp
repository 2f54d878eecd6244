// What is wrong with a type, in words.
#include <fmt/format.h>

#include "inference.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

std::string TypeChecker::Impl::text(TypeRef type, bool with_constraints) {
  return show_type(types, resolution, tree.names, type, with_constraints);
}

base::Diagnostic& TypeChecker::Impl::report(const base::DiagnosticCode& code, Span span,
                                            std::string message) {
  base::Diagnostic& diagnostic = diagnostics->report(code, span, std::move(message));
  if (open_groups.empty()) return diagnostic;
  for (const Item& item : groups[open_groups.front()].items) {
    if (!item.instance) continue;
    const SymbolId symbol = resolution.of_decl[item.instance.value];
    diagnostic.notes.push_back(
        {resolution.symbols[symbol].span,
         fmt::format("in the instance `{}`", resolution.symbols[symbol].qualified)});
    break;
  }
  return diagnostic;
}

// What `found` has to take to become what is expected; nothing if that does not help.
std::string TypeChecker::Impl::missing_fields(TypeRef found, TypeRef expected) {
  std::vector<std::string> fields;
  found = types.find(found);
  expected = types.find(expected);
  while (types.kind(found) == TypeKind::yield) {
    fields.push_back(fmt::format("`{}`", text(types.child(found, 0))));
    found = types.find(types.child(found, 1));
  }
  const bool helps = types.kind(expected) == types.kind(found) &&
                     types[expected].datatype == types[found].datatype;
  if (!helps || fields.empty()) return {};
  return fields.size() == 1 ? fmt::format("the field {} is missing", fields[0])
                            : fmt::format("the fields {} are missing", fmt::join(fields, ", "));
}

void TypeChecker::Impl::report_clash(TypeRef expected, TypeRef found, Span span) {
  const TypeClash clash = unifier.clash();
  found = unifier.known(found).value_or(found);
  const std::string left = text(clash.left);
  const std::string right = clash.right ? text(clash.right) : "";
  switch (clash.kind) {
    case TypeClash::Kind::different: {
      const std::string whole = text(found);
      auto& diagnostic =
          report(codes::type_mismatch, span,
                 fmt::format("this has the type `{}`, but `{}` is needed", whole, text(expected)));
      const std::string missing = missing_fields(found, expected);
      if (!missing.empty()) {
        diagnostic.notes.push_back({std::nullopt, missing});
      } else if (whole != left && whole != right) {
        diagnostic.notes.push_back(
            {std::nullopt, fmt::format("`{}` and `{}` do not agree", left, right)});
      }
      break;
    }
    case TypeClash::Kind::unsatisfied: {
      constexpr auto reasons = [](Constraint constraint) -> std::string_view {
        switch (constraint) {
          case Constraint::eq:
            return "values of type `{}` cannot be compared";
          case Constraint::ord:
            return "values of type `{}` have no order";
          case Constraint::set:
            return "values of type `{}` cannot be in a set";
          case Constraint::complete:
            return "a complete value is needed, but a `{}` still takes fields";
          case Constraint::yieldable:
            return "a channel or constructor is needed, but this is a `{}`";
        }
        return {};
      };
      auto& diagnostic = report(codes::unsatisfied_constraint, span,
                                fmt::format(fmt::runtime(reasons(clash.constraint)), left));
      if (types[clash.left].is_rigid) {
        diagnostic.notes.push_back({std::nullopt, fmt::format("the annotation has to say `{} {}`",
                                                              name_of(clash.constraint), left)});
      }
      break;
    }
    case TypeClash::Kind::infinite:
      report(codes::infinite_type, span,
             fmt::format("the type `{}` of this would have to be `{}`, which contains it", left,
                         right));
      break;
    case TypeClash::Kind::rigid:
      report(codes::annotation_too_general, span,
             fmt::format("the annotation says that `{}` is any type, but here it is `{}`", left,
                         right));
      break;
    case TypeClash::Kind::too_deep:
      report(codes::type_too_deep, span, "the type of this is nested too deeply");
      break;
  }
}

}  // namespace perentie::semantics

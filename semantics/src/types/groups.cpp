// Groups of declarations that refer to each other, each inferred when those that it needs are.
#include <algorithm>

#include <fmt/format.h>

#include "dependencies.hpp"
#include "inference.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

using base::overload;
using NodeKind = SyntaxNode::Kind;

// All declarations of a script in one list: members of modules and of timed sections too.
void TypeChecker::Impl::collect(parser::DeclList list, std::uint32_t module, DeclId instance,
                                std::vector<Item>& items) {
  for (const DeclId id : tree.list(list)) {
    std::visit(overload{
                   [&](const parser::ModuleDecl& d) { collect_module(d, module, instance, items); },
                   [&](const parser::InstanceDecl&) {
                     const auto found = resolution.instances.find(id.value);
                     if (found == resolution.instances.end()) return;
                     for (const DeclId p : found->second.parameters)
                       items.push_back({p, module, id});
                     const auto& copy =
                         std::get<parser::ModuleDecl>(tree.decls[found->second.module].node);
                     collect(copy.private_declarations, module, id, items);
                     collect(copy.exported_declarations, module, id, items);
                   },
                   [&](const parser::TimedDecl& d) {
                     if (d.duration) items.push_back({id, module, instance});
                     collect(d.declarations, module, instance, items);
                   },
                   [](const parser::AnnotationDecl&) {},
                   [](const parser::ImportDecl&) {},
                   [&](const auto&) {
                     items.push_back({id, module, instance});
                   },
               },
               tree.decls[id].node);
  }
}

void TypeChecker::Impl::collect_module(const parser::ModuleDecl& module, std::uint32_t around,
                                       DeclId instance, std::vector<Item>& items) {
  std::uint32_t inside = around;
  if (!module.parameters.empty()) {
    std::vector<SymbolId> parameters = modules[around];
    std::vector<SyntaxNode> stack;
    for (const PatternId p : tree.list(module.parameters)) {
      stack.push_back({NodeKind::pattern, p.value});
    }
    while (!stack.empty()) {
      const SyntaxNode node = stack.back();
      stack.pop_back();
      if (const SymbolId symbol = resolution.of_pattern[node.id]) parameters.push_back(symbol);
      append_children(tree, node, stack);
    }
    modules.push_back(std::move(parameters));
    inside = static_cast<std::uint32_t>(modules.size() - 1);
  }
  collect(module.private_declarations, inside, instance, items);
  collect(module.exported_declarations, inside, instance, items);
}

void TypeChecker::Impl::schedule_groups(const std::vector<Item>& items, bool is_top) {
  std::vector<DeclId> decls;
  decls.reserve(items.size());
  for (const Item& item : items) decls.push_back(item.decl);
  const auto components = dependency_groups(tree, resolution, decls);
  for (auto component = components.rbegin(); component != components.rend(); ++component) {
    Group group{.items = {}, .is_top = is_top};
    for (const std::uint32_t i : *component) group.items.push_back(items[i]);
    const auto number = static_cast<std::uint32_t>(groups.size());
    tasks.push_back({Task::Kind::close_group, {NodeKind::decl, number}});
    for (auto item = group.items.rbegin(); item != group.items.rend(); ++item) {
      tasks.push_back({Task::Kind::enter, {NodeKind::decl, item->decl.value}});
    }
    tasks.push_back({Task::Kind::open_group, {NodeKind::decl, number}});
    groups.push_back(std::move(group));
  }
}

// Everything that the group defines gets a type to begin with.
void TypeChecker::Impl::open_group(Group& group) {
  group.errors_before = diagnostics->error_count();
  for (const Item& item : group.items) {
    for (const SymbolId symbol : defined_symbols(tree, resolution, item.decl)) {
      Scheme& scheme = of_symbol[symbol.value];
      if (auto annotated = annotation(symbol)) {
        scheme = std::move(*annotated);
      } else {
        scheme = {types.variable(), {}};
      }
    }
    const auto* d = std::get_if<parser::DatatypeDecl>(&tree.decls[item.decl].node);
    if (d != nullptr && !d->is_subtype) {
      const SymbolId symbol = resolution.of_decl[item.decl.value];
      of_symbol[symbol.value] = {types.set(types.datatype(symbol)), {}};
    }
  }
}

void TypeChecker::Impl::close_group(Group& group) {
  for (const Item& item : group.items) check_no_escape(item);
  if (!group.is_top) return;
  settle_pending_dots();
  decide_equality(group);
  const auto is_wrong = [&] { return diagnostics->error_count() > group.errors_before; };
  if (!is_wrong()) {
    for (const Item& item : group.items) check_no_polymorphism(item);
  }
  for (const Item& item : group.items) {
    if (!is_wrong()) {
      generalise(item);
      continue;
    }
    for (const SymbolId symbol : defined_symbols(tree, resolution, item.decl)) {
      if (resolution.annotations.contains(symbol.value)) continue;
      of_symbol[symbol.value] = {types.any(), {}};
    }
  }
}

// Values of a datatype can be compared if all their fields can: assumed, until a field cannot
// (3.1.3).
void TypeChecker::Impl::decide_equality(const Group& group) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const Item& item : group.items) {
      const SymbolId symbol = resolution.of_decl[item.decl.value];
      if (!symbol || !unifier.is_eq(symbol)) continue;
      const auto fields = fields_of.find(symbol.value);
      if (fields == fields_of.end()) continue;
      const bool all = std::all_of(fields->second.begin(), fields->second.end(),
                                   [&](TypeRef f) { return unifier.require(Constraint::eq, f); });
      if (all) continue;
      unifier.set_not_eq(symbol);
      changed = true;
    }
  }
  unifier.take_eq_assumptions();
  for (const EqAssumption& assumption : std::exchange(eq_assumptions, {})) {
    if (unifier.is_eq(assumption.datatype)) continue;
    report(codes::unsatisfied_constraint, assumption.span,
           fmt::format("values of the datatype `{}` cannot be compared, as it has a field that "
                       "cannot be",
                       resolution.symbols[assumption.datatype].qualified));
  }
}

void TypeChecker::Impl::generalise(const Item& item) {
  std::vector<TypeRef> fixed;
  for (const SymbolId parameter : modules[item.module]) {
    const auto variables = types.free_variables(mono(parameter));
    fixed.insert(fixed.end(), variables.begin(), variables.end());
  }
  for (const SymbolId symbol : defined_symbols(tree, resolution, item.decl)) {
    Scheme& scheme = of_symbol[symbol.value];
    if (resolution.annotations.contains(symbol.value)) continue;
    scheme.variables.clear();
    for (const TypeRef variable : types.free_variables(scheme.type)) {
      if (types[variable].is_rigid) continue;
      if (std::find(fixed.begin(), fixed.end(), variable) == fixed.end()) {
        scheme.variables.push_back(variable);
      }
    }
  }
}

// The variables of an annotation stand for any type only inside what is annotated.
void TypeChecker::Impl::check_no_escape(const Item& item) {
  for (const SymbolId symbol : defined_symbols(tree, resolution, item.decl)) {
    const Scheme& scheme = of_symbol[symbol.value];
    for (const TypeRef variable : types.free_variables(scheme.type)) {
      if (!types[variable].is_rigid || is_in_scope(variable) ||
          std::find(scheme.variables.begin(), scheme.variables.end(), variable) !=
              scheme.variables.end()) {
        continue;
      }
      report(codes::annotation_too_general, *resolution.symbols[symbol].span,
             fmt::format("the annotation of something inside `{}` says that `{}` is any type, but "
                         "the type of `{}` depends on it",
                         resolution.symbols[symbol].qualified, text(variable),
                         resolution.symbols[symbol].qualified));
      break;
    }
  }
}

bool TypeChecker::Impl::is_in_scope(TypeRef variable) const {
  return std::any_of(type_scopes.begin(), type_scopes.end(), [&](const TypeVariables& scope) {
    return std::any_of(scope.begin(), scope.end(),
                       [&](const auto& entry) { return entry.second == variable; });
  });
}

// Channels and constructors carry values of one type (2.3.10).
void TypeChecker::Impl::check_no_polymorphism(const Item& item) {
  const parser::Decl& decl = tree.decls[item.decl];
  const bool is_channel = std::holds_alternative<parser::ChannelDecl>(decl.node);
  if (!is_channel && !std::holds_alternative<parser::DatatypeDecl>(decl.node)) return;
  if (!modules[item.module].empty()) return;  // its instances are checked
  for (const SymbolId symbol : defined_symbols(tree, resolution, item.decl)) {
    const TypeRef type = of_symbol[symbol.value].type;
    if (resolution.annotations.contains(symbol.value) || types.free_variables(type).empty()) {
      continue;
    }
    report(codes::polymorphic_fields, *resolution.symbols[symbol].span,
           fmt::format("the {} `{}` has the polymorphic type `{}`",
                       is_channel                                                   ? "channel"
                       : resolution.symbols[symbol].kind == SymbolKind::constructor ? "constructor"
                                                                                    : "subtype",
                       resolution.symbols[symbol].qualified, text(type)));
  }
}

}  // namespace perentie::semantics

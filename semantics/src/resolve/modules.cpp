// Modules and their instances (CSPM reference 2.9).
#include "resolver.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "perentie/parser/copy.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

void Resolver::Impl::declare_module(Group& group, const parser::ModuleDecl& d, DeclId id) {
  const SymbolId symbol = declare(group, d.name.name, d.name.span, SymbolKind::module, id);
  result.of_decl[id.value] = symbol;
  Group members{.names = {},
                .prefix = result.symbols[symbol].qualified + "::",
                .parent = &group,
                .is_parameterised = group.is_parameterised || !d.parameters.empty()};
  const std::vector<PatternId> parameters(tree.list(d.parameters).begin(),
                                          tree.list(d.parameters).end());
  for (const PatternId parameter : parameters) declare_pattern(members, parameter, id);
  declare_members(members, symbol, id);
  result.modules.at(symbol.value).is_parameterised = !parameters.empty();
}

// Declares the members of a module into `members`, which may have its parameters already.
void Resolver::Impl::declare_members(Group& members, SymbolId symbol, DeclId module) {
  const auto d = std::get<parser::ModuleDecl>(tree.decls[module].node);
  modules_in_declaration.push_back(module);
  declare_names(members, d.private_declarations);
  ModuleMembers table{.exported = {}, .private_ = members.names, .decl = module};
  declare_names(members, d.exported_declarations);
  modules_in_declaration.pop_back();
  check_annotations(d.private_declarations, members);
  check_annotations(d.exported_declarations, members);
  for (const auto& [name, member] : members.names) {
    if (!table.private_.contains(name)) table.exported.emplace(name, member);
  }
  result.modules.emplace(symbol.value, std::move(table));
}

// An instance is a copy of its module, beside the definitions of the parameters.
void Resolver::Impl::declare_instance(Group& group, const parser::InstanceDecl& d, DeclId id) {
  const SymbolId symbol = declare(group, d.name.name, d.name.span, SymbolKind::module, id);
  result.of_decl[id.value] = symbol;
  const SymbolId module = module_to_instantiate(group, d, symbol);
  if (!module) {
    result.symbols[symbol].kind = SymbolKind::unsupported;  // no second error where it is used
    result.symbols[symbol].unsupported_construct = "instances of what is no module";
    return;
  }
  const DeclId original = result.modules.at(module.value).decl;
  ModuleInstance instance{.module = parser::copy_declaration(tree, original), .parameters = {}};
  const auto copy = std::get<parser::ModuleDecl>(tree.decls[instance.module].node);
  for (std::uint32_t i = 0; i < d.arguments.count; ++i) {
    instance.parameters.push_back(
        tree.decls.add({d.module_span, parser::PatternDecl{tree.list(copy.parameters)[i],
                                                           tree.list(d.arguments)[i]}}));
  }
  make_room();
  Group members{.names = {},
                .prefix = result.symbols[symbol].qualified + "::",
                .parent = &group,
                .is_parameterised = group.is_parameterised};
  for (const DeclId parameter : instance.parameters) {
    const auto definition = std::get<parser::PatternDecl>(tree.decls[parameter].node);
    declare_pattern(members, definition.pattern, parameter);
  }
  begin_copy();
  declare_members(members, symbol, instance.module);
  end_copy();
  instances_of[original.value].push_back(id);
  result.instances.emplace(id.value, std::move(instance));
}

void Resolver::Impl::begin_copy() {
  if (copies_open++ == 0) sink_outside_copies = std::exchange(diagnostics, &errors_in_copies);
}

void Resolver::Impl::end_copy() {
  if (--copies_open == 0) diagnostics = sink_outside_copies;
}

// The module that an instance is to be made of; none if it cannot be, which is reported.
SymbolId Resolver::Impl::module_to_instantiate(const Group& group, const parser::InstanceDecl& d,
                                               SymbolId instance) {
  const auto parts = tree.list(d.module);
  SymbolId module = declared(group, parts[0]);
  if (!module || module == instance) {
    auto& report = diagnostics->report(codes::not_in_scope, d.module_span,
                                       fmt::format("`{}` is not in scope", text(parts[0])));
    report.notes.push_back({std::nullopt, "an instance must come after its module"});
    return {};
  }
  for (std::size_t i = 1; i < parts.size() && module; ++i) {
    module = lookup_member(module, parts[i], d.module_span);
  }
  if (!module) return {};
  const auto found = result.modules.find(module.value);
  if (found == result.modules.end()) {
    // A module whose members are being declared is not in the table yet.
    const bool is_around = std::find(modules_in_declaration.begin(), modules_in_declaration.end(),
                                     result.symbols[module].decl) != modules_in_declaration.end();
    const std::string_view qualified = result.symbols[module].qualified;
    if (is_around) {
      diagnostics->report(
          codes::bad_instance, d.module_span,
          fmt::format("the module `{}` cannot hold an instance of itself", qualified));
    } else {
      diagnostics->report(codes::module_as_value, d.module_span,
                          fmt::format("`{}` is not a module", qualified));
    }
    return {};
  }
  const auto& original = std::get<parser::ModuleDecl>(tree.decls[found->second.decl].node);
  if (original.parameters.count == d.arguments.count) return module;
  auto& report = diagnostics->report(
      codes::bad_instance, d.module_span,
      fmt::format("the module `{}` takes {} parameter{}, but gets {}",
                  result.symbols[module].qualified, original.parameters.count,
                  original.parameters.count == 1 ? "" : "s", d.arguments.count));
  report.notes.push_back({result.symbols[module].span, "it is defined here"});
  return {};
}

void Resolver::Impl::open_module(SymbolId module) {
  open_scope();
  open_modules.push_back(module);
  const ModuleMembers members = result.modules.at(module.value);
  bind_all(members.private_);
  bind_all(members.exported);
}

void Resolver::Impl::close_module() {
  open_modules.pop_back();
  close_scope();
}

// Such an instance would be defined by itself (2.9.8).
bool Resolver::Impl::is_instance_of_open_module(SymbolId module) const {
  return std::any_of(open_modules.begin(), open_modules.end(), [&](SymbolId open) {
    const auto instances = instances_of.find(result.symbols[open].decl.value);
    if (instances == instances_of.end()) return false;
    const auto& decls = instances->second;
    return std::find(decls.begin(), decls.end(), result.symbols[module].decl) != decls.end();
  });
}

// The parameters' patterns bind nothing here, but may name constructors to match.
void Resolver::Impl::visit_module(SymbolId module) {
  using K = Task::Kind;
  const auto& d =
      std::get<parser::ModuleDecl>(tree.decls[result.modules.at(module.value).decl].node);
  tasks.push_back({K::close_module});
  then_all(K::bodies, tree.list(d.exported_declarations));
  then_all(K::bodies, tree.list(d.private_declarations));
  then_all(K::pattern, tree.list(d.parameters));
  tasks.push_back({K::open_module, module.value});
}

}  // namespace perentie::semantics

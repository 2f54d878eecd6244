// Scopes, built-ins and look-up: what a name stands for.
#include "resolver.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "perentie/base/text.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

SymbolId Resolver::Impl::binding(NameId name) const {
  return name.value < bindings.size() ? bindings[name.value] : SymbolId{};
}

void Resolver::Impl::bind(NameId name, SymbolId symbol) {
  if (name.value >= bindings.size()) bindings.resize(tree.names.size());
  undo_log.push_back({name, bindings[name.value]});
  bindings[name.value] = symbol;
}

void Resolver::Impl::close_scope() {
  for (; undo_log.size() > scope_marks.back(); undo_log.pop_back()) {
    bindings[undo_log.back().name.value] = undo_log.back().previous;
  }
  scope_marks.pop_back();
}

// The symbol that the innermost scope itself gives to a name, if any.
SymbolId Resolver::Impl::bound_in_innermost_scope(NameId name) const {
  const std::size_t mark = scope_marks.empty() ? 0 : scope_marks.back();
  for (std::size_t i = undo_log.size(); i > mark; --i) {
    if (undo_log[i - 1].name == name) return binding(name);
  }
  return {};
}

void Resolver::Impl::declare_builtins(base::Interner& names) {
  for (std::size_t i = 0; i < builtin_table.size(); ++i) {
    const BuiltinInfo& builtin = builtin_table[i];
    if (builtin.kind == BuiltinKind::prelude) continue;
    const NameId name = names.intern(builtin.name);
    Symbol symbol{.kind = SymbolKind::builtin,
                  .name = name,
                  .qualified = std::string(builtin.name),
                  .span = std::nullopt,
                  .builtin = static_cast<Builtin>(i)};
    symbol.groups = builtin.arguments.empty() ? 0 : 1;
    symbol.is_process = builtin.kind == BuiltinKind::process_constant ||
                        builtin.kind == BuiltinKind::process_function ||
                        builtin.kind == BuiltinKind::opaque;
    const SymbolId id = result.symbols.add(std::move(symbol));
    if (builtin.import == Import::no) {
      bind(name, id);
    } else {
      importable.emplace(name, id);
    }
  }
}

// The prelude's definitions become the built-ins that the table calls `prelude`; its auxiliary
// functions go out of scope again.
void Resolver::Impl::adopt_prelude() {
  for (const Undo& entry : std::vector<Undo>(undo_log)) {
    const SymbolId symbol = binding(entry.name);
    if (!symbol) continue;
    if (result.symbols[symbol].kind == SymbolKind::builtin) {
      // What the prelude itself imports goes out of scope again.
      if (importable.contains(entry.name)) bindings[entry.name.value] = SymbolId{};
      continue;
    }
    const std::string_view name = text(entry.name);
    result.prelude.emplace(name, symbol);
    const auto row = std::find_if(builtin_table.begin(), builtin_table.end(),
                                  [&](const BuiltinInfo& b) { return b.name == name; });
    if (row != builtin_table.end() && row->import == Import::no) continue;
    bindings[entry.name.value] = SymbolId{};
    if (row == builtin_table.end()) continue;
    result.symbols[symbol].builtin = static_cast<Builtin>(row - builtin_table.begin());
    importable.emplace(entry.name, symbol);
  }
}

void Resolver::Impl::report_not_in_scope(NameId name, Span span) {
  auto& report = diagnostics->report(codes::not_in_scope, span,
                                     fmt::format("`{}` is not in scope", text(name)));
  if (const auto import = importable.find(name); import != importable.end()) {
    report.notes.push_back({std::nullopt, import_hint(result.symbols[import->second])});
    return;
  }
  std::vector<std::string_view> candidates;
  for (std::uint32_t i = 0; i < bindings.size(); ++i) {
    const std::string_view candidate = text(NameId{i});
    if (bindings[i] && !candidate.ends_with('_')) candidates.push_back(candidate);
  }
  for (const std::string_view word : base::nearest_words(text(name), candidates)) {
    const Symbol& symbol = result.symbols[binding(*tree.names.find(word))];
    report.notes.push_back({symbol.span, fmt::format("did you mean `{}`?", word)});
  }
}

std::string Resolver::Impl::import_hint(const Symbol& symbol) {
  const Import import = info(symbol.builtin).import;
  if (import == Import::timed) {
    return fmt::format("`{}` is built in, but known in timed sections only", symbol.qualified);
  }
  return fmt::format("`{0}` is built in: bring it into scope with `{1} {0}`", symbol.qualified,
                     import == Import::transparent ? "transparent" : "external");
}

SymbolId Resolver::Impl::lookup(parser::QualifiedName qualified, Span span) {
  const auto parts = tree.list(qualified);
  const SymbolId first = binding(parts[0]);
  if (!first) {
    report_not_in_scope(parts[0], span);
    return {};
  }
  if (parts.size() > 1 && is_instance_of_open_module(first)) {
    auto& report = diagnostics->report(
        codes::bad_instance, span,
        fmt::format("a module cannot use what belongs to an instance of itself, `{}`",
                    text(parts[0])));
    report.notes.push_back({result.symbols[first].span, "the instance is made here"});
    return {};
  }
  SymbolId current = first;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (result.symbols[current].kind == SymbolKind::unsupported) return current;
    current = lookup_member(current, parts[i], span);
    if (!current) return {};
  }
  result.symbols[current].is_used = true;
  return current;
}

SymbolId Resolver::Impl::lookup_member(SymbolId module, NameId member, Span span) {
  const Symbol& symbol = result.symbols[module];
  if (symbol.kind != SymbolKind::module) {
    diagnostics->report(codes::module_as_value, span,
                        fmt::format("`{}` is not a module", symbol.qualified));
    return {};
  }
  const ModuleMembers& members = result.modules.at(module.value);
  if (members.is_parameterised) {
    auto& report = diagnostics->report(
        codes::module_without_instance, span,
        fmt::format("the module `{}` takes parameters: its members belong to its instances",
                    symbol.qualified));
    report.notes.push_back(
        {symbol.span, fmt::format("make one with `instance N = {}(..)`", symbol.qualified)});
    return {};
  }
  if (const auto found = members.exported.find(member); found != members.exported.end()) {
    return found->second;
  }
  if (const auto found = members.private_.find(member); found != members.private_.end()) {
    auto& report = diagnostics->report(
        codes::private_member, span,
        fmt::format("`{}` is private to the module `{}`", text(member), symbol.qualified));
    report.notes.push_back(
        {result.symbols[found->second].span, "to make it visible, move it behind `exports`"});
    return {};
  }
  auto& report = diagnostics->report(
      codes::not_in_scope, span,
      fmt::format("the module `{}` has no member `{}`", symbol.qualified, text(member)));
  std::vector<std::string_view> candidates;
  for (const auto& [name, id] : members.exported) candidates.push_back(text(name));
  for (const std::string_view word : base::nearest_words(text(member), candidates)) {
    report.notes.push_back({std::nullopt, fmt::format("did you mean `{}`?", word)});
  }
  return {};
}

}  // namespace perentie::semantics

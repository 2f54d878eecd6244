// Groups of declarations: all names of a group first, then the bodies.
#include "resolver.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "../pattern_names.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/base/text.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

using base::overload;

// What a name stands for where a group is declared, as far as it is declared by now.
SymbolId Resolver::Impl::declared(const Group& innermost, NameId name) const {
  for (const Group* group = &innermost; group != nullptr; group = group->parent) {
    if (const auto found = group->names.find(name); found != group->names.end()) {
      return found->second;
    }
  }
  return binding(name);
}

SymbolId Resolver::Impl::declare(Group& group, NameId name, Span span, SymbolKind kind, DeclId decl,
                                 std::uint32_t index) {
  const SymbolId symbol =
      result.symbols.add(Symbol{.kind = kind,
                                .name = name,
                                .qualified = group.prefix + std::string(text(name)),
                                .span = span,
                                .decl = decl,
                                .index = index});
  const auto [entry, inserted] = group.names.emplace(name, symbol);
  if (!inserted) {
    auto& report =
        diagnostics->report(codes::multiple_definitions, span,
                            fmt::format("`{}` has more than one definition", text(name)));
    report.notes.push_back({result.symbols[entry->second].span, "it is defined here first"});
    if (kind == SymbolKind::function &&
        result.symbols[entry->second].kind == SymbolKind::function) {
      report.notes.push_back(
          {std::nullopt, "the clauses of a function must follow each other directly"});
    }
  }
  return symbol;
}

void Resolver::Impl::declare_names(Group& group, DeclList list) {
  // Channels and constructors first: a pattern that names one binds nothing (1.9.2).
  // The tree grows with each instance, which moves its lists.
  const std::vector<DeclId> ids(tree.list(list).begin(), tree.list(list).end());
  for (const DeclId id : ids) declare_types(group, id);
  for (const DeclId id : ids) declare_values(group, id);
}

void Resolver::Impl::declare_types(Group& group, DeclId id) {
  const parser::Decl& decl = tree.decls[id];
  std::visit(overload{
                 [&](const parser::ChannelDecl& d) {
                   std::uint32_t index = 0;
                   for (const parser::Identifier& name : tree.list(d.names)) {
                     const SymbolId channel =
                         declare(group, name.name, name.span, SymbolKind::channel, id, index++);
                     if (!group.is_parameterised) result.channels.push_back(channel);
                     result.members[id.value].push_back(channel);
                   }
                 },
                 [&](const parser::DatatypeDecl& d) {
                   result.of_decl[id.value] =
                       declare(group, d.name.name, d.name.span, SymbolKind::datatype, id);
                   if (d.is_subtype) return;
                   std::uint32_t index = 0;
                   for (const parser::Constructor& c : tree.list(d.constructors)) {
                     result.members[id.value].push_back(declare(
                         group, c.name.name, c.name.span, SymbolKind::constructor, id, index++));
                   }
                 },
                 [](const auto&) {},
             },
             decl.node);
}

void Resolver::Impl::declare_values(Group& group, DeclId id) {
  const parser::Decl decl = tree.decls[id];
  std::visit(overload{
                 [&](const parser::PatternDecl& d) { declare_pattern(group, d.pattern, id); },
                 [&](const parser::FunctionDecl& d) {
                   const SymbolId symbol =
                       declare(group, d.name.name, d.name.span, SymbolKind::function, id);
                   result.symbols[symbol].groups = tree.list(d.clauses)[0].group_sizes.count;
                   result.of_decl[id.value] = symbol;
                 },
                 [&](const parser::NametypeDecl& d) {
                   result.of_decl[id.value] =
                       declare(group, d.name.name, d.name.span, SymbolKind::nametype, id);
                 },
                 [&](const parser::ImportDecl& d) {
                   for (const parser::Identifier& name : tree.list(d.names)) {
                     declare_import(group, d.is_external, name);
                   }
                 },
                 [&](const parser::ModuleDecl& d) { declare_module(group, d, id); },
                 [&](const parser::InstanceDecl& d) { declare_instance(group, d, id); },
                 [&](const parser::TimedDecl& d) { declare_names(group, d.declarations); },
                 [](const auto&) {},
             },
             decl.node);
}

void Resolver::Impl::declare_import(Group& group, bool is_external,
                                    const parser::Identifier& name) {
  const auto found = importable.find(name.name);
  const auto allowed = [&](SymbolId symbol) {
    const Import import = info(result.symbols[symbol].builtin).import;
    return import == Import::either ||
           import == (is_external ? Import::external : Import::transparent);
  };
  if (found != importable.end() && allowed(found->second)) {
    group.names.emplace(name.name, found->second);
    return;
  }
  const std::string_view word = is_external ? "external" : "transparent";
  auto& report =
      diagnostics->report(codes::unknown_import, name.span,
                          fmt::format("there is no {} function `{}`", word, text(name.name)));
  if (found != importable.end()) {
    report.notes.push_back({std::nullopt, import_hint(result.symbols[found->second])});
    group.names.emplace(name.name, found->second);  // no second error where it is used
    return;
  }
  std::vector<std::string_view> candidates;
  for (const BuiltinInfo& builtin : builtin_table) {
    if (builtin.import != Import::no) candidates.push_back(builtin.name);
  }
  for (const std::string_view near : base::nearest_words(text(name.name), candidates)) {
    report.notes.push_back({std::nullopt, fmt::format("did you mean `{}`?", near)});
  }
}

void Resolver::Impl::declare_pattern(Group& group, PatternId root, DeclId decl) {
  for_each_name(tree, root, [&](PatternId id, const parser::NamePattern& p) {
    const auto parts = tree.list(p.name);
    if (parts.size() > 1) return;
    // `A = 3` defines A; inside a larger pattern, a known constructor only matches.
    if (id != root && names_atom(group, parts[0])) return;
    result.of_pattern[id.value] =
        declare(group, parts[0], tree.patterns[id].span, SymbolKind::constant, decl);
  });
}

bool Resolver::Impl::names_atom(const Group& group, NameId name) const {
  const SymbolId symbol = declared(group, name);
  return symbol && is_atom(result.symbols[symbol].kind);
}

void Resolver::Impl::bind_all(const std::unordered_map<NameId, SymbolId>& names) {
  for (const auto& [name, symbol] : names) bind(name, symbol);
}

void Resolver::Impl::check_annotations(DeclList list, const Group& group) {
  std::unordered_map<NameId, Span> annotated;
  for (const DeclId id : tree.list(list)) {
    if (const auto* timed = std::get_if<parser::TimedDecl>(&tree.decls[id].node)) {
      check_annotations(timed->declarations, group);
    }
    const auto* d = std::get_if<parser::AnnotationDecl>(&tree.decls[id].node);
    if (d == nullptr) continue;
    for (const parser::Identifier& name : tree.list(d->names)) {
      const auto defined = group.names.find(name.name);
      if (defined != group.names.end()) {
        result.annotations.emplace(defined->second.value, id);
      } else {
        diagnostics->report(
            codes::annotation_misplaced, name.span,
            fmt::format("`{}` has a type annotation but no definition at the same level",
                        text(name.name)));
      }
      const auto [first, inserted] = annotated.emplace(name.name, name.span);
      if (inserted) continue;
      auto& report =
          diagnostics->report(codes::annotation_misplaced, name.span,
                              fmt::format("`{}` is annotated more than once", text(name.name)));
      report.notes.push_back({first->second, "it is annotated here first"});
    }
  }
}

void Resolver::Impl::visit_declarations(DeclList list) {
  Group group;
  declare_names(group, list);
  check_annotations(list, group);
  bind_all(group.names);
  then_all(Task::Kind::bodies, tree.list(list));
}

void Resolver::Impl::visit_bodies(DeclId id) {
  using K = Task::Kind;
  std::visit(overload{
                 [&](const parser::PatternDecl& d) {
                   then({{K::pattern, d.pattern.value}, {K::expr, d.value.value}});
                 },
                 [&](const parser::FunctionDecl& d) {
                   check_clauses(d);
                   for (std::uint32_t i = d.clauses.count; i > 0; --i) {
                     tasks.push_back({K::clause, id.value, i - 1});
                   }
                 },
                 [&](const parser::ChannelDecl& d) { then_expr(d.type); },
                 [&](const parser::DatatypeDecl& d) { visit_datatype(id, d); },
                 [&](const parser::NametypeDecl& d) { then_expr(d.type); },
                 [&](const parser::AssertDecl& d) { visit_assertion(d.assertion); },
                 [](const parser::PrintDecl&) {},  // when it is printed (11.13)
                 [&](const parser::ModuleDecl&) {
                   for (const DeclId instance : instances_of[id.value]) {
                     tasks.push_back({K::end_copy});
                     visit_module(result.of_decl[instance.value]);
                     tasks.push_back({K::begin_copy});
                   }
                   visit_module(result.of_decl[id.value]);
                 },
                 [&](const parser::InstanceDecl& d) { then_all(K::expr, tree.list(d.arguments)); },
                 [&](const parser::TimedDecl& d) { visit_timed(id, d); },
                 [&](const parser::AnnotationDecl& d) { visit_type(d.type); },
                 [](const auto&) {},
             },
             tree.decls[id].node);
}

// What is no datatype's name is a type variable or a simple type, unless it is qualified (1.8).
void Resolver::Impl::visit_type(parser::TypeId root) {
  std::vector<parser::TypeId> stack{root};
  const auto push = [&](parser::TypeList list) {
    const auto types = tree.list(list);
    stack.insert(stack.end(), types.begin(), types.end());
  };
  const auto push_two = [&](parser::TypeId left, parser::TypeId right) {
    stack.insert(stack.end(), {left, right});
  };
  while (!stack.empty()) {
    const parser::TypeId id = stack.back();
    stack.pop_back();
    std::visit(overload{
                   [&](const parser::NamedType& t) {
                     const auto parts = tree.list(t.name);
                     if (parts.size() > 1) {
                       result.of_type[id.value] = lookup(t.name, tree.types[id].span);
                       return;
                     }
                     const SymbolId symbol = binding(parts[0]);
                     if (!symbol || result.symbols[symbol].kind != SymbolKind::datatype) return;
                     result.symbols[symbol].is_used = true;
                     result.of_type[id.value] = symbol;
                   },
                   [&](const parser::SetType& t) { stack.push_back(t.element); },
                   [&](const parser::SequenceType& t) { stack.push_back(t.element); },
                   [&](const parser::TupleType& t) { push(t.items); },
                   [&](const parser::MapType& t) { push_two(t.key, t.value); },
                   [&](const parser::DotType& t) { push_two(t.left, t.right); },
                   [&](const parser::YieldType& t) { push_two(t.argument, t.result); },
                   [&](const parser::ExtendableType& t) { push_two(t.argument, t.result); },
                   [&](const parser::FunctionType& t) {
                     push(t.arguments);
                     stack.push_back(t.result);
                   },
               },
               tree.types[id].node);
  }
}

void Resolver::Impl::visit_datatype(DeclId id, const parser::DatatypeDecl& d) {
  for (const parser::Constructor& c : tree.list(d.constructors)) {
    then_expr(c.type);
    if (!d.is_subtype) continue;
    const SymbolId symbol = binding(c.name.name);
    result.members[id.value].push_back(symbol);
    if (!symbol) {
      report_not_in_scope(c.name.name, c.name.span);
    } else if (result.symbols[symbol].kind != SymbolKind::constructor) {
      diagnostics->report(
          codes::not_in_scope, c.name.span,
          fmt::format("`{}` is not a constructor of a datatype", text(c.name.name)));
    }
  }
}

void Resolver::Impl::visit_assertion(const parser::Assertion& assertion) {
  then_expr(assertion.options.tau_priority);
  std::visit(overload{
                 [&](const parser::RefinementAssertion& a) {
                   then_expr(a.implementation);
                   then_expr(a.specification);
                 },
                 [&](const parser::PropertyAssertion& a) { then_expr(a.process); },
                 [&](const parser::HasTraceAssertion& a) {
                   then_all(Task::Kind::expr, tree.list(a.trace));
                   then_expr(a.process);
                 },
             },
             assertion.claim);
}

void Resolver::Impl::check_clauses(const parser::FunctionDecl& d) {
  const auto clauses = tree.list(d.clauses);
  const auto first = tree.list(clauses[0].group_sizes);
  for (const parser::Clause& clause : clauses.subspan(1)) {
    const auto sizes = tree.list(clause.group_sizes);
    if (std::equal(sizes.begin(), sizes.end(), first.begin(), first.end())) continue;
    auto& report = diagnostics->report(
        codes::clause_mismatch, clause.span,
        fmt::format("this clause of `{}` takes other arguments than the first", text(d.name.name)));
    report.notes.push_back({clauses[0].span, "the first clause is here"});
  }
}

// The time function is not inside the section that it belongs to.
void Resolver::Impl::visit_timed(DeclId id, const parser::TimedDecl& d) {
  using K = Task::Kind;
  const auto name = tree.names.find("tock");
  const SymbolId tock = name ? binding(*name) : SymbolId{};
  const auto* channel =
      tock ? std::get_if<parser::ChannelDecl>(&tree.decls[result.symbols[tock].decl].node)
           : nullptr;
  if (channel == nullptr || channel->type) {
    diagnostics->report(codes::bad_timed_section, tree.decls[id].span,
                        "a timed section needs the event `tock`: declare it with `channel tock`");
  }
  result.tocks[id.value] = tock;
  tasks.push_back({K::close_scope});
  then_all(K::bodies, tree.list(d.declarations));
  tasks.push_back({K::open_timed});
  then_expr(d.duration);
}

void Resolver::Impl::open_timed() {
  open_scope();
  for (const auto& [name, symbol] : importable) {
    if (info(result.symbols[symbol].builtin).import == Import::timed) bind(name, symbol);
  }
}

void Resolver::Impl::visit_clause(DeclId id, std::uint32_t index) {
  const auto& d = std::get<parser::FunctionDecl>(tree.decls[id].node);
  const parser::Clause& clause = tree.list(d.clauses)[index];
  tasks.push_back({Task::Kind::close_scope});
  then_expr(clause.body);
  then_all(Task::Kind::pattern, tree.list(clause.parameters));
  tasks.push_back({Task::Kind::open_scope});
}

}  // namespace perentie::semantics

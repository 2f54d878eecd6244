// The task loop of type inference, groups of declarations, and the public steps.
#include "inference.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "dependencies.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

using base::overload;
using NodeKind = SyntaxNode::Kind;

// --- Tasks --------------------------------------------------------------------------------------

void TypeChecker::Impl::make_room() {
  of_symbol.resize(resolution.symbols.size());
  of_expr.resize(tree.exprs.size());
  of_pattern.resize(tree.patterns.size());
  of_statement.resize(tree.statements.size());
  of_field.resize(tree.fields.size());
  draws_from_sequence.resize(tree.statements.size());
  is_part_of_dot.resize(tree.patterns.size());
}

void TypeChecker::Impl::run() {
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    switch (task.kind) {
      case Task::Kind::enter:
        enter(task.node);
        break;
      case Task::Kind::finish:
        finish(task.node);
        break;
      case Task::Kind::prefix_event:
        prefix_event(ExprId{task.node.id});
        break;
      case Task::Kind::clause_types:
        clause_types(task.node);
        break;
      case Task::Kind::open_group:
        open_groups.push_back(task.node.id);
        open_group(groups[task.node.id]);
        break;
      case Task::Kind::close_group:
        close_group(groups[task.node.id]);
        open_groups.pop_back();
        break;
    }
  }
}

void TypeChecker::Impl::push_children(SyntaxNode node) {
  std::vector<SyntaxNode> children;
  append_children(tree, node, children);
  for (auto child = children.rbegin(); child != children.rend(); ++child) {
    tasks.push_back({Task::Kind::enter, *child});
  }
}

void TypeChecker::Impl::enter(SyntaxNode node) {
  tasks.push_back({Task::Kind::finish, node});
  if (node.kind == NodeKind::clause) return enter_clause(node);
  if (node.kind == NodeKind::decl) {
    const auto defined = defined_symbols(tree, resolution, DeclId{node.id});
    TypeVariables variables;
    for (const SymbolId symbol : defined) {
      const auto found = variables_of.find(symbol.value);
      if (found != variables_of.end()) variables.insert(found->second.begin(), found->second.end());
    }
    type_scopes.push_back(std::move(variables));
  }
  if (node.kind == NodeKind::expr) {
    const ExprId id{node.id};
    if (const auto* let = std::get_if<parser::LetExpr>(&tree.exprs[id].node)) {
      return enter_let(id, *let);
    }
    if (const auto* prefix = std::get_if<parser::PrefixExpr>(&tree.exprs[id].node)) {
      return enter_prefix(id, *prefix);
    }
    mark_sequences(id);
  }
  if (node.kind == NodeKind::pattern) {
    const auto* dot = std::get_if<parser::DotPattern>(&tree.patterns[PatternId{node.id}].node);
    if (dot != nullptr) {
      is_part_of_dot[dot->left.value] = true;
      is_part_of_dot[dot->right.value] = true;
    }
  }
  push_children(node);
}

void TypeChecker::Impl::finish(SyntaxNode node) {
  switch (node.kind) {
    case NodeKind::expr:
      of_expr[node.id] = finish_expr(ExprId{node.id});
      break;
    case NodeKind::pattern:
      finish_pattern(PatternId{node.id});
      break;
    case NodeKind::statement:
      finish_statement(parser::StatementId{node.id});
      break;
    case NodeKind::field:
      finish_field(parser::FieldId{node.id});
      break;
    case NodeKind::decl:
      finish_decl(DeclId{node.id});
      type_scopes.pop_back();
      break;
    case NodeKind::clause:
      finish_clause(node);
      break;
  }
}

void TypeChecker::Impl::enter_let(ExprId, const parser::LetExpr& let) {
  tasks.push_back({Task::Kind::enter, {NodeKind::expr, let.body.value}});
  std::vector<Item> items;
  collect(let.declarations, 0, {}, items);
  schedule_groups(items, false);
}

// The fields get their types before the body uses them (3.1.7).
void TypeChecker::Impl::enter_prefix(ExprId id, const parser::PrefixExpr& prefix) {
  tasks.push_back({Task::Kind::enter, {NodeKind::expr, prefix.body.value}});
  tasks.push_back({Task::Kind::prefix_event, {NodeKind::expr, id.value}});
  const auto fields = tree.list(prefix.fields);
  for (auto field = fields.rbegin(); field != fields.rend(); ++field) {
    tasks.push_back({Task::Kind::enter, {NodeKind::field, field->value}});
  }
  tasks.push_back({Task::Kind::enter, {NodeKind::expr, prefix.channel.value}});
}

void TypeChecker::Impl::enter_clause(SyntaxNode node) {
  const auto& d = std::get<parser::FunctionDecl>(tree.decls[DeclId{node.id}].node);
  const parser::Clause& clause = tree.list(d.clauses)[node.index];
  tasks.push_back({Task::Kind::enter, {NodeKind::expr, clause.body.value}});
  tasks.push_back({Task::Kind::clause_types, node});
  const auto parameters = tree.list(clause.parameters);
  for (auto p = parameters.rbegin(); p != parameters.rend(); ++p) {
    tasks.push_back({Task::Kind::enter, {NodeKind::pattern, p->value}});
  }
}

// Generators draw from sets, but those of sequences, `;` and linked parallels from sequences (3.5).
void TypeChecker::Impl::mark_sequences(ExprId id) {
  const auto mark = [&](parser::StatementList statements) {
    for (const parser::StatementId s : tree.list(statements)) draws_from_sequence[s.value] = true;
  };
  std::visit(overload{
                 [&](const parser::CollectionExpr& e) {
                   if (e.kind == parser::Collection::sequence) mark(e.statements);
                 },
                 [&](const parser::RangeExpr& e) {
                   if (e.kind == parser::Collection::sequence) mark(e.statements);
                 },
                 [&](const parser::ReplicatedExpr& e) {
                   if (e.op == parser::ReplicatedOp::sequential) mark(e.statements);
                 },
                 [&](const parser::ReplicatedLinkExpr& e) { mark(e.statements); },
                 [](const auto&) {},
             },
             tree.exprs[id].node);
}

// --- Groups -------------------------------------------------------------------------------------

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

// --- Helpers ------------------------------------------------------------------------------------

TypeRef TypeChecker::Impl::mono(SymbolId symbol) {
  TypeRef& type = of_symbol[symbol.value].type;
  if (!type) type = types.variable();
  return type;
}

TypeRef TypeChecker::Impl::instance_of(SymbolId symbol, Span span) {
  if (!symbol) return types.any();
  mono(symbol);
  const Scheme& scheme = of_symbol[symbol.value];
  if (scheme.variables.empty()) return scheme.type;
  if (types.size() > max_types) {
    if (!std::exchange(is_exhausted, true)) {
      report(codes::type_too_deep, span, "the types of this script are too large");
    }
    return types.any();
  }
  const TypeRef instance = types.instantiate(scheme.type, scheme.variables);
  for (const TypeRef dot : types.dots_in(instance)) pending_dots.push_back({dot, span});
  return instance;
}

TypeRef TypeChecker::Impl::reduced(const PendingDot& pending) {
  const auto known = unifier.known(pending.dot);
  note_assumptions(pending.span);
  if (known) return *known;
  const TypeClash clash = unifier.clash();
  if (clash.right) {
    report_clash(clash.left, clash.right, pending.span);
  } else {
    report_clash(pending.dot, pending.dot, pending.span);
  }
  return types.any();
}

void TypeChecker::Impl::settle_pending_dots() {
  for (const PendingDot& pending : std::exchange(pending_dots, {})) {
    const TypeRef dot = reduced(pending);
    if (pending.is_pattern && types.kind(dot) == TypeKind::dot && !unifier.completed(dot)) {
      report_clash(dot, dot, pending.span);
    }
    reduced(pending);
  }
}

bool TypeChecker::Impl::expect(ExprId id, TypeRef expected) {
  return agree(expected, type(id), span(id));
}

bool TypeChecker::Impl::agree(TypeRef expected, TypeRef found, Span span) {
  const bool ok = unifier.unify(expected, found);
  note_assumptions(span);
  if (!ok) report_clash(expected, found, span);
  return ok;
}

bool TypeChecker::Impl::require(Constraint constraint, TypeRef type, Span span) {
  const bool ok = unifier.require(constraint, type);
  note_assumptions(span);
  if (!ok) report_clash(type, type, span);
  return ok;
}

void TypeChecker::Impl::note_assumptions(Span span) {
  for (const SymbolId datatype : unifier.take_eq_assumptions()) {
    eq_assumptions.push_back({datatype, span});
  }
}

std::string TypeChecker::Impl::text(TypeRef type, bool with_constraints) const {
  // Showing a type follows bindings, which shortens them, but changes no type.
  return show_type(const_cast<TypeStore&>(types), resolution, tree.names, type, with_constraints);
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

// The fields that `found` has to take to become what is expected; nothing if that does not help.
std::string TypeChecker::Impl::missing_fields(TypeRef found, TypeRef expected) {
  std::string fields;
  found = types.find(found);
  expected = types.find(expected);
  while (types.kind(found) == TypeKind::yield) {
    if (!fields.empty()) fields += " and the field ";
    fields += fmt::format("`{}`", text(types.child(found, 0)));
    found = types.find(types.child(found, 1));
  }
  const bool helps = types.kind(expected) == types.kind(found) &&
                     types[expected].datatype == types[found].datatype;
  return helps ? fields : "";
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
        diagnostic.notes.push_back({std::nullopt, fmt::format("the field {} is missing", missing)});
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

// --- The public steps ---------------------------------------------------------------------------

TypeChecker::TypeChecker(const parser::SyntaxTree& tree, const Resolution& resolution)
    : impl_(std::make_unique<Impl>(tree, resolution)) {}

TypeChecker::~TypeChecker() = default;

void TypeChecker::declare(parser::DeclList signatures, base::Diagnostics& diagnostics) {
  Impl& impl = *impl_;
  const parser::SyntaxTree& tree = impl.tree;
  const Resolution& resolution = impl.resolution;
  impl.diagnostics = &diagnostics;
  impl.make_room();
  std::unordered_map<std::string_view, SymbolId> builtins;
  for (std::uint32_t i = 0; i < resolution.symbols.size(); ++i) {
    const Symbol& symbol = resolution.symbols[SymbolId{i}];
    const bool is_builtin = symbol.kind == SymbolKind::builtin ||
                            (symbol.kind == SymbolKind::unsupported && !symbol.decl);
    if (is_builtin) builtins.emplace(tree.names[symbol.name], SymbolId{i});
  }
  for (const auto& [name, symbol] : resolution.prelude) builtins.insert_or_assign(name, symbol);
  for (const DeclId id : tree.list(signatures)) {
    const auto& d = std::get<parser::AnnotationDecl>(tree.decls[id].node);
    for (const parser::Identifier& name : tree.list(d.names)) {
      const auto found = builtins.find(tree.names[name.name]);
      if (found == builtins.end()) continue;
      Impl::TypeVariables variables;
      impl.of_symbol[found->second.value] = impl.annotated_type(d, variables);
    }
  }
}

void TypeChecker::check_declarations(parser::DeclList declarations,
                                     base::Diagnostics& diagnostics) {
  impl_->diagnostics = &diagnostics;
  impl_->make_room();
  std::vector<Impl::Item> items;
  impl_->collect(declarations, 0, {}, items);
  for (const Impl::Item& item : items) {
    const auto symbols = defined_symbols(impl_->tree, impl_->resolution, item.decl);
    impl_->top_level.insert(impl_->top_level.end(), symbols.begin(), symbols.end());
  }
  impl_->schedule_groups(items, true);
  impl_->run();
}

bool TypeChecker::check_expression(ExprId expr, base::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  impl_->diagnostics = &diagnostics;
  impl_->make_room();
  impl_->tasks.push_back({Impl::Task::Kind::enter, {NodeKind::expr, expr.value}});
  impl_->run();
  impl_->settle_pending_dots();
  return diagnostics.error_count() == errors;
}

bool TypeChecker::check_process(ExprId expr, base::Diagnostics& diagnostics) {
  return check_expression(expr, diagnostics) && impl_->expect(expr, impl_->types.process());
}

const std::vector<SymbolId>& TypeChecker::top_level() const { return impl_->top_level; }

std::string TypeChecker::show(ExprId expr) const { return impl_->text(impl_->type(expr), true); }

std::optional<std::string> TypeChecker::show(SymbolId symbol) const {
  if (symbol.value >= impl_->of_symbol.size()) return std::nullopt;
  const TypeRef type = impl_->of_symbol[symbol.value].type;
  if (!type) return std::nullopt;
  return impl_->text(type, true);
}

bool TypeChecker::is_process(SymbolId symbol) const {
  if (symbol.value >= impl_->of_symbol.size()) return false;
  TypeStore& types = impl_->types;
  TypeRef type = impl_->of_symbol[symbol.value].type;
  if (!type) return false;
  type = types.find(type);
  for (std::uint32_t i = 0; i < impl_->resolution.symbols[symbol].groups; ++i) {
    if (types.kind(type) != TypeKind::function) return false;
    type = types.find(types.children(type).back());
  }
  return types.kind(type) == TypeKind::process;
}

}  // namespace perentie::semantics

// The task loop of type inference, and what all its steps use.
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
      return enter_let(*let);
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

void TypeChecker::Impl::enter_let(const parser::LetExpr& let) {
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

}  // namespace perentie::semantics

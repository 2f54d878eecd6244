// The task loop of name resolution, and its public steps.
#include "resolver.hpp"

namespace perentie::semantics {

// Schedules tasks so that they run in the order written.
void Resolver::Impl::then(std::initializer_list<Task> sequence) {
  tasks.insert(tasks.end(), std::rbegin(sequence), std::rend(sequence));
}

void Resolver::Impl::then_expr(ExprId expr) {
  if (expr) tasks.push_back({Task::Kind::expr, expr.value});
}

void Resolver::Impl::run() {
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    switch (task.kind) {
      case Task::Kind::open_scope:
        open_scope();
        break;
      case Task::Kind::close_scope:
        close_scope();
        break;
      case Task::Kind::expr:
        visit_expr(ExprId{task.id});
        break;
      case Task::Kind::pattern:
        bind_pattern(PatternId{task.id});
        break;
      case Task::Kind::statement:
        visit_statement(StatementId{task.id});
        break;
      case Task::Kind::field:
        visit_field(parser::FieldId{task.id});
        break;
      case Task::Kind::declarations:
        visit_declarations({task.id, task.extra});
        break;
      case Task::Kind::bodies:
        visit_bodies(DeclId{task.id});
        break;
      case Task::Kind::clause:
        visit_clause(DeclId{task.id}, task.extra);
        break;
      case Task::Kind::open_module:
        open_module(SymbolId{task.id});
        break;
      case Task::Kind::close_module:
        close_module();
        break;
      case Task::Kind::open_timed:
        open_timed();
        break;
      case Task::Kind::begin_copy:
        begin_copy();
        break;
      case Task::Kind::end_copy:
        end_copy();
        break;
    }
  }
}

void Resolver::Impl::resolve(Task task, base::Diagnostics& sink) {
  diagnostics = &sink;
  make_room();
  tasks.push_back(task);
  run();
}

void Resolver::Impl::make_room() {
  result.of_expr.resize(tree.exprs.size());
  result.of_pattern.resize(tree.patterns.size());
  result.of_decl.resize(tree.decls.size());
  result.of_type.resize(tree.types.size());
}

Resolver::Resolver(parser::SyntaxTree& tree) : impl_(std::make_unique<Impl>(tree)) {}
Resolver::~Resolver() = default;

void Resolver::resolve_prelude(DeclList declarations, base::Diagnostics& diagnostics) {
  impl_->resolve({Task::Kind::declarations, declarations.first, declarations.count}, diagnostics);
  impl_->adopt_prelude();
}

void Resolver::resolve_script(DeclList declarations, base::Diagnostics& diagnostics) {
  impl_->open_scope();  // never closed: later expressions and scripts are resolved inside it
  impl_->resolve({Task::Kind::declarations, declarations.first, declarations.count}, diagnostics);
}

void Resolver::resolve_expression(ExprId expr, base::Diagnostics& diagnostics) {
  impl_->resolve({Task::Kind::expr, expr.value}, diagnostics);
}

const Resolution& Resolver::result() const { return impl_->result; }
Resolution& Resolver::result() { return impl_->result; }

}  // namespace perentie::semantics

// The working state of name resolution.
//
// Resolution walks the tree once with an explicit stack of tasks (chains of operators may be
// 100,000 long). Bindings are one table from names to symbols with an undo log per open scope.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "perentie/semantics/resolve.hpp"

namespace perentie::semantics {

using base::NameId;
using base::Span;
using parser::DeclId;
using parser::DeclList;
using parser::ExprId;
using parser::PatternId;
using parser::StatementId;

// One unit of work. A task may push further tasks, which run before those already waiting.
struct Task {
  enum class Kind : std::uint8_t {
    open_scope,
    close_scope,
    expr,
    pattern,  // bind the variables of a pattern in the innermost scope
    statement,
    field,
    declarations,  // declare and resolve a group of a `let`
    bodies,        // resolve the bodies of one declaration whose names are bound
    clause,
    open_module,
    close_module,
    open_timed,  // bind what only timed sections know
    begin_copy,  // resolve a copy of a module: its errors are those of the module
    end_copy,
  };
  Kind kind;
  std::uint32_t id = 0;
  std::uint32_t extra = 0;
};

struct Resolver::Impl {
  explicit Impl(parser::SyntaxTree& syntax_tree) : tree(syntax_tree) {
    declare_builtins(syntax_tree.names);
  }

  parser::SyntaxTree& tree;  // grows by the copies of modules that instances are
  Resolution result;
  base::Diagnostics* diagnostics = nullptr;
  // The errors in a copy of a module are dropped: they were found in the module itself.
  base::Diagnostics errors_in_copies;
  base::Diagnostics* sink_outside_copies = nullptr;
  std::uint32_t copies_open = 0;

  // The current meaning of each name, and what to restore when scopes close.
  struct Undo {
    NameId name;
    SymbolId previous;
  };
  std::vector<SymbolId> bindings;
  std::vector<Undo> undo_log;
  std::vector<std::size_t> scope_marks;
  std::unordered_map<NameId, SymbolId> importable;
  // By DeclId of a module: its instances. Their bodies are resolved where the module is defined.
  std::unordered_map<std::uint32_t, std::vector<DeclId>> instances_of;
  std::vector<DeclId> modules_in_declaration;  // the outermost first
  std::vector<SymbolId> open_modules;          // whose bodies are being resolved, likewise

  std::vector<Task> tasks;

  // --- Symbols and scopes ---------------------------------------------------------------------

  SymbolId binding(NameId name) const;
  void bind(NameId name, SymbolId symbol);
  void open_scope() { scope_marks.push_back(undo_log.size()); }

  void close_scope();

  // The symbol that the innermost scope itself gives to a name, if any.
  SymbolId bound_in_innermost_scope(NameId name) const;
  void declare_builtins(base::Interner& names);

  // The prelude's definitions become the built-ins that the table calls `prelude`; its auxiliary
  // functions go out of scope again.
  void adopt_prelude();
  std::string_view text(NameId name) const { return tree.names[name]; }

  // --- Tasks ----------------------------------------------------------------------------------

  // Schedules tasks so that they run in the order written.
  void then(std::initializer_list<Task> sequence);
  void then_expr(ExprId expr);
  template <class Ids>
  void then_all(Task::Kind kind, Ids ids) {
    for (auto id = ids.rbegin(); id != ids.rend(); ++id) tasks.push_back({kind, id->value});
  }

  void run();
  // The side tables get room for every node of the tree.
  void make_room();
  void resolve(Task task, base::Diagnostics& sink);

  // --- Look-up --------------------------------------------------------------------------------

  void report_not_in_scope(NameId name, Span span);
  static std::string import_hint(const Symbol& symbol);
  SymbolId lookup(parser::QualifiedName qualified, Span span);
  SymbolId lookup_member(SymbolId module, NameId member, Span span);

  // --- Expressions ----------------------------------------------------------------------------

  void visit_expr(ExprId id);
  void visit_three(ExprId a, ExprId b, ExprId c);

  // A scope in which first the statements run, then what `body` schedules.
  template <class Body>
  void scoped(parser::StatementList statements, Body body) {
    if (statements.empty()) return body();
    tasks.push_back({Task::Kind::close_scope});
    body();
    then_all(Task::Kind::statement, tree.list(statements));
    tasks.push_back({Task::Kind::open_scope});
  }

  void visit_ties(const parser::Ties& ties);
  void visit_name(ExprId id, const parser::NameExpr& e, Span span);
  void visit_statement(StatementId id);
  void visit_field(parser::FieldId id);

  // --- Patterns -------------------------------------------------------------------------------

  // Binds the variables of a pattern in the innermost scope.
  void bind_pattern(PatternId root);
  static bool is_atom(SymbolKind kind);
  void bind_name(PatternId id, const parser::NamePattern& p, Span span);

  // --- Declarations ---------------------------------------------------------------------------

  // Names that a group of declarations gives, before any body is resolved.
  struct Group {
    std::unordered_map<NameId, SymbolId> names;
    std::string prefix;             // "M::" inside module M
    const Group* parent = nullptr;  // of a module's members: the declarations around the module
    bool is_parameterised = false;  // inside a parameterised module
  };

  // What a name stands for where a group is declared, as far as it is declared by now.
  SymbolId declared(const Group& innermost, NameId name) const;
  SymbolId declare(Group& group, NameId name, Span span, SymbolKind kind, DeclId decl,
                   std::uint32_t index = 0);
  void declare_names(Group& group, DeclList list);
  void declare_types(Group& group, DeclId id);
  void declare_values(Group& group, DeclId id);
  void declare_import(Group& group, bool is_external, const parser::Identifier& name);
  void declare_pattern(Group& group, PatternId root, DeclId decl);
  bool names_atom(const Group& group, NameId name) const;
  void bind_all(const std::unordered_map<NameId, SymbolId>& names);
  void check_annotations(DeclList list, const Group& group);
  void visit_declarations(DeclList list);
  void visit_bodies(DeclId id);
  void visit_datatype(DeclId id, const parser::DatatypeDecl& d);
  void visit_assertion(const parser::Assertion& assertion);
  void visit_type(parser::TypeId id);
  void check_clauses(const parser::FunctionDecl& d);
  void visit_clause(DeclId id, std::uint32_t index);
  void visit_timed(DeclId id, const parser::TimedDecl& d);
  void open_timed();

  // --- Modules --------------------------------------------------------------------------------

  void declare_module(Group& group, const parser::ModuleDecl& d, DeclId id);

  // Declares the members of a module into `members`, which may have its parameters already.
  void declare_members(Group& members, SymbolId symbol, DeclId module);

  // An instance is a copy of its module, beside the definitions of the parameters.
  void declare_instance(Group& group, const parser::InstanceDecl& d, DeclId id);
  void begin_copy();
  void end_copy();

  // The module that an instance is to be made of; none if it cannot be, which is reported.
  SymbolId module_to_instantiate(const Group& group, const parser::InstanceDecl& d,
                                 SymbolId instance);
  void open_module(SymbolId module);
  void close_module();
  bool is_instance_of_open_module(SymbolId module) const;

  // The parameters' patterns bind nothing here, but may name constructors to match.
  void visit_module(SymbolId module);
};

}  // namespace perentie::semantics

// Name resolution walks the tree once with an explicit stack of tasks (chains of operators may be
// 100,000 long). Bindings are one table from names to symbols with an undo log per open scope.
#include "perentie/semantics/resolve.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include <fmt/format.h>

#include "pattern_names.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/base/text.hpp"
#include "perentie/parser/copy.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

using base::NameId;
using base::overload;
using base::Span;
using parser::DeclId;
using parser::DeclList;
using parser::ExprId;
using parser::PatternId;
using parser::StatementId;

namespace {

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
    begin_copy,  // resolve a copy of a module: its errors are those of the module
    end_copy,
  };
  Kind kind;
  std::uint32_t id = 0;
  std::uint32_t extra = 0;
};

}  // namespace

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

  std::vector<Task> tasks;

  // --- Symbols and scopes ---------------------------------------------------------------------

  SymbolId binding(NameId name) const {
    return name.value < bindings.size() ? bindings[name.value] : SymbolId{};
  }

  void bind(NameId name, SymbolId symbol) {
    if (name.value >= bindings.size()) bindings.resize(tree.names.size());
    undo_log.push_back({name, bindings[name.value]});
    bindings[name.value] = symbol;
  }

  void open_scope() { scope_marks.push_back(undo_log.size()); }

  void close_scope() {
    for (; undo_log.size() > scope_marks.back(); undo_log.pop_back()) {
      bindings[undo_log.back().name.value] = undo_log.back().previous;
    }
    scope_marks.pop_back();
  }

  // The symbol that the innermost scope itself gives to a name, if any.
  SymbolId bound_in_innermost_scope(NameId name) const {
    const std::size_t mark = scope_marks.empty() ? 0 : scope_marks.back();
    for (std::size_t i = undo_log.size(); i > mark; --i) {
      if (undo_log[i - 1].name == name) return binding(name);
    }
    return {};
  }

  void declare_builtins(base::Interner& names) {
    for (std::size_t i = 0; i < builtin_table.size(); ++i) {
      const BuiltinInfo& builtin = builtin_table[i];
      if (builtin.kind == BuiltinKind::prelude) continue;
      const NameId name = names.intern(builtin.name);
      Symbol symbol{.kind = SymbolKind::builtin,
                    .name = name,
                    .qualified = std::string(builtin.name),
                    .span = std::nullopt,
                    .builtin = static_cast<Builtin>(i)};
      if (builtin.kind == BuiltinKind::unsupported) {
        symbol.kind = SymbolKind::unsupported;
        symbol.unsupported_construct = builtin.name;
      }
      symbol.groups = builtin.arguments.empty() ? 0 : 1;
      symbol.is_process = builtin.kind == BuiltinKind::process_constant ||
                          builtin.kind == BuiltinKind::process_function;
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
  void adopt_prelude() {
    for (const Undo& entry : std::vector<Undo>(undo_log)) {
      const SymbolId symbol = binding(entry.name);
      if (!symbol || result.symbols[symbol].kind != SymbolKind::function) continue;
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

  std::string_view text(NameId name) const { return tree.names[name]; }

  // --- Tasks ----------------------------------------------------------------------------------

  // Schedules tasks so that they run in the order written.
  void then(std::initializer_list<Task> sequence) {
    tasks.insert(tasks.end(), std::rbegin(sequence), std::rend(sequence));
  }
  void then_expr(ExprId expr) {
    if (expr) tasks.push_back({Task::Kind::expr, expr.value});
  }
  template <class Ids>
  void then_all(Task::Kind kind, Ids ids) {
    for (auto id = ids.rbegin(); id != ids.rend(); ++id) tasks.push_back({kind, id->value});
  }

  void run() {
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
        case Task::Kind::begin_copy:
          begin_copy();
          break;
        case Task::Kind::end_copy:
          end_copy();
          break;
      }
    }
  }

  // --- Look-up --------------------------------------------------------------------------------

  void report_not_in_scope(NameId name, Span span) {
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

  static std::string import_hint(const Symbol& symbol) {
    const Import import = info(symbol.builtin).import;
    return fmt::format("`{0}` is built in: bring it into scope with `{1} {0}`", symbol.qualified,
                       import == Import::transparent ? "transparent" : "external");
  }

  SymbolId lookup(parser::QualifiedName qualified, Span span) {
    const auto parts = tree.list(qualified);
    const SymbolId first = binding(parts[0]);
    if (!first) {
      report_not_in_scope(parts[0], span);
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

  SymbolId lookup_member(SymbolId module, NameId member, Span span) {
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

  // --- Expressions ----------------------------------------------------------------------------

  void visit_expr(ExprId id) {
    using K = Task::Kind;
    const parser::Expr& expr = tree.exprs[id];
    std::visit(
        overload{
            [&](const parser::NameExpr& e) { visit_name(id, e, expr.span); },
            [&](const parser::TupleExpr& e) { then_all(K::expr, tree.list(e.items)); },
            [&](const parser::MapExpr& e) {
              then_all(K::expr, tree.list(e.values));
              then_all(K::expr, tree.list(e.keys));
            },
            [&](const parser::CollectionExpr& e) {
              scoped(e.statements, [&] { then_all(K::expr, tree.list(e.items)); });
            },
            [&](const parser::RangeExpr& e) {
              scoped(e.statements, [&] {
                then_expr(e.last);
                then_expr(e.first);
              });
            },
            [&](const parser::ApplyExpr& e) {
              then_all(K::expr, tree.list(e.arguments));
              then_expr(e.function);
            },
            [&](const parser::LambdaExpr& e) {
              tasks.push_back({K::close_scope});
              then_expr(e.body);
              then_all(K::pattern, tree.list(e.parameters));
              tasks.push_back({K::open_scope});
            },
            [&](const parser::LetExpr& e) {
              then({{K::open_scope},
                    {K::declarations, e.declarations.first, e.declarations.count},
                    {K::expr, e.body.value},
                    {K::close_scope}});
            },
            [&](const parser::IfExpr& e) {
              then_expr(e.else_branch);
              then_expr(e.then_branch);
              then_expr(e.condition);
            },
            [&](const parser::NegateExpr& e) { then_expr(e.operand); },
            [&](const parser::NotExpr& e) { then_expr(e.operand); },
            [&](const parser::LengthExpr& e) { then_expr(e.operand); },
            [&](const parser::InfixExpr& e) {
              then_expr(e.right);
              then_expr(e.left);
            },
            [&](const parser::PrefixExpr& e) {
              if (e.fields.empty()) {
                then_expr(e.body);
              } else {
                tasks.push_back({K::close_scope});
                then_expr(e.body);
                then_all(K::field, tree.list(e.fields));
                tasks.push_back({K::open_scope});
              }
              then_expr(e.channel);
            },
            [&](const parser::ParallelExpr& e) { visit_three(e.left, e.alphabet, e.right); },
            [&](const parser::ExceptionExpr& e) { visit_three(e.left, e.alphabet, e.right); },
            [&](const parser::SyncChoiceExpr& e) { visit_three(e.left, e.alphabet, e.right); },
            [&](const parser::SyncInterruptExpr& e) { visit_three(e.left, e.alphabet, e.right); },
            [&](const parser::AlphabetParallelExpr& e) {
              then_expr(e.right);
              visit_three(e.left, e.left_alphabet, e.right_alphabet);
            },
            [&](const parser::LinkParallelExpr& e) {
              visit_ties(e.links);
              then_expr(e.right);
              then_expr(e.left);
            },
            [&](const parser::RenameExpr& e) {
              visit_ties(e.pairs);
              then_expr(e.process);
            },
            [&](const parser::ReplicatedExpr& e) {
              // The alphabet of `|| s @ [A] P` sees the bound variables, the others do not (4.4.3).
              const bool inside = e.op == parser::ReplicatedOp::alphabet_parallel;
              scoped(e.statements, [&] {
                then_expr(e.body);
                if (inside) then_expr(e.alphabet);
              });
              if (!inside) then_expr(e.alphabet);
            },
            [&](const parser::ReplicatedLinkExpr& e) {
              scoped(e.statements, [&] {
                then_expr(e.body);
                visit_ties(e.links);
              });
            },
            [](const auto&) {},  // literals, and what only erroneous trees contain
        },
        expr.node);
  }

  void visit_three(ExprId a, ExprId b, ExprId c) {
    then_expr(c);
    then_expr(b);
    then_expr(a);
  }

  // A scope in which first the statements run, then what `body` schedules.
  template <class Body>
  void scoped(parser::StatementList statements, Body body) {
    if (statements.empty()) return body();
    tasks.push_back({Task::Kind::close_scope});
    body();
    then_all(Task::Kind::statement, tree.list(statements));
    tasks.push_back({Task::Kind::open_scope});
  }

  void visit_ties(const parser::Ties& ties) {
    scoped(ties.statements, [&] {
      then_all(Task::Kind::expr, tree.list(ties.to));
      then_all(Task::Kind::expr, tree.list(ties.from));
    });
  }

  void visit_name(ExprId id, const parser::NameExpr& e, Span span) {
    const SymbolId symbol = lookup(e.name, span);
    if (symbol && result.symbols[symbol].kind == SymbolKind::module) {
      diagnostics->report(
          codes::module_as_value, span,
          fmt::format("the module `{}` is not a value", result.symbols[symbol].qualified));
      return;
    }
    result.of_expr[id.value] = symbol;
  }

  void visit_statement(StatementId id) {
    std::visit(
        overload{
            [&](const parser::Generator& s) {
              then({{Task::Kind::expr, s.source.value}, {Task::Kind::pattern, s.pattern.value}});
            },
            [&](const parser::Filter& s) { then_expr(s.condition); }},
        tree.statements[id].node);
  }

  void visit_field(parser::FieldId id) {
    const parser::Field& field = tree.fields[id];
    if (field.pattern) tasks.push_back({Task::Kind::pattern, field.pattern.value});
    then_expr(field.expression);
  }

  // --- Patterns -------------------------------------------------------------------------------

  // Binds the variables of a pattern in the innermost scope.
  void bind_pattern(PatternId root) {
    for_each_name(tree, root, [this](PatternId id, const parser::NamePattern& name) {
      bind_name(id, name, tree.patterns[id].span);
    });
  }

  static bool is_atom(SymbolKind kind) {
    return kind == SymbolKind::channel || kind == SymbolKind::constructor;
  }

  void bind_name(PatternId id, const parser::NamePattern& p, Span span) {
    if (result.of_pattern[id.value]) return;  // a declared constant: bound with its group
    const auto parts = tree.list(p.name);
    if (parts.size() > 1) {
      const SymbolId symbol = lookup(p.name, span);
      if (symbol && !is_atom(result.symbols[symbol].kind) &&
          result.symbols[symbol].kind != SymbolKind::unsupported) {
        diagnostics->report(codes::qualified_binding, span,
                            fmt::format("`{}` is no channel or constructor, and a qualified name "
                                        "cannot be bound by a pattern",
                                        result.symbols[symbol].qualified));
      }
      result.of_pattern[id.value] = symbol;
      return;
    }
    const SymbolId existing = binding(parts[0]);
    if (existing && is_atom(result.symbols[existing].kind)) {
      result.symbols[existing].is_used = true;
      result.of_pattern[id.value] = existing;
      return;
    }
    if (const SymbolId twice = bound_in_innermost_scope(parts[0])) {
      auto& report = diagnostics->report(
          codes::variable_bound_twice, span,
          fmt::format("`{}` is bound more than once by the same patterns", text(parts[0])));
      report.notes.push_back({result.symbols[twice].span, "it is bound here first"});
      return;
    }
    const SymbolId symbol = result.symbols.add(Symbol{.kind = SymbolKind::variable,
                                                      .name = parts[0],
                                                      .qualified = std::string(text(parts[0])),
                                                      .span = span});
    bind(parts[0], symbol);
    result.of_pattern[id.value] = symbol;
  }

  // --- Declarations ---------------------------------------------------------------------------

  // Names that a group of declarations gives, before any body is resolved.
  struct Group {
    std::unordered_map<NameId, SymbolId> names;
    std::string prefix;             // "M::" inside module M
    const Group* parent = nullptr;  // of a module's members: the declarations around the module
    bool is_parameterised = false;  // inside a parameterised module
  };

  // What a name stands for where a group is declared, as far as it is declared by now.
  SymbolId declared(const Group& innermost, NameId name) const {
    for (const Group* group = &innermost; group != nullptr; group = group->parent) {
      if (const auto found = group->names.find(name); found != group->names.end()) {
        return found->second;
      }
    }
    return binding(name);
  }

  SymbolId declare(Group& group, NameId name, Span span, SymbolKind kind, DeclId decl,
                   std::uint32_t index = 0) {
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

  void declare_names(Group& group, DeclList list) {
    // Channels and constructors first: a pattern that names one binds nothing (1.9.2).
    // The tree grows with each instance, which moves its lists.
    const std::vector<DeclId> ids(tree.list(list).begin(), tree.list(list).end());
    for (const DeclId id : ids) declare_types(group, id);
    for (const DeclId id : ids) declare_values(group, id);
  }

  void declare_types(Group& group, DeclId id) {
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

  void declare_values(Group& group, DeclId id) {
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
                   [&](const parser::TimedDecl& d) {
                     Group timed{.names = {}, .prefix = group.prefix, .parent = &group};
                     declare_names(timed, d.declarations);
                     for (const auto& [name, symbol] : timed.names) {
                       if (result.symbols[symbol].kind != SymbolKind::channel) {
                         result.symbols[symbol].kind = SymbolKind::unsupported;
                         result.symbols[symbol].unsupported_construct = "timed sections";
                       }
                       group.names.emplace(name, symbol);
                     }
                   },
                   [](const auto&) {},
               },
               decl.node);
  }

  void declare_import(Group& group, bool is_external, const parser::Identifier& name) {
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

  void declare_pattern(Group& group, PatternId root, DeclId decl) {
    for_each_name(tree, root, [&](PatternId id, const parser::NamePattern& p) {
      const auto parts = tree.list(p.name);
      if (parts.size() > 1) return;
      // `A = 3` defines A; inside a larger pattern, a known constructor only matches.
      if (id != root && names_atom(group, parts[0])) return;
      result.of_pattern[id.value] =
          declare(group, parts[0], tree.patterns[id].span, SymbolKind::constant, decl);
    });
  }

  bool names_atom(const Group& group, NameId name) const {
    const SymbolId symbol = declared(group, name);
    return symbol && is_atom(result.symbols[symbol].kind);
  }

  // --- Modules --------------------------------------------------------------------------------

  void declare_module(Group& group, const parser::ModuleDecl& d, DeclId id) {
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
  void declare_members(Group& members, SymbolId symbol, DeclId module) {
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
  void declare_instance(Group& group, const parser::InstanceDecl& d, DeclId id) {
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

  void begin_copy() {
    if (copies_open++ == 0) sink_outside_copies = std::exchange(diagnostics, &errors_in_copies);
  }
  void end_copy() {
    if (--copies_open == 0) diagnostics = sink_outside_copies;
  }

  // The module that an instance is to be made of; none if it cannot be, which is reported.
  SymbolId module_to_instantiate(const Group& group, const parser::InstanceDecl& d,
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

  void bind_all(const std::unordered_map<NameId, SymbolId>& names) {
    for (const auto& [name, symbol] : names) bind(name, symbol);
  }

  void check_annotations(DeclList list, const Group& group) {
    std::unordered_map<NameId, Span> annotated;
    for (const DeclId id : tree.list(list)) {
      const auto* d = std::get_if<parser::AnnotationDecl>(&tree.decls[id].node);
      if (d == nullptr) continue;
      for (const parser::Identifier& name : tree.list(d->names)) {
        if (!group.names.contains(name.name)) {
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

  void visit_declarations(DeclList list) {
    Group group;
    declare_names(group, list);
    check_annotations(list, group);
    bind_all(group.names);
    then_all(Task::Kind::bodies, tree.list(list));
  }

  void open_module(SymbolId module) {
    open_scope();
    const ModuleMembers members = result.modules.at(module.value);
    bind_all(members.private_);
    bind_all(members.exported);
  }

  void visit_bodies(DeclId id) {
    using K = Task::Kind;
    std::visit(
        overload{
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
            [&](const parser::PrintDecl& d) { then_expr(d.expression); },
            [&](const parser::ModuleDecl&) {
              for (const DeclId instance : instances_of[id.value]) {
                tasks.push_back({K::end_copy});
                visit_module(result.of_decl[instance.value]);
                tasks.push_back({K::begin_copy});
              }
              visit_module(result.of_decl[id.value]);
            },
            [&](const parser::InstanceDecl& d) { then_all(K::expr, tree.list(d.arguments)); },
            [](const auto&) {},
        },
        tree.decls[id].node);
  }

  // The parameters' patterns bind nothing here, but may name constructors to match.
  void visit_module(SymbolId module) {
    using K = Task::Kind;
    const auto& d =
        std::get<parser::ModuleDecl>(tree.decls[result.modules.at(module.value).decl].node);
    tasks.push_back({K::close_scope});
    then_all(K::bodies, tree.list(d.exported_declarations));
    then_all(K::bodies, tree.list(d.private_declarations));
    then_all(K::pattern, tree.list(d.parameters));
    tasks.push_back({K::open_module, module.value});
  }

  void visit_datatype(DeclId id, const parser::DatatypeDecl& d) {
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

  void visit_assertion(const parser::Assertion& assertion) {
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

  void check_clauses(const parser::FunctionDecl& d) {
    const auto clauses = tree.list(d.clauses);
    const auto first = tree.list(clauses[0].group_sizes);
    for (const parser::Clause& clause : clauses.subspan(1)) {
      const auto sizes = tree.list(clause.group_sizes);
      if (std::equal(sizes.begin(), sizes.end(), first.begin(), first.end())) continue;
      auto& report = diagnostics->report(
          codes::clause_mismatch, clause.span,
          fmt::format("this clause of `{}` takes other arguments than the first",
                      text(d.name.name)));
      report.notes.push_back({clauses[0].span, "the first clause is here"});
    }
  }

  void visit_clause(DeclId id, std::uint32_t index) {
    const auto& d = std::get<parser::FunctionDecl>(tree.decls[id].node);
    const parser::Clause& clause = tree.list(d.clauses)[index];
    tasks.push_back({Task::Kind::close_scope});
    then_expr(clause.body);
    then_all(Task::Kind::pattern, tree.list(clause.parameters));
    tasks.push_back({Task::Kind::open_scope});
  }

  void make_room() {
    result.of_expr.resize(tree.exprs.size());
    result.of_pattern.resize(tree.patterns.size());
    result.of_decl.resize(tree.decls.size());
  }

  void resolve(Task task, base::Diagnostics& sink) {
    diagnostics = &sink;
    make_room();
    tasks.push_back(task);
    run();
  }
};

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

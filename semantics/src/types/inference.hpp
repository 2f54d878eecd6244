// The working state of type inference.
//
// The tree is walked with an explicit stack of tasks (chains of operators may be 100,000 long): a
// node is entered, which schedules its children, and finished when they have their types.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "../syntax_children.hpp"
#include "perentie/base/diagnostic.hpp"
#include "perentie/semantics/types.hpp"
#include "type_store.hpp"
#include "unify.hpp"

namespace perentie::semantics {

using base::Span;
using parser::DeclId;
using parser::ExprId;
using parser::PatternId;

struct TypeChecker::Impl {
  Impl(const parser::SyntaxTree& syntax_tree, const Resolution& names)
      : tree(syntax_tree), resolution(names), unifier(types, names) {}

  const parser::SyntaxTree& tree;
  const Resolution& resolution;
  TypeStore types;
  Unifier unifier;
  base::Diagnostics* diagnostics = nullptr;

  // A type, and the variables in it that stand for any type.
  struct Scheme {
    TypeRef type = {};
    std::vector<TypeRef> variables = {};
  };
  std::vector<Scheme> of_symbol;          // by SymbolId
  std::vector<TypeRef> of_expr;           // by ExprId
  std::vector<TypeRef> of_pattern;        // by PatternId
  std::vector<TypeRef> of_statement;      // by StatementId, of a generator: of the elements
  std::vector<TypeRef> of_field;          // by FieldId
  std::vector<bool> draws_from_sequence;  // by StatementId: of a generator that needs a sequence

  std::vector<bool> is_part_of_dot;  // by PatternId: of a dot inside a dot

  // Types can double with every definition, as `f(x) = (g(x), g(x))` does.
  static constexpr std::size_t max_types = 8'000'000;
  bool is_exhausted = false;  // it was reported

  // One declaration of a script, wherever it stands.
  struct Item {
    DeclId decl;
    std::uint32_t module = 0;  // index into `modules`
    DeclId instance = {};      // whose copy of a module it is in
  };
  // The parameters of the modules around a declaration: their types are the same for all members.
  std::vector<std::vector<SymbolId>> modules{{}};

  // Declarations that refer to each other.
  struct Group {
    std::vector<Item> items;
    bool is_top = false;
    std::size_t errors_before = 0;
  };
  std::vector<Group> groups;
  std::vector<std::uint32_t> open_groups;

  std::vector<SymbolId> top_level;  // what is defined there, in order

  // The fields of the constructors of a datatype.
  std::unordered_map<std::uint32_t, std::vector<TypeRef>> fields_of;  // by SymbolId of the datatype
  // What was compared while it was not known whether that is possible.
  struct EqAssumption {
    SymbolId datatype;
    Span span;
  };
  std::vector<EqAssumption> eq_assumptions;

  // Dots that wait for a field: what they get may not fit, though nothing else asks.
  struct PendingDot {
    TypeRef dot;
    Span span;
    bool is_pattern = false;  // then it is complete in the end: the last variable takes the rest
  };
  std::vector<PendingDot> pending_dots;

  // The type variables of the annotations around a place, the innermost last.
  using TypeVariables = std::unordered_map<base::NameId, TypeRef>;
  std::vector<TypeVariables> type_scopes;
  std::unordered_map<std::uint32_t, TypeVariables>
      variables_of;  // by SymbolId of what is annotated

  std::vector<TypeRef> results;  // of the functions whose clauses are in work, the innermost last

  struct Task {
    enum class Kind : std::uint8_t {
      enter,         // schedule the children of a node and its end
      finish,        // give it a type
      prefix_event,  // channel and fields of a prefix are an event
      clause_types,  // the parameters of a clause are those of its function
      open_group,
      close_group,
    };
    Kind kind;
    SyntaxNode node;  // of a group: its number is `id`
  };
  std::vector<Task> tasks;

  // --- Tasks and groups (inference.cpp) ---------------------------------------------------------

  void make_room();
  void run();
  void enter(SyntaxNode node);
  void finish(SyntaxNode node);
  void push_children(SyntaxNode node);
  void enter_let(const parser::LetExpr& let);
  void enter_prefix(ExprId id, const parser::PrefixExpr& prefix);
  void enter_clause(SyntaxNode node);
  void mark_sequences(ExprId id);
  void collect(parser::DeclList list, std::uint32_t module, DeclId instance,
               std::vector<Item>& items);
  void collect_module(const parser::ModuleDecl& module, std::uint32_t around, DeclId instance,
                      std::vector<Item>& items);
  void schedule_groups(const std::vector<Item>& items, bool is_top);
  void open_group(Group& group);
  void close_group(Group& group);
  void decide_equality(const Group& group);
  void generalise(const Item& item);
  void check_no_escape(const Item& item);
  bool is_in_scope(TypeRef variable) const;
  void check_no_polymorphism(const Item& item);

  // --- Nodes ------------------------------------------------------------------------------------

  void finish_pattern(PatternId id);                               // patterns.cpp
  void finish_statement(parser::StatementId id);                   // patterns.cpp
  void finish_field(parser::FieldId id);                           // patterns.cpp
  TypeRef pattern_name(PatternId id);                              // patterns.cpp
  TypeRef finish_expr(ExprId id);                                  // expressions.cpp
  TypeRef infix(ExprId id, const parser::InfixExpr& e);            // expressions.cpp
  TypeRef apply(ExprId id, const parser::ApplyExpr& e);            // expressions.cpp
  TypeRef collection(ExprId id, const parser::CollectionExpr& e);  // expressions.cpp
  TypeRef dotted(const PendingDot& pending);                       // expressions.cpp
  void ties(const parser::Ties& ties);                             // expressions.cpp
  void prefix_event(ExprId id);                                    // expressions.cpp
  void finish_decl(DeclId id);                                     // declarations.cpp
  void channel(DeclId id, const parser::ChannelDecl& d);
  void datatype(DeclId id, const parser::DatatypeDecl& d);
  void subtype(DeclId id, const parser::DatatypeDecl& d);
  void assertion(const parser::Assertion& assertion);
  void clause_types(SyntaxNode clause);
  void finish_clause(SyntaxNode clause);
  TypeRef values_of(ExprId type_expression);
  TypeRef elements_of(TypeRef set, Span span);
  void give(SymbolId symbol, TypeRef type, Span span);

  // --- Annotations (annotations.cpp) ------------------------------------------------------------

  // The annotated type of a symbol, if it has one.
  std::optional<Scheme> annotation(SymbolId symbol);
  Scheme annotated_type(const parser::AnnotationDecl& d, TypeVariables& variables);
  TypeRef type_of(parser::TypeId id, TypeVariables& variables, std::vector<TypeRef>& introduced);
  TypeRef named_type(parser::TypeId id, const parser::NamedType& name, TypeVariables& variables,
                     std::vector<TypeRef>& introduced);
  TypeRef type_variable(base::NameId name, TypeVariables& variables,
                        std::vector<TypeRef>& introduced);

  // --- Helpers ----------------------------------------------------------------------------------

  TypeRef instance_of(SymbolId symbol, Span span);
  TypeRef mono(SymbolId symbol);  // of a variable: made when it is first seen
  TypeRef type(ExprId id) const { return of_expr[id.value]; }
  Span span(ExprId id) const { return tree.exprs[id].span; }
  // Reports unless the expression has the type.
  bool expect(ExprId id, TypeRef expected);
  // The reduced type of a dot; an error is reported, and then it agrees with everything.
  TypeRef reduced(const PendingDot& pending);
  void settle_pending_dots();
  bool agree(TypeRef expected, TypeRef found, Span span);
  bool require(Constraint constraint, TypeRef type, Span span);
  void note_assumptions(Span span);
  std::string missing_fields(TypeRef found, TypeRef expected);
  void report_clash(TypeRef expected, TypeRef found, Span span);
  base::Diagnostic& report(const base::DiagnosticCode& code, Span span, std::string message);
  std::string text(TypeRef type, bool with_constraints = false);
};

}  // namespace perentie::semantics

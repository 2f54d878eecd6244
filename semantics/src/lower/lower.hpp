// Step 5: from the resolved tree to core code.
//
// Every definition, thunk and function body becomes a block. Blocks that an expression needs are
// queued and emitted after it, so lowering recurses only as deep as the source nests, and long
// chains of operators not at all.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "../evaluate/code.hpp"
#include "perentie/base/diagnostic.hpp"
#include "perentie/parser/ast.hpp"
#include "perentie/semantics/symbols.hpp"
#include "perentie/semantics/value.hpp"

namespace perentie::semantics {

/// The functions of the prelude that stand behind operators and instructions.
struct PreludeFunctions {
  SymbolId append, length, from, from_to, equal_sequences;
  SymbolId timed_stop, timed_skip, wait, timed_priority;
};

class Lowering {
 public:
  Lowering(const parser::SyntaxTree& tree, const Resolution& resolution,
           const PreludeFunctions& prelude, ValueStore& values, Program& program,
           base::Diagnostics& diagnostics);

  /// Gives every definition of a script a global slot and its block.
  void declarations(parser::DeclList list);
  /// A block that leaves the value of an expression, completely evaluated.
  Address expression(parser::ExprId expr);
  /// A block that leaves the process that an expression stands for.
  /// In an assertion inside a timed section, STOP, SKIP, WAIT and timed_priority are those of the
  /// section, the operators are the untimed ones (2.10.9).
  Address process_expression(parser::ExprId expr, parser::DeclId timed_section = {});
  /// The global slot of a constant, function, datatype or nametype.
  std::uint32_t global_slot(SymbolId symbol) const;

 private:
  // Where the value of a symbol is found at run time.
  enum class Place : std::uint8_t { nowhere, global, local, process_constant };
  struct Location {
    Place place = Place::nowhere;
    std::uint32_t depth = 0;  // of the static scope that holds it; 0 is outside all
    std::uint32_t slot = 0;   // or the FunctionId of a process constant
  };
  // Static scopes are a tree, so that a queued block can return to where it was found.
  using ScopeIndex = std::uint32_t;
  static constexpr ScopeIndex no_scope = 0xFFFF'FFFFU;
  struct StaticScope {
    ScopeId scope;
    ScopeIndex parent;
    std::uint32_t depth;
  };
  struct Label {
    std::vector<Address> uses;
  };
  // A timed section: its time event, and where its time function is, if it has one. Assertions in
  // it have its constants only.
  struct TimedSection {
    SymbolId tock;
    Location duration;
    bool has_timed_operators = true;
  };
  using TimedIndex = std::uint32_t;
  static constexpr TimedIndex not_timed = 0xFFFF'FFFFU;
  // A block still to be emitted, in the surroundings where it was found.
  struct Pending {
    ScopeIndex scope;
    TimedIndex timed;
    SymbolId owner;
    std::function<void(Address entry)> emit;
  };
  enum class Tail : bool { no, yes };

  // Emission
  Address here() const { return static_cast<Address>(program_.code.size()); }
  Address emit(Op op, std::uint32_t b = 0, std::size_t a = 0);
  void emit_value(ValueId value) { emit(Op::push_value, value.bits); }
  void emit_jump(Op op, Label& label, std::size_t a = 0);
  void place(const Label& label);
  void finish(Tail tail) {
    if (tail == Tail::yes) emit(Op::ret);
  }
  void queue(std::function<void(Address)> emit_block) {
    pending_.push_back({scope_, timed_, owner_, std::move(emit_block)});
  }
  void emit_pending();

  // Scopes and variables
  std::uint32_t depth() const { return scope_ == no_scope ? 0 : static_scopes_[scope_].depth; }
  ScopeId current_scope() const { return static_scopes_[scope_].scope; }
  void enter_static(ScopeId scope);
  ScopeId open_scope(ScopeKind kind);
  void close_scope() { scope_ = static_scopes_[scope_].parent; }
  std::uint32_t add_slot();
  std::uint32_t add_variable(SymbolId symbol);
  void set_location(SymbolId symbol, Location location);
  void load_symbol(SymbolId symbol);

  // Declarations
  std::uint32_t new_global(GlobalInit init);
  void global_thunk(SymbolId symbol, std::function<void()> emit_value);
  void declare_global(parser::DeclId id);
  void declare_members(const parser::ModuleDecl& module);
  void declare_global_pattern(const parser::PatternDecl& decl);
  void pattern_variable(parser::PatternId pattern, SymbolId variable,
                        const std::function<void()>& load_source);
  void let_scope(const parser::LetExpr& let);
  void let_member(parser::DeclId id);
  void let_thunk(std::uint32_t slot, std::function<void()> emit_value);
  FunctionId add_function(SymbolId symbol, parser::DeclId decl);
  FunctionId add_process_constant(SymbolId symbol, parser::ExprId value);
  void function_block(FunctionId function, const parser::FunctionDecl& decl);
  void clause(FunctionId function, const parser::Clause& clause);
  void field_types(SymbolId symbol, parser::ExprId type);
  void type_set(parser::ExprId type);
  void subtype_set(parser::DeclId id);
  /// The one symbol that a declared pattern binds, if it is a single name.
  SymbolId single_name(parser::PatternId pattern) const;
  std::vector<SymbolId> declared_variables(parser::PatternId pattern) const;

  // Expressions. The code leaves on the stack what is evaluated to weak head normal form (value),
  // possibly not at all (lazy), completely (canonical), or is a process (process).
  enum class Leaves : std::uint8_t { unknown, value, process };
  Leaves leaves(parser::ExprId expr) const;
  void value(parser::ExprId expr, Tail tail = Tail::no);
  void lazy(parser::ExprId expr);
  void canonical(parser::ExprId expr);
  void process(parser::ExprId expr, Tail tail = Tail::no);
  void thunk(parser::ExprId expr);
  void name(SymbolId symbol);
  void infix_chain(parser::ExprId expr);
  void infix_left(parser::InfixOp op, parser::ExprId left);
  void infix_right(const parser::InfixExpr& infix);
  const parser::CollectionExpr* literal_sequence(const parser::InfixExpr& infix) const;
  std::vector<parser::ExprId> right_spine(parser::ExprId expr, parser::InfixOp op) const;
  void guard(parser::ExprId expr);
  void apply(parser::ExprId expr);
  bool apply_builtin(SymbolId symbol, std::span<const parser::ExprId> arguments);
  void collection(const parser::CollectionExpr& collection);
  void range(const parser::RangeExpr& range);
  void lambda(parser::ExprId expr, const parser::LambdaExpr& lambda);
  void three(parser::ExprId left, parser::ExprId set, parser::ExprId right, ProcKind kind);

  // Statements. `body` emits what is done for each binding.
  using Emit = std::function<void()>;
  void strict_loop(std::span<const parser::StatementId> statements, bool over_sets,
                   const Emit& body);
  struct SequenceLoop;
  /// `push_items` leaves the elements for one binding; `link` joins them with what follows.
  void sequence_comprehension(std::span<const parser::StatementId> statements,
                              const Emit& push_items, const Emit& link);
  void sequence_level(std::span<const parser::StatementId> statements, SequenceLoop* outer,
                      const Emit& push_items, const Emit& link);

  // Patterns take the value on top of the stack and jump to `fail` if it does not match.
  void pattern(parser::PatternId pattern, Label& fail);
  void sequence_pattern(parser::PatternId pattern, Label& fail);
  void dot_pattern(parser::PatternId pattern, Label& fail);
  /// One element of a sequence pattern: a pattern, or a character of a string literal.
  struct SequenceItem {
    parser::PatternId pattern;
    ValueId character;
  };
  struct SequenceParts {
    std::vector<SequenceItem> front;
    parser::PatternId middle;
    std::vector<SequenceItem> back;
  };
  SequenceParts flatten_sequence(parser::PatternId pattern);
  void match(const SequenceItem& item, Label& fail);
  void match_stacked(std::span<const SequenceItem> items, Label& fail);
  void match_stacked(std::span<const parser::PatternId> items, Label& fail);
  std::vector<parser::PatternId> flatten_dots(parser::PatternId pattern) const;
  bool is_ignored(parser::PatternId pattern) const;
  bool binds_used_variable(parser::PatternId pattern) const;

  // Processes
  void prefix(parser::ExprId expr);
  void communication(const parser::PrefixExpr& prefix);
  void field_loop(std::span<const parser::FieldId> fields, bool nothing_follows, const Emit& leaf);
  SymbolId partial_atom(parser::PatternId pattern) const;
  void replicated(const parser::ReplicatedExpr& replicated);
  void replicated_link(const parser::ReplicatedLinkExpr& link);
  void ties(const parser::Ties& ties);

  // Timed sections (2.10.4)
  bool is_timed() const {
    return timed_ != not_timed && timed_sections_[timed_].has_timed_operators;
  }
  ValueId tock() const { return values_.make_atom(timed_sections_[timed_].tock); }
  void timed_section(parser::DeclId id, const std::function<void(parser::DeclId)>& declare,
                     const std::function<Location(parser::ExprId)>& declare_duration);
  bool is_timed_builtin(SymbolId symbol) const;
  void apply_to_tock(SymbolId function);
  void push_tock_set();
  void add_tock();
  void timed_prefix(parser::ExprId expr);
  void timed_prefix_body(FunctionId function, const parser::PrefixExpr& prefix);
  void timed_infix(parser::InfixOp op, parser::ExprId right);
  void timed_replicated(const parser::ReplicatedExpr& replicated);
  void refuse_in_timed_section(base::Span span, std::string_view what);

  bool too_deep(parser::ExprId expr);

  const parser::SyntaxTree& tree_;
  const Resolution& resolution_;
  const PreludeFunctions& prelude_;
  ValueStore& values_;
  Program& program_;
  base::Diagnostics& diagnostics_;

  std::vector<Location> locations_;  // by symbol
  std::vector<StaticScope> static_scopes_;
  ScopeIndex scope_ = no_scope;
  std::vector<TimedSection> timed_sections_;
  TimedIndex timed_ = not_timed;
  SymbolId owner_;  // the definition whose body is being lowered
  std::vector<Pending> pending_;
  base::Span span_;
  std::uint32_t nesting_ = 0;
};

}  // namespace perentie::semantics

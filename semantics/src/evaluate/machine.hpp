// The evaluator: runs core code on a stack machine with call by need.
//
// Nothing here recurses on the C++ stack in proportion to a script's data or recursion depth:
// calls, forced thunks and complete evaluation are entries of the control stack. A block that ends
// hands its value to the entry on top. Scopes that name processes and functions are identified by
// the values of their pattern variables (`CanonicalScope`), which makes equal calls equal terms.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "code.hpp"
#include "data_model.hpp"
#include "failure.hpp"
#include "heap.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/base/term_table.hpp"
#include "perentie/semantics/event.hpp"
#include "perentie/semantics/process.hpp"
#include "perentie/semantics/show.hpp"
#include "perentie/semantics/step.hpp"
#include "process_builder.hpp"
#include "value_builtins.hpp"

namespace perentie::semantics {

class Machine final : public FunctionNames, public CallUnfolder {
 public:
  /// `append` and `equal_sequences` are the global slots of these functions of the prelude.
  Machine(const Program& program, const Resolution& resolution, std::uint32_t append,
          std::uint32_t equal_sequences, ValueStore& values, EventTable& events,
          ProcStore& processes);

  /// New globals of the program get their slots; to be called after code was added.
  void extend_globals();
  /// Runs a block outside all scopes, which must leave an evaluated value. Nothing: the reason was
  /// reported, or `limit()` says which budget ran out.
  std::optional<ValueId> run(Address entry, base::Diagnostics& diagnostics);
  /// The body of a named call, evaluated once.
  std::optional<ProcId> unfold(ProcId call, base::Diagnostics& diagnostics) override;

  /// Numbers the events of all channels in order, up to so many, before their first use. False:
  /// there are more, or a channel's fields are infinite, or cannot be computed within the limits.
  bool number_events(std::size_t max);

  void set_limits(base::Limits limits) { limits_ = limits; }
  /// Whether failures come with the calls that led to them.
  void show_calls(bool shown) { shows_calls_ = shown; }
  std::optional<base::LimitReached> limit() const override { return limit_; }
  std::size_t memory_bytes() const;

  std::string function_name(ValueId function) const override;
  bool takes_arguments(ValueId function) const override;
  std::string call_name(ProcId call) const override;
  base::Span definition_span(ProcId call) const override;
  std::optional<base::Span> origin(ProcId term) const override;

  ProcessBuilder& builder() { return builder_; }
  ShowContext show_context() const { return {values_, events_, processes_, resolution_, *this}; }
  /// Warnings that were noticed while evaluating, each once.

 private:
  // --- Control ----------------------------------------------------------------------------------

  enum class ControlKind : std::uint8_t {
    halt,           // the block that `run` started is finished
    resume,         // go on at address a in frame w
    retry,          // drop the value, then go on at address a in frame w
    update,         // w is a thunk: it has the value
    canon,          // evaluate the value completely
    canon_operand,  // the value replaces operand a; go on at address b in frame w
    canon_cells,    // a heads of a sequence are on the stack; w is the cell of the last one
    canon_tail,     // as before; the value is the tail
    canon_tuple,    // a items of tuple w are on the stack
    canon_closure,  // the scope of closure w is identified now
    canon_slot,     // a values of identity slots of frame w are on the stack; the aim is frame v
    fields,         // the value holds the fields of symbol a
  };
  struct Control {
    ControlKind kind;
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    Word w = {};
    Word v = {};
  };
  using Accumulator = std::vector<std::uint32_t>;
  struct Iterator {
    enum class Kind : std::uint8_t { set, sequence, field } kind;
    ValueId collection;
    std::size_t next = 0;
    const std::vector<DataModel::Extension>* extensions = nullptr;  // of an unrestricted field
    std::vector<DataModel::Extension> restricted = {};              // of one with a set
  };
  std::optional<ValueId> run_in(Address entry, Word frame, base::Diagnostics& diagnostics);
  bool compute_fields(SymbolId symbol, base::Diagnostics& diagnostics);
  std::optional<std::vector<ValueId>> events_of(SymbolId channel, std::size_t max);
  bool execute();  // until the run ends; false: it failed
  void run_instructions();
  void step(Instruction instruction);
  void return_value();  // the value on top goes to the innermost control entry
  void check_depth_and_time();
  void safepoint();
  void unwind();
  void report(const EvaluationFailure& failure);
  base::Span failure_span() const;
  std::string frame_values(std::uint32_t scope) const;
  SymbolId definition_around(SymbolId definition) const;
  std::string scope_prefix(std::uint32_t scope, SymbolId innermost) const;

  // --- Operands ---------------------------------------------------------------------------------

  Word pop() {
    const Word word = operands_.back();
    operands_.pop_back();
    return word;
  }
  Word& top(std::size_t below = 0) { return operands_[operands_.size() - 1 - below]; }
  void push(Word word) { operands_.push_back(word); }
  void push(ValueId value) { push(to_word(value)); }
  void push(ProcId process) { push(values_.make_process(process)); }
  void replace(std::size_t count, Word word) {
    operands_.resize(operands_.size() - count);
    push(word);
  }
  void replace(std::size_t count, ValueId value) {
    operands_.resize(operands_.size() - count);
    push(value);
  }
  void replace(std::size_t count, ProcId process) {
    operands_.resize(operands_.size() - count);
    push(process);
  }
  /// The top operands as values, deepest first; they must have been evaluated completely.
  std::vector<ValueId> top_values(std::size_t count);
  Word to_word(ValueId value) const;
  ValueId to_value(Word word);
  std::int64_t integer_at(std::size_t below, std::string_view operation);
  bool boolean_at(std::size_t below);
  ProcId process_at(std::size_t below);
  ProcId remember_origin(ProcId term);
  void checkpoint() const;
  ValueId value_at(std::size_t below) { return to_value(top(below)); }
  // Where evaluation is (call_stack.cpp).
  std::string describe(Word word);
  std::string call_around(Word frame);
  std::vector<base::Note> call_stack();
  static Word settled(Word word);  // looks through evaluated thunks

  // --- Evaluation to normal forms (normal_forms.cpp) ---------------------------------------------
  // Those that return a bool: true if the result is on the stack now, false if code runs first.

  bool is_whnf(Word word) const;
  static bool is_canonical(Word word) { return word.is_integer() || word.is_value(); }
  void enter_thunk(Object* thunk);
  bool canonicalise_top();
  bool canonicalise_tail(std::uint32_t heads, Word tail);
  bool canonicalise_tuple(std::uint32_t done, Word tuple);
  /// Evaluates an operand completely, then executes the instruction at `retry_at` again.
  void canon_operand(std::size_t index, Address retry_at);
  bool identify_scope(Word frame);
  bool identify_slot(std::uint32_t done, Word frame, Word aim);
  void push_identity(Object* frame, std::uint32_t slot);

  // --- Scopes, functions and calls (calls.cpp)
  // ----------------------------------------------------

  Object* new_frame(ScopeId scope, Word parent);
  Object* frame_up(std::uint32_t hops) const;
  static std::optional<std::uint32_t> canonical_scope(Word frame);
  void finish_scope(Object* frame, std::span<const ValueId> identity);
  Word instantiate(std::uint32_t scope);
  void call(std::uint32_t argument_count, Address at);
  void call_builtin(Builtin builtin, std::uint32_t argument_count, Address at);
  void apply_builtin(Builtin builtin, std::uint32_t operand_count, std::uint32_t argument_count);
  void enter_function(const FunctionInfo& function, std::uint32_t group, Word parent,
                      std::uint32_t argument_count);
  void name_process(FunctionId function, std::uint32_t group, Word scope_frame,
                    std::uint32_t argument_count, Address at);
  void process_constant(std::uint32_t hops, FunctionId function, Address at);
  void sequence_builtin(Builtin builtin, std::uint32_t operand_count);
  void force_top();
  [[noreturn]] static void fail_argument_count(std::size_t wanted, std::size_t given);

  // --- Instructions (instructions.cpp)
  // ------------------------------------------------------------

  static Word checked_integer(std::int64_t value, bool overflow);
  void arithmetic(Op op);
  void compare(Op op, Address at);
  void call_prelude(std::uint32_t global);
  void make_list(std::uint32_t items);
  void append();
  void make_tuple(std::uint32_t items);
  void make_map(std::uint32_t entries);
  void make_range_set(bool bounded);
  ValueId require_set(ValueId value) const;
  std::vector<ValueId> set_operands(std::uint32_t count);
  void dot_product(std::uint32_t sets);
  void datatype_set(SymbolId datatype);
  Accumulator take_accumulator();
  void iter_begin(bool over_set);
  void iter_next(Address done);
  void field_begin(bool last, bool has_set);
  void field_next(Address done);
  void match(Instruction instruction);
  bool match_ends(const EndsPattern& pattern);
  bool match_dot(const DotItems& pattern);
  [[noreturn]] void fail_no_match(FunctionId function);
  void delayed_prefix();
  void external_choice(std::uint32_t operand_count);
  void timed_choice();
  [[noreturn]] void fail_unsupported(SymbolId symbol);
  void process_instruction(Instruction instruction);
  std::vector<Tie> accumulated_ties();
  void replicated(ProcKind kind, bool is_choice_of_fields);
  void replicated_link();
  bool need_fields(SymbolId symbol, Address retry_at);

  const Program& program_;
  const Resolution& resolution_;
  std::uint32_t append_;  // the global slots of two functions of the prelude
  std::uint32_t equal_sequences_;
  ValueStore& values_;
  EventTable& events_;
  ProcStore& processes_;
  DataModel data_;
  ProcessBuilder builder_;
  ValueBuiltins builtins_;

  Heap heap_;
  std::vector<Word> operands_;
  std::vector<Control> control_;
  std::vector<Accumulator> accumulators_;
  std::vector<Iterator> iterators_;
  Address pc_ = 0;
  Word frame_;
  bool running_ = false;
  bool shows_calls_ = false;

  std::vector<Word> globals_;
  base::TermTable scopes_;       // canonical scopes: {scope, parent, identity values..}
  std::vector<Word> instances_;  // by canonical scope: its frame
  std::unordered_map<std::uint32_t, ProcId> unfolded_;  // by call
  // Where the script made terms that mean something to the library alone, by term.
  std::unordered_map<std::uint32_t, base::Span> origins_;
  std::optional<base::Span> unfolding_origin_;            // of the call that is being unfolded
  std::unordered_set<std::uint32_t> fields_in_progress_;  // by symbol

  base::Limits limits_;
  std::optional<base::Budget> budget_;
  std::optional<base::LimitReached> limit_;
  base::Diagnostics* diagnostics_ = nullptr;
  std::uint32_t fuel_ = 0;
  std::uint32_t returns_ = 0;
};

}  // namespace perentie::semantics

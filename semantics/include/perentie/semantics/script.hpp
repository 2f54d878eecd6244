// Script: a CSPM file, loaded and ready to be asked. The public face of this library.
//
// Loading reads, parses, resolves, infers types and lowers (steps 1-5); values and processes are
// evaluated on demand (step 6), and `TermSystem` gives a process its transitions (the step rules),
// so that `lts::explore` can make an LTS of it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/base/source.hpp"
#include "perentie/lts/transition_system.hpp"
#include "perentie/parser/ast.hpp"
#include "perentie/parser/parse.hpp"
#include "perentie/semantics/assertions.hpp"
#include "perentie/semantics/process.hpp"
#include "perentie/semantics/symbols.hpp"

namespace perentie::semantics {

class LazyMachine;
class TermSystem;
struct CompiledMachine;
enum class LeafCompression : std::uint8_t;
enum class Preserved : std::uint8_t;
struct MachineCompilation;
struct MachineOptions;

class Script {
 public:
  /// Loads a file with everything it includes. Nothing if there were errors, which are in
  /// `diagnostics`. `sources` must outlive the script.
  static std::unique_ptr<Script> load(base::FileId root, base::SourceMap& sources,
                                      base::Diagnostics& diagnostics,
                                      const parser::ParseOptions& options = {});
  ~Script();

  /// Bounds on every later evaluation.
  void set_limits(const base::Limits& limits);
  /// Whether errors of later evaluations come with the calls that led to them, as notes (3.9).
  void show_calls(bool shown);
  /// Which budget ended the last evaluation, if one did.
  std::optional<base::LimitReached> limit() const;

  /// An expression in the script's scope, read and typed. `origin` is what messages call the text.
  std::optional<parser::ExprId> expression(std::string_view text, base::Diagnostics& diagnostics,
                                           const std::string& origin = "<expression>");
  /// The type of an expression that was read, as FDR prints it.
  std::string type_of(parser::ExprId expression) const;

  /// The value of an expression in the script's scope, as FDR prints it.
  std::optional<std::string> evaluate(std::string_view expression, base::Diagnostics& diagnostics,
                                      const std::string& origin = "<expression>");
  /// A process with the definitions that it leads to (`show_definitions`).
  std::optional<std::string> definitions(ProcId process, base::Diagnostics& diagnostics);
  /// The process that an expression stands for.
  std::optional<ProcId> process(std::string_view expression, base::Diagnostics& diagnostics,
                                const std::string& origin = "<expression>");

  /// An assertion about processes in the script's scope, with or without the word `assert`.
  std::optional<ScriptAssertion> assertion(std::string_view text, base::Diagnostics& diagnostics,
                                           const std::string& origin = "<assertion>");

  /// The value of a print line. Its names and types are looked at here: what is wrong with them
  /// concerns nothing else (11.13).
  std::optional<std::string> evaluate(const ScriptPrint& print, base::Diagnostics& diagnostics);

  /// Numbers the events of all channels in order of declaration. Otherwise they have numbers in
  /// order of first use, and which of several shortest counterexamples is found may depend on what
  /// was computed before. False: some channel has too many events or does not tell them in time.
  bool number_events();

  /// The same of expressions that were read, or are in the script itself.
  std::optional<std::string> evaluate(parser::ExprId expression, base::Diagnostics& diagnostics);
  std::optional<ProcId> process(parser::ExprId expression, base::Diagnostics& diagnostics);
  /// A process that an assertion speaks of: τ and ✓ have priority over the events that it says
  /// (2.6.7), and in a timed section STOP and others are those of the section (2.10.9).
  std::optional<ProcId> process(parser::ExprId expression, const ScriptAssertion& assertion,
                                base::Diagnostics& diagnostics);

  /// The transitions of a process by the step rules. The script must outlive the system.
  TermSystem terms(ProcId process, base::Diagnostics& diagnostics);
  /// The same process as a machine that is made while it is explored (`lazy_machine.hpp`).
  LazyMachine lazy_machine(ProcId process, base::Diagnostics& diagnostics);
  /// The same process as a compiled machine (`machine.hpp`), where that is worth it. Nothing is
  /// reported: without a machine the step rules are to be used.
  MachineCompilation machine(ProcId process, const MachineOptions& options);
  /// The term that a packed state of such a machine stands for.
  ProcId term(const CompiledMachine& machine, std::span<const std::uint64_t> state);
  /// The packed state of a term. Nothing: it is none of the machine, or has terminated.
  std::optional<std::vector<std::uint64_t>> state(const CompiledMachine& machine,
                                                  ProcId term) const;
  /// What is done with the leaves of machines that checks and graphs are made of. As in FDR, that
  /// is `sbisim` unless it is set.
  void set_leaf_compression(LeafCompression compression);
  LeafCompression leaf_compression() const;
  /// What the compressions of later systems must preserve; traces, failures and divergences unless
  /// it is set. Those that do not are taken as the identity.
  void set_preserved(Preserved preserved);
  Preserved preserved() const;

  /// What values, terms and events hold. It never gets less.
  std::size_t memory_bytes() const;

  /// The names of all events that were used so far, by label.
  std::shared_ptr<const lts::LabelNames> label_names() const;

  /// A process term as FDR prints it, cut to `max_length` characters.
  std::string show(ProcId process, std::size_t max_length = 200) const;
  /// The name of a process: of a call, the call; of a compression or graph operator such as
  /// `normal(…)` no more than that; empty if it has none (CSPM reference 7.3.6).
  std::string name(ProcId process) const;
  /// The declared channels as printed, in order of declaration.
  std::vector<std::string> channel_names() const;
  /// The names of the definitions whose value is a process, in order of definition, without
  /// parameters. For messages and completion.
  std::vector<std::string> process_names() const;

  /// What the script defines at its top level and in its modules, with types, in order of
  /// definition.
  struct TypedName {
    std::string name;
    std::string type;
  };
  std::vector<TypedName> types() const;

  /// The compressions that were not applied to some process because it, or what they make of it,
  /// is too large; no result depends on that, the number of states does.
  std::vector<std::string> compressions_given_up() const;

  /// The definition that was called with the most new arguments since limits were set, if they are
  /// many: in a process without end (CSPM reference 6.1.4) it is the one whose arguments grow.
  struct CalledDefinition {
    std::string name;
    base::Span span;
  };
  std::optional<CalledDefinition> most_called() const;

  const parser::SyntaxTree& tree() const;
  /// The core code as text, for `dump --phase core`.
  std::string core_listing() const;

 private:
  friend class TermSystem;
  struct Impl;
  explicit Script(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

/// What one component does in a transition of the whole.
struct TransitionShare {
  std::size_t component;
  lts::Label label;
  ProcId target;
};

/// A process of a script as a `lts::TransitionSystem`: its states are process terms.
class TermSystem {
 public:
  using State = ProcId;

  ~TermSystem();
  TermSystem(TermSystem&&) noexcept;

  /// Fails like `successors`: then the term itself is the only state.
  State initial() const { return initial_; }
  bool successors(State state, std::vector<lts::Transition<State>>& out);
  std::uint64_t state_hash(State state) const;
  /// The names of all events that were used so far.
  std::shared_ptr<const lts::LabelNames> label_names() const;
  std::size_t memory_bytes() const;

  ProcId term(State state) const { return state; }
  /// Which budget ended `successors`, if one did.
  std::optional<base::LimitReached> limit() const;

  /// The running operands of the operator that a state is. Empty: it is no such operator.
  std::vector<ProcId> components(ProcId state);
  /// The components' transitions that make up a transition between states. Nothing: the operator
  /// does not stay in place.
  std::optional<std::vector<TransitionShare>> shares(ProcId from, lts::Label label, ProcId to);
  /// The components that must perform together an event that component `ready` offers. Without
  /// `ready`: the event is outside its alphabet, it can never perform it.
  std::vector<std::size_t> partners(ProcId state, std::size_t ready, lts::Label event) const;
  /// Where the name is defined that a state is. Nothing: the state is no name.
  std::optional<base::Span> definition(ProcId state) const;
  /// What a name stands for; any other state stands for itself.
  ProcId body(ProcId state);

 private:
  friend class Script;
  struct Impl;
  TermSystem(std::unique_ptr<Impl> impl, ProcId initial);

  std::unique_ptr<Impl> impl_;
  ProcId initial_;
};

}  // namespace perentie::semantics

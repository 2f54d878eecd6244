#include "perentie/semantics/script.hpp"

#include <algorithm>
#include <chrono>
#include <unordered_map>
#include <utility>

#include "components.hpp"
#include "compressor.hpp"
#include "evaluate/machine.hpp"
#include "lower/lower.hpp"
#include "machine/compile.hpp"
#include "perentie/parser/print.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"
#include "perentie/semantics/lazy_machine.hpp"
#include "perentie/semantics/resolve.hpp"
#include "perentie/semantics/step.hpp"
#include "perentie/semantics/types.hpp"
#include "prelude.hpp"
#include "show_definitions.hpp"
#include "types/signatures.hpp"

namespace perentie::semantics {

// Everything that one script owns. The steps run in the order of the members.
struct Script::Impl {
  Impl(base::SourceMap& source_map, parser::SyntaxTree syntax_tree,
       const parser::ParseOptions& parse_options)
      : sources(source_map), options(parse_options), tree(std::move(syntax_tree)), resolver(tree) {}

  base::SourceMap& sources;
  parser::ParseOptions options;
  parser::SyntaxTree tree;
  Resolver resolver;
  ValueStore values;
  EventTable events;
  ProcStore processes;
  Program program;
  PreludeFunctions prelude{};
  std::size_t prelude_symbols = 0;  // those before the script's own
  std::optional<TypeChecker> types;
  std::optional<Lowering> lowering;
  std::optional<Machine> machine;
  std::optional<Compressor> compressor;
  LeafCompression leaf_compression = LeafCompression::sbisim;
  Preserved preserved = Preserved::failures_divergences;
  std::size_t first_call = 0;  // since limits were set
  mutable std::shared_ptr<const lts::LabelNames> known_label_names;

  bool prepare(base::Diagnostics& diagnostics);
  std::shared_ptr<const lts::LabelNames> label_names() const;
  CompressionRules compression_rules() { return {*compressor, preserved}; }
  MachineParts machine_parts() {
    return {*machine,
            events,
            processes,
            compression_rules(),
            [this] { return label_names(); },
            [this] { return machine->memory_bytes(); }};
  }
  void load_prelude(base::Diagnostics& diagnostics);
  void mark_processes_by_type();
  parser::ExprId prioritised(parser::ExprId process, parser::ExprId lower);
  std::optional<ProcId> run_process(Address entry, base::Diagnostics& diagnostics);
  enum class Expected : std::uint8_t { anything, process };
  parser::ExprId parse(std::string_view text, const std::string& origin, Expected expected,
                       base::Diagnostics& diagnostics);
  bool admit(parser::ExprId expr, Expected expected, base::Diagnostics& diagnostics);
};

void Script::Impl::load_prelude(base::Diagnostics& diagnostics) {
  const auto file = sources.add("<prelude>", std::string(prelude_text));
  PERENTIE_CHECK(file.has_value(), "no room for the prelude");
  const parser::DeclList declarations =
      parser::parse_declarations(*file, tree, sources, diagnostics, options);
  resolver.resolve_prelude(declarations, diagnostics);
  const auto signatures_file = sources.add("<signatures>", std::string(signatures_text));
  PERENTIE_CHECK(signatures_file.has_value(), "no room for the signatures");
  const parser::DeclList signatures =
      parser::parse_declarations(*signatures_file, tree, sources, diagnostics, options);
  types.emplace(tree, resolver.result());
  types->declare(signatures, diagnostics);
  types->check_declarations(declarations, diagnostics);
  PERENTIE_CHECK(!diagnostics.has_errors(), "the prelude has errors");
  mark_processes_by_type();
  // Scripts see the types that the functions are said to have.
  types->declare(signatures, diagnostics);
  const auto function = [&](const char* name) { return resolver.result().prelude.at(name); };
  prelude = {.append = function("append_"),
             .length = function("length"),
             .from = function("from_"),
             .from_to = function("from_to_"),
             .equal_sequences = function("equal_sequences_"),
             .timed_stop = function("timed_stop_"),
             .timed_skip = function("timed_skip_"),
             .wait = function("WAIT"),
             .timed_priority = function("timed_priority")};
  lowering.emplace(tree, resolver.result(), prelude, values, program, diagnostics);
  lowering->declarations(declarations);
  // FDR's names for the timed constants; the event is bound where a section uses the functions.
  auto& symbols = resolver.result().symbols;
  symbols[prelude.timed_stop].qualified = "STOP";
  symbols[prelude.timed_skip].qualified = "SKIP";
  for (const SymbolId symbol : {prelude.wait, prelude.timed_priority}) {
    symbols[symbol].groups = 1;
    symbols[symbol].is_process = true;
  }
  program.prelude_end = static_cast<Address>(program.code.size());
}

// A constant or function is a process by its type, whatever its definition looks like (3.8.2).
void Script::Impl::mark_processes_by_type() {
  auto& symbols = resolver.result().symbols;
  for (std::uint32_t i = 0; i < symbols.size(); ++i) {
    Symbol& symbol = symbols[SymbolId{i}];
    const bool is_definition =
        symbol.kind == SymbolKind::constant || symbol.kind == SymbolKind::function;
    if (is_definition && types->is_process(SymbolId{i})) symbol.is_process = true;
  }
}

bool Script::Impl::prepare(base::Diagnostics& diagnostics) {
  load_prelude(diagnostics);
  prelude_symbols = resolver.result().symbols.size();
  resolver.resolve_script(tree.declarations, diagnostics);
  if (diagnostics.has_errors()) return false;
  types->check_declarations(tree.declarations, diagnostics);
  if (diagnostics.has_errors()) return false;
  mark_processes_by_type();
  lowering->declarations(tree.declarations);
  if (diagnostics.has_errors()) return false;
  machine.emplace(program, resolver.result(), lowering->global_slot(prelude.append),
                  lowering->global_slot(prelude.equal_sequences), values, events, processes);
  machine->extend_globals();
  return true;
}

// `prioritise(process, <{}, lower>)`, as a part of the tree.
parser::ExprId Script::Impl::prioritised(parser::ExprId process, parser::ExprId lower) {
  const base::Span span = tree.exprs[process].span;
  const auto list = [&](std::initializer_list<parser::ExprId> items) {
    return tree.expr_lists.add(std::span(items.begin(), items.size()));
  };
  const auto collection = [&](parser::Collection kind, parser::ExprList items) {
    return tree.exprs.add({span, parser::CollectionExpr{kind, items, {}}});
  };
  Resolution& resolution = resolver.result();
  const auto symbol = std::ranges::find_if(resolution.symbols, [](const Symbol& s) {
    return s.kind == SymbolKind::builtin && s.builtin == Builtin::prioritise;
  });
  const base::NameId name = symbol->name;
  const parser::ExprId function =
      tree.exprs.add({span, parser::NameExpr{{tree.name_lists.add(std::span(&name, 1))}}});
  const parser::ExprId none = collection(parser::Collection::set, {});
  const parser::ExprId order = collection(parser::Collection::sequence, list({none, lower}));
  const parser::ExprId call =
      tree.exprs.add({span, parser::ApplyExpr{function, list({process, order})}});
  resolution.of_expr.resize(tree.exprs.size());
  resolution.of_expr[function.value] =
      SymbolId{static_cast<std::uint32_t>(symbol - resolution.symbols.begin())};
  return call;
}

// Parses, resolves and infers an expression in the scope of the script; none if it is wrong.
parser::ExprId Script::Impl::parse(std::string_view text, const std::string& origin,
                                   Expected expected, base::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  const auto file = sources.add(origin, std::string(text));
  if (!file) return {};
  const parser::ExprId expr = parser::parse_expression(*file, tree, sources, diagnostics, options);
  if (!expr || diagnostics.error_count() > errors) return {};
  return admit(expr, expected, diagnostics) ? expr : parser::ExprId{};
}

// Resolves and infers an expression of the tree in the scope of the script.
bool Script::Impl::admit(parser::ExprId expr, Expected expected, base::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  resolver.resolve_expression(expr, diagnostics);
  if (diagnostics.error_count() > errors) return false;
  const bool is_well_typed = expected == Expected::process
                                 ? types->check_process(expr, diagnostics)
                                 : types->check_expression(expr, diagnostics);
  if (is_well_typed) mark_processes_by_type();
  return is_well_typed;
}

Script::Script(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Script::~Script() = default;

std::optional<ProcId> Script::Impl::run_process(Address entry, base::Diagnostics& diagnostics) {
  machine->extend_globals();
  const std::optional<ValueId> value = machine->run(entry, diagnostics);
  return value ? std::optional(values.as_process(*value)) : std::nullopt;
}

std::unique_ptr<Script> Script::load(base::FileId root, base::SourceMap& sources,
                                     base::Diagnostics& diagnostics,
                                     const parser::ParseOptions& options) {
  parser::SyntaxTree tree = parser::parse_script(root, sources, diagnostics, options);
  if (diagnostics.has_errors()) return nullptr;
  auto impl = std::make_unique<Impl>(sources, std::move(tree), options);
  if (!impl->prepare(diagnostics)) return nullptr;
  auto script = std::unique_ptr<Script>(new Script(std::move(impl)));
  script->impl_->compressor.emplace(*script, script->impl_->events, script->impl_->processes);
  return script;
}

void Script::set_limits(const base::Limits& limits) {
  impl_->machine->set_limits(limits);
  impl_->compressor->set_limits(limits);
  impl_->first_call = impl_->processes.size();
}

bool Script::number_events() {
  constexpr std::size_t max_events = 100'000;
  constexpr std::chrono::seconds max_time{1};
  impl_->machine->set_limits({.timeout = max_time});
  const bool all = impl_->machine->number_events(max_events);
  impl_->machine->set_limits({});
  return all;
}

std::size_t Script::memory_bytes() const { return impl_->machine->memory_bytes(); }

void Script::show_calls(bool shown) { impl_->machine->show_calls(shown); }

std::optional<base::LimitReached> Script::limit() const { return impl_->machine->limit(); }

std::optional<parser::ExprId> Script::expression(std::string_view text,
                                                 base::Diagnostics& diagnostics,
                                                 const std::string& origin) {
  const parser::ExprId expr = impl_->parse(text, origin, Impl::Expected::anything, diagnostics);
  return expr ? std::optional(expr) : std::nullopt;
}

std::string Script::type_of(parser::ExprId expression) const {
  return impl_->types->show(expression);
}

std::optional<std::string> Script::evaluate(std::string_view expression,
                                            base::Diagnostics& diagnostics,
                                            const std::string& origin) {
  const auto expr = this->expression(expression, diagnostics, origin);
  return expr ? evaluate(*expr, diagnostics) : std::nullopt;
}

std::optional<std::string> Script::evaluate(const ScriptPrint& print,
                                            base::Diagnostics& diagnostics) {
  const bool is_right =
      print.expression && impl_->admit(print.expression, Impl::Expected::anything, diagnostics);
  return is_right ? evaluate(print.expression, diagnostics) : std::nullopt;
}

std::optional<std::string> Script::evaluate(parser::ExprId expression,
                                            base::Diagnostics& diagnostics) {
  const Address entry = impl_->lowering->expression(expression);
  impl_->machine->extend_globals();
  const std::optional<ValueId> value = impl_->machine->run(entry, diagnostics);
  if (!value) return std::nullopt;
  return show_value(impl_->machine->show_context(), *value);
}

std::optional<ProcId> Script::process(std::string_view expression, base::Diagnostics& diagnostics,
                                      const std::string& origin) {
  const parser::ExprId expr =
      impl_->parse(expression, origin, Impl::Expected::process, diagnostics);
  if (!expr) return std::nullopt;
  return process(expr, diagnostics);
}

std::optional<ProcId> Script::process(parser::ExprId expression, base::Diagnostics& diagnostics) {
  return impl_->run_process(impl_->lowering->process_expression(expression), diagnostics);
}

std::optional<ProcId> Script::process(parser::ExprId expression, const ScriptAssertion& assertion,
                                      base::Diagnostics& diagnostics) {
  const parser::ExprId events = assertion.assertion.options.tau_priority;
  if (events) expression = impl_->prioritised(expression, events);
  return impl_->run_process(
      impl_->lowering->process_expression(expression, assertion.timed_section), diagnostics);
}

std::optional<ScriptAssertion> Script::assertion(std::string_view text,
                                                 base::Diagnostics& diagnostics,
                                                 const std::string& origin) {
  const std::size_t errors = diagnostics.error_count();
  const auto file = impl_->sources.add(origin, std::string(text));
  if (!file) return std::nullopt;
  parser::SyntaxTree& tree = impl_->tree;
  const auto parsed =
      parser::parse_assertion(*file, tree, impl_->sources, diagnostics, impl_->options);
  if (!parsed) return std::nullopt;
  const parser::DeclId decl =
      tree.decls.add({impl_->sources.span(*file), parser::AssertDecl{*parsed}});
  const parser::DeclList declarations = tree.decl_lists.add(std::span(&decl, 1));
  impl_->resolver.resolve_script(declarations, diagnostics);
  if (diagnostics.error_count() > errors) return std::nullopt;
  impl_->types->check_declarations(declarations, diagnostics);
  if (diagnostics.error_count() > errors) return std::nullopt;
  return ScriptAssertion{parser::print(tree, *parsed, {.width = 0}), tree.decls[decl].span,
                         *parsed};
}

std::optional<std::string> Script::definitions(ProcId process, base::Diagnostics& diagnostics) {
  return show_definitions(impl_->machine->show_context(), process,
                          [&](ProcId call) { return impl_->machine->unfold(call, diagnostics); });
}

std::optional<std::vector<std::uint64_t>> Script::state(const CompiledMachine& machine,
                                                        ProcId term) const {
  return machine_state(machine, term, impl_->processes);
}

void Script::set_leaf_compression(LeafCompression compression) {
  impl_->leaf_compression = compression;
}

LeafCompression Script::leaf_compression() const { return impl_->leaf_compression; }

std::shared_ptr<const lts::LabelNames> Script::label_names() const { return impl_->label_names(); }

std::string Script::show(ProcId process, std::size_t max_length) const {
  return show_process(impl_->machine->show_context(), process, max_length);
}

std::string Script::name(ProcId process) const {
  constexpr std::size_t max_length = 200;
  switch (impl_->processes.kind(process)) {
    case ProcKind::call:
      return show(process, max_length);
    case ProcKind::compression:
    case ProcKind::graph_operator: {
      const auto builtin = static_cast<Builtin>(impl_->processes.word(process, 0));
      return std::string(info(builtin).name) + "(…)";
    }
    default:
      return {};
  }
}

std::vector<std::string> Script::channel_names() const {
  const Resolution& resolution = impl_->resolver.result();
  std::vector<std::string> names;
  for (const SymbolId channel : resolution.channels) {
    names.push_back(resolution.symbols[channel].qualified);
  }
  return names;
}

std::vector<std::string> Script::process_names() const {
  std::vector<std::string> names;
  const auto& symbols = impl_->resolver.result().symbols;
  for (std::size_t i = impl_->prelude_symbols; i < symbols.size(); ++i) {
    const Symbol& symbol = symbols[SymbolId{static_cast<std::uint32_t>(i)}];
    const bool is_definition =
        symbol.kind == SymbolKind::constant || symbol.kind == SymbolKind::function;
    if (is_definition && symbol.is_process && symbol.decl) names.push_back(symbol.qualified);
  }
  return names;
}

std::vector<Script::TypedName> Script::types() const {
  std::vector<TypedName> names;
  const Resolution& resolution = impl_->resolver.result();
  for (const SymbolId symbol : impl_->types->top_level()) {
    if (symbol.value < impl_->prelude_symbols) continue;
    names.push_back(
        {resolution.symbols[symbol].qualified, impl_->types->show(symbol).value_or("")});
  }
  return names;
}

void Script::set_preserved(Preserved preserved) { impl_->preserved = preserved; }

Preserved Script::preserved() const { return impl_->preserved; }

std::vector<std::string> Script::compressions_given_up() const {
  std::vector<std::string> names;
  for (const Builtin builtin : impl_->compressor->given_up()) {
    names.emplace_back(info(builtin).name);
  }
  return names;
}

std::optional<Script::CalledDefinition> Script::most_called() const {
  constexpr std::uint32_t many = 1'000;
  std::unordered_map<std::uint32_t, std::uint32_t> counts;  // by function
  std::uint32_t most = many;
  ProcId call;
  for (auto i = static_cast<std::uint32_t>(impl_->first_call); i < impl_->processes.size(); ++i) {
    if (impl_->processes.kind(ProcId{i}) != ProcKind::call) continue;
    const std::uint32_t count = ++counts[impl_->processes.word(ProcId{i}, 0)];
    if (count <= most) continue;
    most = count;
    call = ProcId{i};
  }
  if (!call) return std::nullopt;
  return CalledDefinition{impl_->machine->call_name(call), impl_->machine->definition_span(call)};
}

const parser::SyntaxTree& Script::tree() const { return impl_->tree; }

std::string Script::core_listing() const {
  return list_code(impl_->program, impl_->resolver.result(), impl_->values);
}

// --- TermSystem ---------------------------------------------------------------------------------

struct TermSystem::Impl {
  Impl(Script::Impl& owner, base::Diagnostics& diagnostics)
      : script(owner),
        rules(*owner.machine, owner.events, owner.processes, owner.compression_rules(),
              diagnostics),
        components(owner.events, owner.processes, rules),
        sink(diagnostics) {}

  Script::Impl& script;
  StepRules rules;
  Components components;
  base::Diagnostics& sink;
  bool has_initial = true;  // false: it was reported why not
};

TermSystem::TermSystem(std::unique_ptr<Impl> impl, ProcId initial)
    : impl_(std::move(impl)), initial_(initial) {}
TermSystem::TermSystem(TermSystem&&) noexcept = default;
TermSystem::~TermSystem() = default;

TermSystem Script::terms(ProcId process, base::Diagnostics& diagnostics) {
  auto impl = std::make_unique<TermSystem::Impl>(*impl_, diagnostics);
  const std::optional<ProcId> initial = impl->rules.state(process);
  impl->has_initial = initial.has_value();
  return TermSystem(std::move(impl), initial.value_or(process));
}

bool TermSystem::successors(State state, std::vector<lts::Transition<State>>& out) {
  return impl_->has_initial && impl_->rules.successors(state, out);
}

MachineCompilation Script::machine(ProcId process, const MachineOptions& options) {
  return compile_machine(process, impl_->machine_parts(), options);
}

LazyMachine Script::lazy_machine(ProcId process, base::Diagnostics& diagnostics) {
  return LazyMachine(process, impl_->machine_parts(), diagnostics);
}

ProcId Script::term(const CompiledMachine& machine, std::span<const std::uint64_t> state) {
  return machine_term(machine, state, impl_->processes);
}

std::uint64_t TermSystem::state_hash(State state) const { return base::hash_mix(0, state.value); }

std::shared_ptr<const lts::LabelNames> TermSystem::label_names() const {
  return impl_->script.label_names();
}

// Asked for after every exploration, and events are only ever added.
std::shared_ptr<const lts::LabelNames> Script::Impl::label_names() const {
  if (known_label_names && known_label_names->size() == events.size()) return known_label_names;
  const ShowContext context = machine->show_context();
  auto names = std::make_shared<lts::LabelNames>();
  names->emplace_back(lts::tau_name);
  names->emplace_back(lts::tick_name);
  for (std::uint32_t i = 2; i < events.size(); ++i) {
    names->push_back(show_value(context, events.value(EventId{i})));
  }
  known_label_names = names;
  return names;
}

std::size_t TermSystem::memory_bytes() const { return impl_->script.machine->memory_bytes(); }

std::optional<base::LimitReached> TermSystem::limit() const { return impl_->rules.limit(); }

std::vector<ProcId> TermSystem::components(ProcId state) { return impl_->components.of(state); }

std::optional<std::vector<TransitionShare>> TermSystem::shares(ProcId from, lts::Label label,
                                                               ProcId to) {
  return impl_->components.shares(from, label, to);
}

std::vector<std::size_t> TermSystem::partners(ProcId state, std::size_t ready,
                                              lts::Label event) const {
  return impl_->components.partners(state, ready, event);
}

std::optional<base::Span> TermSystem::definition(ProcId state) const {
  if (impl_->script.processes.kind(state) != ProcKind::call) return std::nullopt;
  return impl_->script.machine->definition_span(state);
}

ProcId TermSystem::body(ProcId state) {
  constexpr int max_names = 1000;
  for (int i = 0; i < max_names && impl_->script.processes.kind(state) == ProcKind::call; ++i) {
    const auto body = impl_->script.machine->unfold(state, impl_->sink);
    if (!body) break;
    state = *body;
  }
  return state;
}

}  // namespace perentie::semantics

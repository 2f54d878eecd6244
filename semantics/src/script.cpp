#include "perentie/semantics/script.hpp"

#include <utility>

#include "evaluate/machine.hpp"
#include "lower/lower.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"
#include "perentie/semantics/resolve.hpp"
#include "perentie/semantics/step.hpp"
#include "prelude.hpp"
#include "process_kinds.hpp"
#include "show_definitions.hpp"

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
  std::optional<Lowering> lowering;
  std::optional<Machine> machine;

  bool prepare(base::Diagnostics& diagnostics);
  void load_prelude(base::Diagnostics& diagnostics);
  parser::ExprId parse(std::string_view text, const std::string& origin,
                       base::Diagnostics& diagnostics);
};

void Script::Impl::load_prelude(base::Diagnostics& diagnostics) {
  const auto file = sources.add("<prelude>", std::string(prelude_text));
  PERENTIE_CHECK(file.has_value(), "no room for the prelude");
  const parser::DeclList declarations =
      parser::parse_declarations(*file, tree, sources, diagnostics, options);
  resolver.resolve_prelude(declarations, diagnostics);
  PERENTIE_CHECK(!diagnostics.has_errors(), "the prelude has errors");
  mark_processes(tree, resolver.result());
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

bool Script::Impl::prepare(base::Diagnostics& diagnostics) {
  load_prelude(diagnostics);
  resolver.resolve_script(tree.declarations, diagnostics);
  if (diagnostics.has_errors()) return false;
  mark_processes(tree, resolver.result());
  lowering->declarations(tree.declarations);
  if (diagnostics.has_errors()) return false;
  machine.emplace(program, resolver.result(), lowering->global_slot(prelude.append),
                  lowering->global_slot(prelude.equal_sequences), values, events, processes);
  machine->extend_globals();
  return true;
}

// Parses and resolves an expression in the scope of the script; none if it is wrong.
parser::ExprId Script::Impl::parse(std::string_view text, const std::string& origin,
                                   base::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  const auto file = sources.add(origin, std::string(text));
  if (!file) return {};
  const parser::ExprId expr = parser::parse_expression(*file, tree, sources, diagnostics, options);
  if (!expr || diagnostics.error_count() > errors) return {};
  resolver.resolve_expression(expr, diagnostics);
  if (diagnostics.error_count() > errors) return {};
  mark_processes(tree, resolver.result());
  return expr;
}

Script::Script(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Script::~Script() = default;

std::unique_ptr<Script> Script::load(base::FileId root, base::SourceMap& sources,
                                     base::Diagnostics& diagnostics,
                                     const parser::ParseOptions& options) {
  parser::SyntaxTree tree = parser::parse_script(root, sources, diagnostics, options);
  if (diagnostics.has_errors()) return nullptr;
  auto impl = std::make_unique<Impl>(sources, std::move(tree), options);
  if (!impl->prepare(diagnostics)) return nullptr;
  return std::unique_ptr<Script>(new Script(std::move(impl)));
}

void Script::set_limits(const base::Limits& limits) { impl_->machine->set_limits(limits); }

std::optional<base::LimitReached> Script::limit() const { return impl_->machine->limit(); }

std::optional<std::string> Script::evaluate(std::string_view expression,
                                            base::Diagnostics& diagnostics,
                                            const std::string& origin) {
  const parser::ExprId expr = impl_->parse(expression, origin, diagnostics);
  if (!expr) return std::nullopt;
  const Address entry = impl_->lowering->expression(expr);
  impl_->machine->extend_globals();
  const std::optional<ValueId> value = impl_->machine->run(entry, diagnostics);
  if (!value) return std::nullopt;
  return show_value(impl_->machine->show_context(), *value);
}

std::optional<ProcId> Script::process(std::string_view expression, base::Diagnostics& diagnostics,
                                      const std::string& origin) {
  const parser::ExprId expr = impl_->parse(expression, origin, diagnostics);
  if (!expr) return std::nullopt;
  const Address entry = impl_->lowering->process_expression(expr);
  impl_->machine->extend_globals();
  const std::optional<ValueId> value = impl_->machine->run(entry, diagnostics);
  if (!value) return std::nullopt;
  return impl_->values.as_process(*value);
}

std::optional<std::string> Script::definitions(ProcId process, base::Diagnostics& diagnostics) {
  return show_definitions(impl_->machine->show_context(), process,
                          [&](ProcId call) { return impl_->machine->unfold(call, diagnostics); });
}

std::string Script::show(ProcId process, std::size_t max_length) const {
  return show_process(impl_->machine->show_context(), process, max_length);
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
  for (const Symbol& symbol : impl_->resolver.result().symbols) {
    const bool is_definition =
        symbol.kind == SymbolKind::constant || symbol.kind == SymbolKind::function;
    if (is_definition && symbol.is_process && symbol.decl) names.push_back(symbol.qualified);
  }
  return names;
}

std::vector<std::string> Script::compressions_taken_as_identity() const {
  std::vector<std::string> names;
  for (const Builtin builtin : impl_->machine->compressions_seen()) {
    names.emplace_back(info(builtin).name);
  }
  return names;
}

const parser::SyntaxTree& Script::tree() const { return impl_->tree; }

std::string Script::core_listing() const {
  return list_code(impl_->program, impl_->resolver.result(), impl_->values);
}

// --- TermSystem ---------------------------------------------------------------------------------

struct TermSystem::Impl {
  Impl(Script::Impl& owner, base::Diagnostics& diagnostics)
      : script(owner), rules(*owner.machine, owner.events, owner.processes, diagnostics) {}

  Script::Impl& script;
  StepRules rules;
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

std::uint64_t TermSystem::state_hash(State state) const { return base::hash_mix(0, state.value); }

std::shared_ptr<const lts::LabelNames> TermSystem::label_names() const {
  const EventTable& events = impl_->script.events;
  const ShowContext context = impl_->script.machine->show_context();
  auto names = std::make_shared<lts::LabelNames>();
  names->emplace_back(lts::tau_name);
  names->emplace_back(lts::tick_name);
  for (std::uint32_t i = 2; i < events.size(); ++i) {
    names->push_back(show_value(context, events.value(EventId{i})));
  }
  return names;
}

std::size_t TermSystem::memory_bytes() const { return impl_->script.machine->memory_bytes(); }

std::optional<base::LimitReached> TermSystem::limit() const { return impl_->rules.limit(); }

}  // namespace perentie::semantics

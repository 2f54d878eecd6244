#include "model.hpp"

#include <unistd.h>

#include <algorithm>
#include <thread>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "perentie/monitor/diagnostic_codes.hpp"

namespace perentie::cli {
namespace {

#define PERENTIE_DIAGNOSTIC(name, id, severity, title) \
  constexpr base::DiagnosticCode name{id, base::Severity::severity, title};
#include "diagnostic_codes.def"
#undef PERENTIE_DIAGNOSTIC

// CLI::PositiveNumber names the greatest double, with all its digits, when it complains.
const CLI::Validator positive(
    [](std::string& text) -> std::string {
      double value = 0;
      if (CLI::detail::lexical_cast(text, value) && value > 0) return {};
      return fmt::format("`{}` is not a positive number", text);
    },
    "POSITIVE");

// Three quarters of the machine's memory; 0 if the machine does not tell.
std::uint64_t default_max_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page_bytes = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_bytes <= 0) return 0;
  return static_cast<std::uint64_t>(pages) / 4 * 3 * static_cast<std::uint64_t>(page_bytes);
}

// Nothing is known of the process but that it has an initial state.
lts::Lts unexplored() {
  lts::LtsBuilder builder(std::make_shared<const lts::LabelNames>(
      lts::LabelNames{std::string(lts::tau_name), std::string(lts::tick_name)}));
  builder.add_state();
  return std::move(builder).finish(lts::State{0});
}

}  // namespace

unsigned processor_count() {
  return std::clamp(std::thread::hardware_concurrency(), 1U, max_workers);
}

BudgetOptions::BudgetOptions() : max_memory(default_max_memory()), workers(processor_count()) {}

void BudgetOptions::add_to(CLI::App& app) {
  app.add_option("--max-states", max_states, "Stop after this many states (inconclusive)")
      ->check(positive)
      ->group("Budgets");
  app.add_option("--max-memory", max_memory,
                 "Stop at about this much memory, such as 2GB; default: three quarters of the\n"
                 "machine's; 0: no limit")
      ->transform(CLI::AsSizeValue(false))
      ->group("Budgets");
  app.add_option("--timeout", timeout, "Stop after this many seconds")
      ->check(positive)
      ->group("Budgets");
  app.add_option(
         "--workers", workers,
         "How many threads explore; default: one for each processor. No result depends on it")
      ->check(CLI::Range(1U, max_workers))
      ->type_name("N")
      ->group("Budgets");
}

base::Limits BudgetOptions::limits() const {
  base::Limits limits;
  if (max_states > 0) limits.max_states = max_states;
  if (max_memory > 0) limits.max_memory_bytes = max_memory;
  if (timeout > 0) {
    constexpr double century = 100.0 * 365 * 86'400;  // counts of milliseconds have an end
    limits.timeout =
        std::chrono::milliseconds(static_cast<std::int64_t>(std::min(timeout, century) * 1000));
  }
  limits.workers = workers;
  limits.cancelled = &interrupted();
  return limits;
}

semantics::LeafCompression leaf_compression_of(const std::string& option) {
  using enum semantics::LeafCompression;
  return option == "none" ? none : option == "sbisim" ? sbisim : wbisim;
}

std::optional<base::FileId> Input::read(const std::string& path) {
  const base::AddedFile added = base::add_file(path, sources);
  if (!added.file) {
    diagnostics.report(unreadable_file, fmt::format("cannot read `{}`: {}", path, added.error));
  }
  return added.file;
}

ExitCode Input::failure(ExitCode otherwise) const {
  const auto& all = diagnostics.all();
  const bool unreadable = std::any_of(all.begin(), all.end(), [](const base::Diagnostic& d) {
    return d.code == &unreadable_file || d.code == &monitor::codes::unreadable_file;
  });
  return unreadable ? ExitCode::io_error : otherwise;
}

std::unique_ptr<semantics::Script> load_script(const std::string& path, Input& input,
                                               Console& console, ExitCode& code) {
  const auto file = input.read(path);
  std::unique_ptr<semantics::Script> script;
  if (file) script = semantics::Script::load(*file, input.sources, input.diagnostics);
  console.print(input.diagnostics, input.sources);
  code = input.failure(ExitCode::model_error);
  return script;
}

std::string compression_given_up(const std::string& compression) {
  return fmt::format(
      "`{}` was not applied to a process that is too large: no answer depends on it, the number of "
      "states does",
      compression);
}

namespace {

// Evaluates a process and gives it to `explore`. If a budget ends the evaluation, that is the limit
// of an empty result.
template <class Explore, class Result = std::invoke_result_t<Explore, semantics::ProcId,
                                                             const lts::ExploreOptions&>>
std::optional<Result> explored(semantics::Script& script, const std::string& process,
                               const std::string& origin, const base::Limits& limits, Input& input,
                               Console& console, ExitCode& code, Result empty, Explore explore) {
  code = ExitCode::model_error;
  script.set_limits(limits);
  const std::optional<semantics::ProcId> initial =
      script.process(process, input.diagnostics, origin);
  if (!initial) {
    console.print(input.diagnostics, input.sources);
    empty.limit = script.limit();
    return empty.limit ? std::optional(std::move(empty)) : std::nullopt;
  }
  lts::ExploreOptions options{.limits = limits};
  options.progress = [&console](const lts::ExploreProgress& p) { console.progress(p); };
  Result found = explore(*initial, options);
  console.clear_progress();
  console.print(input.diagnostics, input.sources);
  if (found.failed && !found.limit) return std::nullopt;
  for (const std::string& compression : script.compressions_given_up()) {
    console.note(compression_given_up(compression));
  }
  return found;
}

}  // namespace

std::optional<semantics::ProcessExploration> build_lts(semantics::Script& script,
                                                       const std::string& process,
                                                       const std::string& origin,
                                                       const base::Limits& limits, Input& input,
                                                       Console& console, ExitCode& code) {
  return explored(script, process, origin, limits, input, console, code,
                  semantics::ProcessExploration{.lts = unexplored(), .term = {}, .structure = {}},
                  [&](semantics::ProcId initial, const lts::ExploreOptions& options) {
                    return semantics::explore_process(script, initial, options, input.diagnostics);
                  });
}

std::optional<semantics::ProcessSize> count_lts(semantics::Script& script,
                                                const std::string& process,
                                                const std::string& origin,
                                                const base::Limits& limits, Input& input,
                                                Console& console, ExitCode& code) {
  return explored(script, process, origin, limits, input, console, code, semantics::ProcessSize{},
                  [&](semantics::ProcId initial, const lts::ExploreOptions& options) {
                    return semantics::count_process(script, initial, options, input.diagnostics);
                  });
}

}  // namespace perentie::cli

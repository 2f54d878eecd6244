// perentie monitor: a trace of a running system against a process of a model.
//
// The line from a model and a trace to a verdict: load, explore, hide what the system does not
// show, normalise, compile the table, read the trace. What to monitor comes from a Varanus
// configuration or from options; options win.
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <memory>

#include <fmt/format.h>

#include "commands.hpp"
#include "model.hpp"
#include "perentie/lts/hide.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/monitor/determinism_gate.hpp"
#include "perentie/monitor/event_map.hpp"
#include "perentie/monitor/mapping.hpp"
#include "perentie/monitor/report.hpp"
#include "perentie/monitor/session.hpp"
#include "perentie/monitor/trace_reader.hpp"
#include "perentie/monitor/varanus_config.hpp"
#include "perentie/monitor/visible_channels.hpp"

namespace perentie::cli {
namespace {

using monitor::Placed;

struct Options {
  std::string config;
  std::string model, process, trace, map, mapping, mode;
  std::vector<std::string> alphabet;
  std::string trace_format = "auto";
  std::string determinism = "warn";
  std::string format = "text";
  BudgetOptions budget;
};

// What is to be monitored, once the configuration and the options are put together.
struct Task {
  std::string name;
  std::string model;
  std::string process;
  std::string process_origin = "--process";
  std::string trace;
  std::string map;
  std::string mapping;
  bool is_varanus = false;  // a configuration without a mapping of its own
  monitor::Mode mode = monitor::Mode::permissive;
  std::optional<std::vector<Placed<std::string>>> model_channels;    // Varanus's `alphabet`
  std::optional<std::vector<Placed<std::string>>> visible_channels;  // `common_alphabet`
};

// --- What to monitor ----------------------------------------------------------------------------

std::optional<Task> task_from(const Options& options, Input& input, Console& console) {
  Task task;
  if (!options.config.empty()) {
    const auto config =
        monitor::load_varanus_config(options.config, input.sources, input.diagnostics);
    console.print(input.diagnostics, input.sources);
    if (!config) return std::nullopt;
    task.name = config->name;
    task.model = config->model.value;
    task.process = config->main_process.value;
    task.process_origin = options.config + " (main_process)";
    if (config->trace_file) task.trace = config->trace_file->value;
    if (config->map) task.map = config->map->value;
    if (config->mapping) task.mapping = config->mapping->value;
    task.is_varanus = !config->mapping;
    task.mode = config->mode;
    task.model_channels = config->alphabet;
    task.visible_channels = config->common_alphabet;
  }
  const auto override_with = [](std::string& value, const std::string& option) {
    if (!option.empty()) value = option;
  };
  override_with(task.model, options.model);
  override_with(task.trace, options.trace);
  override_with(task.map, options.map);
  if (!options.process.empty()) {
    task.process = options.process;
    task.process_origin = "--process";
  }
  if (!options.mapping.empty()) {
    task.mapping = options.mapping;
    task.is_varanus = false;
  }
  if (!options.mode.empty()) {
    task.mode = options.mode == "strict" ? monitor::Mode::strict : monitor::Mode::permissive;
  }
  if (!options.alphabet.empty()) {
    task.visible_channels.emplace();
    for (const std::string& name : options.alphabet) {
      task.visible_channels->push_back({name, std::nullopt});
    }
  }
  const std::pair<const std::string*, const char*> needed[] = {
      {&task.model, "a model (--model, or `model` in the configuration)"},
      {&task.process, "a process (--process, or `main_process` in the configuration)"},
      {&task.trace, "a trace (--trace, or `trace_file` in the configuration)"}};
  for (const auto& [value, what] : needed) {
    if (!value->empty()) continue;
    console.error(fmt::format("there is nothing to monitor: {} is needed", what));
    return std::nullopt;
  }
  return task;
}

// How the trace becomes events.
struct Events {
  std::optional<monitor::EventMap> map;
  std::optional<monitor::Mapping> mapping;
  std::optional<monitor::Mapping> fallback;

  monitor::EventSources sources() const {
    return {.mapping = mapping ? &*mapping : nullptr,
            .fallback = fallback ? &*fallback : nullptr,
            .event_map = map ? &*map : nullptr};
  }
};

// Varanus reads a log with the rover's mapping, and with the simple one if that gives nothing.
bool load_events(const Task& task, Input& input, Events& events) {
  if (!task.map.empty()) {
    events.map = monitor::load_event_map(task.map, input.sources, input.diagnostics);
    if (!events.map) return false;
  }
  const bool varanus = task.is_varanus && task.mapping.empty();
  const std::string first = varanus                ? "varanus-rover"
                            : task.mapping.empty() ? "simple"
                                                   : task.mapping;
  events.mapping = monitor::load_mapping(first, input.sources, input.diagnostics);
  if (!events.mapping) return false;
  if (varanus) {
    events.fallback = monitor::load_mapping("simple", input.sources, input.diagnostics);
    if (!events.fallback) return false;
  }
  return true;
}

// --- The model ----------------------------------------------------------------------------------

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Varanus's gate. What it says if it was required and does not hold, else nothing.
std::optional<std::string> failed_gate(const Options& options, const Task& task,
                                       const lts::Lts& process, const Events& events,
                                       const base::Limits& limits, Console& console) {
  if (options.determinism == "ignore" || !task.model_channels || !task.visible_channels) {
    return std::nullopt;
  }
  const auto names = [&](const std::vector<Placed<std::string>>& channels) {
    std::vector<std::string> result;
    for (const auto& channel : channels) {
      result.emplace_back(events.map ? (*events.map)(channel.value) : channel.value);
    }
    return result;
  };
  const monitor::DeterminismGate gate = monitor::check_determinism_gate(
      process, names(*task.model_channels), names(*task.visible_channels), limits);
  if (gate.passes()) return std::nullopt;
  const std::string message = "determinism gate: " + monitor::explain(gate);
  if (options.determinism == "require") return message;
  console.note(message);
  return std::nullopt;
}

// Whether the trace is there as a whole. A pipe may go on for as long as the system runs.
bool is_file(const std::string& trace) {
  struct stat status {};
  const bool is_known =
      trace == "-" ? fstat(STDIN_FILENO, &status) == 0 : stat(trace.c_str(), &status) == 0;
  return is_known && S_ISREG(status.st_mode);
}

void print_report(const Options& options, const monitor::RunResult& result,
                  const monitor::RunSubject& subject, Console& console) {
  console.result(options.format == "json" ? monitor::to_json(result, subject) + '\n'
                                          : monitor::to_text(result, subject));
}

// There is no verdict, and the trace was not looked at.
ExitCode report_inconclusive(const Options& options, const monitor::RunSubject& subject,
                             std::string reason, Console& console) {
  monitor::RunResult result;
  result.verdict = monitor::RunVerdict::inconclusive;
  result.reason = std::move(reason);
  print_report(options, result, subject, console);
  return ExitCode::inconclusive;
}

ExitCode run_monitor(const Options& options, Console& console) {
  Input input;
  const std::optional<Task> task = task_from(options, input, console);
  if (!task) return input.failure(ExitCode::usage);
  Events events;
  if (!load_events(*task, input, events)) {
    console.print(input.diagnostics, input.sources);
    return input.failure(ExitCode::usage);
  }

  const auto start = std::chrono::steady_clock::now();
  const base::Limits limits = options.budget.limits();
  ExitCode code = ExitCode::ok;
  const auto script = load_script(task->model, input, console, code);
  if (script == nullptr) return code;
  // Positions in the model are told by name.
  script->set_leaf_compression(semantics::LeafCompression::none);
  const auto built =
      build_lts(*script, task->process, task->process_origin, limits, input, console, code);
  if (!built) return code;
  monitor::RunSubject subject;
  subject.name = task->name;
  subject.model = task->model;
  subject.process = task->process;
  subject.trace = task->trace;
  subject.mode = task->mode;
  if (built->limit) {
    subject.states = built->lts.state_count();
    subject.transitions = built->lts.edge_count();
    return report_inconclusive(
        options, subject,
        fmt::format("{} while the model was explored", base::describe(*built->limit)), console);
  }

  std::optional<lts::Lts> hidden;
  if (task->visible_channels) {
    const auto visible =
        monitor::resolve_channels(*task->visible_channels, events.map ? &*events.map : nullptr,
                                  script->channel_names(), input.diagnostics);
    console.print(input.diagnostics, input.sources);
    if (!visible) return ExitCode::usage;
    hidden =
        lts::hide(built->lts, monitor::labels_not_of_channels(built->lts.label_names(), *visible));
  }
  const lts::Lts& process = hidden ? *hidden : built->lts;
  subject.states = process.state_count();
  subject.transitions = process.edge_count();
  if (const auto failed = failed_gate(options, *task, built->lts, events, limits, console)) {
    return report_inconclusive(options, subject, *failed, console);
  }
  lts::Normalisation normalisation = lts::normalise(process, {.limits = limits});
  if (normalisation.limit) {
    return report_inconclusive(
        options, subject,
        fmt::format("{} while the model was normalised", base::describe(*normalisation.limit)),
        console);
  }
  const monitor::MonitorModel model = monitor::make_monitor_model(std::move(normalisation.normal));
  subject.synthesis_seconds = seconds_since(start);

  monitor::TraceReport trace_report{task->trace, input.sources, input.diagnostics};
  const auto format = options.trace_format == "auto"
                          ? monitor::TraceFormat::automatic
                          : *monitor::trace_format_from_name(options.trace_format);
  monitor::TraceReaderOptions reading = monitor::reader_options(events.sources(), format);
  reading.cancelled = &interrupted();
  auto reader = monitor::open_trace(task->trace, reading, trace_report);
  if (reader == nullptr) {
    console.print(input.diagnostics, input.sources);
    return ExitCode::io_error;
  }
  monitor::EventStream stream(std::move(reader), events.sources(), trace_report);
  const auto rest =
      is_file(task->trace) ? monitor::RestOfTrace::count : monitor::RestOfTrace::leave;
  const monitor::RunResult result = monitor::run_trace(stream, model, task->mode, rest);
  console.print(input.diagnostics, input.sources);
  for (const lts::State state : result.model_states) {
    subject.model_position.push_back(script->show(built->term(state)));
  }
  print_report(options, result, subject, console);
  if (result.verdict == monitor::RunVerdict::violation) return ExitCode::refuted;
  return stream.failed() ? ExitCode::io_error : ExitCode::ok;
}

}  // namespace

Command add_monitor(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* app =
      program.add_subcommand("monitor", "Check a trace of a system against a process of a model");
  app->add_option("CONFIG", options->config,
                  "A Varanus configuration (YAML); paths in it are relative to its folder");
  app->add_option("--model", options->model, "The CSPM script")->group("What to monitor");
  app->add_option("--process", options->process, "The process: a name or an expression")
      ->type_name("EXPR")
      ->group("What to monitor");
  app->add_option("--trace", options->trace,
                  "The trace: JSON lines, a JSON array, or one event a line; - is standard input")
      ->group("What to monitor");
  app->add_option("--trace-format", options->trace_format, "auto, json-lines, json-array or text")
      ->check(CLI::IsMember({"auto", "json-lines", "json-array", "text"}))
      ->capture_default_str()
      ->group("What to monitor");
  app->add_option("--alphabet", options->alphabet,
                  "The channels (or events) that the system shows; all others are hidden")
      ->delimiter(',')
      ->type_name("NAME,..")
      ->group("What to monitor");
  app->add_option("--map", options->map,
                  "Event map (JSON): names of the system to names of the model")
      ->group("From messages to events");
  app->add_option(
         "--mapping", options->mapping,
         "How messages become events: a file (docs/mapping.md), or simple or varanus-rover")
      ->group("From messages to events");
  app->add_option("--mode", options->mode,
                  "strict: an event outside the model's alphabet is a violation; permissive\n"
                  "(default): it is ignored")
      ->check(CLI::IsMember({"strict", "permissive"}));
  app->add_option("--determinism", options->determinism,
                  "Varanus's determinism gate, for configurations with both alphabets: ignore it,\n"
                  "warn, or require it. Verdicts do not need it")
      ->check(CLI::IsMember({"ignore", "warn", "require"}))
      ->capture_default_str();
  app->add_option("--format", options->format, "text or json (perentie.monitor/1)")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  options->budget.add_to(*app);
  app->footer(
      "Examples:\n"
      "  perentie monitor corpus/rover/pass.yaml\n"
      "  perentie monitor corpus/rover/red_ignored.yaml --format json\n"
      "  perentie monitor --model corpus/rover/rover.csp --process ROVER_SYSTEM \\\n"
      "      --trace corpus/rover/swapped.jsonl --mode strict");
  return {app, [options](Console& console) { return run_monitor(*options, console); }};
}

}  // namespace perentie::cli

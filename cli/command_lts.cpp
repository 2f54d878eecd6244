// perentie lts: the labelled transition system of a process, as a file.
#include <fstream>
#include <iostream>
#include <memory>

#include <fmt/format.h>

#include "commands.hpp"
#include "model.hpp"
#include "perentie/base/text.hpp"
#include "perentie/lts/aut.hpp"
#include "perentie/lts/dot.hpp"
#include "perentie/lts/json.hpp"
#include "perentie/lts/normalise.hpp"

namespace perentie::cli {
namespace {

struct Options {
  std::string file;
  std::string process;
  std::string output = "-";
  std::string format;
  std::string tau = "tau";
  bool normal = false;
  bool state_names = false;
  BudgetOptions budget;
};

// The format that is asked for, or that the name of the output file implies.
std::string format_of(const Options& options) {
  if (!options.format.empty()) return options.format;
  const std::size_t dot = options.output.rfind('.');
  const std::string extension = dot == std::string::npos ? "" : options.output.substr(dot + 1);
  for (const char* known : {"aut", "dot", "json"}) {
    if (extension == known) return extension;
  }
  return extension == "gv" ? "dot" : "aut";
}

void write(std::ostream& out, const lts::Lts& graph, const Options& options,
           const std::function<std::string(lts::State)>& state_name) {
  const std::string format = format_of(options);
  if (format == "aut") {
    lts::write_aut(out, graph, {.tau = options.tau});
  } else if (format == "dot") {
    lts::write_dot(out, graph, {.state_name = state_name});
  } else {
    lts::write_json(out, graph, {.state_name = state_name});
  }
}

ExitCode write_output(const lts::Lts& graph, const Options& options,
                      const std::function<std::string(lts::State)>& state_name, Console& console) {
  if (options.output == "-") {
    write(std::cout, graph, options, state_name);
    std::cout.flush();
    return std::cout ? ExitCode::ok : ExitCode::io_error;
  }
  std::ofstream out(options.output, std::ios::binary);
  if (out) write(out, graph, options, state_name);
  out.close();
  if (!out) {
    console.error(fmt::format("cannot write `{}`", options.output));
    return ExitCode::io_error;
  }
  return ExitCode::ok;
}

ExitCode make_lts(const Options& options, Console& console) {
  Input input;
  ExitCode code = ExitCode::ok;
  const auto script = load_script(options.file, input, console, code);
  if (script == nullptr) return code;
  const base::Limits limits = options.budget.limits();
  const auto built = build_lts(*script, options.process, "--process", limits, input, console, code);
  if (!built) return code;
  std::optional<base::LimitReached> limit = built->limit;
  std::optional<lts::Normalisation> normalised;
  if (options.normal && !limit) {
    normalised = lts::normalise(built->lts(), {.limits = limits});
    limit = normalised->limit;
  }
  const lts::Lts& graph = normalised ? normalised->normal.lts : built->lts();
  console.note(fmt::format("{} states, {} transitions{}", base::with_thousands(graph.state_count()),
                           base::with_thousands(graph.edge_count()), limit ? " so far" : ""));
  if (limit) {
    console.error(fmt::format("inconclusive: {}; nothing was written", base::describe(*limit)));
    return ExitCode::inconclusive;
  }
  std::function<std::string(lts::State)> state_name;
  if (options.state_names && !options.normal) {
    state_name = [&](lts::State s) { return script->show(built->exploration.states[s.value]); };
  }
  return write_output(graph, options, state_name, console);
}

}  // namespace

Command add_lts(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* app =
      program.add_subcommand("lts", "Write the labelled transition system of a process");
  app->add_option("FILE", options->file, "The CSPM script")->required();
  app->add_option("-p,--process", options->process, "The process: a name or an expression")
      ->required()
      ->type_name("EXPR");
  app->add_option("-o,--output", options->output, "Where to write; - is standard output")
      ->capture_default_str();
  app->add_option("-f,--format", options->format,
                  "aut, dot or json; default: by the name of the output, else aut")
      ->check(CLI::IsMember({"aut", "dot", "json"}));
  app->add_option("--tau", options->tau, "The word for the invisible event in .aut files")
      ->check(CLI::IsMember({"tau", "i"}))
      ->capture_default_str();
  app->add_flag("--normal", options->normal,
                "Normalise: deterministic and without invisible events");
  app->add_flag("--state-names", options->state_names,
                "Write the process term of each state (dot and json)");
  options->budget.add_to(*app);
  app->footer(
      "Examples:\n"
      "  perentie lts corpus/rover/rover.csp -p ROVER_SYSTEM -o rover.aut\n"
      "  perentie lts corpus/rover/rover.csp -p 'ROVER_ABORT' -o - -f dot --state-names | dot "
      "-Tsvg");
  return {app, [options](Console& console) { return make_lts(*options, console); }};
}

}  // namespace perentie::cli

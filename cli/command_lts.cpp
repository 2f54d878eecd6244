// perentie lts: the labelled transition system of a process or of an .aut file, compressed if
// wanted, as a file.
#include <fstream>
#include <iostream>
#include <memory>
#include <variant>

#include <fmt/format.h>

#include "commands.hpp"
#include "model.hpp"
#include "perentie/base/text.hpp"
#include "perentie/lts/aut.hpp"
#include "perentie/lts/compressions.hpp"
#include "perentie/lts/dot.hpp"
#include "perentie/lts/fsm.hpp"
#include "perentie/lts/graphml.hpp"
#include "perentie/lts/json.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/lts/weak_bisimulation.hpp"

namespace perentie::cli {
namespace {

struct Options {
  std::string file;
  std::string process;
  std::string output = "-";
  std::string format;
  std::string tau = "tau";
  std::string compression;
  std::string leaf_compression = "none";
  bool normal = false;
  bool stats = false;
  bool state_names = false;
  BudgetOptions budget;
};

// The format that is asked for, or that the name of the output file implies.
std::string format_of(const Options& options) {
  if (!options.format.empty()) return options.format;
  const std::size_t dot = options.output.rfind('.');
  const std::string extension = dot == std::string::npos ? "" : options.output.substr(dot + 1);
  for (const char* known : {"aut", "dot", "json", "fsm", "graphml"}) {
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
  } else if (format == "fsm") {
    lts::write_fsm(out, graph);
  } else if (format == "graphml") {
    lts::write_graphml(out, graph, {.state_name = state_name});
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

std::string size_of(const lts::Lts& graph) {
  return fmt::format("{} states, {} transitions", base::with_thousands(graph.state_count()),
                     base::with_thousands(graph.edge_count()));
}

/// A graph, or the budget that ran out.
using Compressed = std::variant<lts::Lts, base::LimitReached>;

Compressed graph_of(lts::QuotientResult result) {
  if (const auto* limit = std::get_if<base::LimitReached>(&result)) return *limit;
  return std::get<lts::Quotient>(std::move(result)).lts;
}

Compressed graph_of(lts::GeneralisedResult result) {
  if (const auto* limit = std::get_if<base::LimitReached>(&result)) return *limit;
  return std::get<lts::GeneralisedLts>(std::move(result)).lts;
}

Compressed compress(const lts::Lts& graph, const std::string& compression,
                    const base::Limits& limits) {
  if (compression == "sbisim") return lts::strong_bisimulation(graph).lts;
  if (compression == "dbisim") return graph_of(lts::delay_bisimulation(graph, limits));
  if (compression == "wbisim") return graph_of(lts::weak_bisimulation(graph, limits));
  if (compression == "tau_loop_factor") return lts::tau_loop_factor(graph).lts;
  if (compression == "diamond") return graph_of(lts::diamond(graph, limits));
  return graph_of(lts::normal(graph, limits));
}

ExitCode inconclusive(const base::LimitReached& limit, Console& console) {
  console.error(fmt::format("inconclusive: {}; nothing was written", base::describe(limit)));
  return ExitCode::inconclusive;
}

/// Compresses or normalises as asked for, and writes the graph. `state_name` is for the graph as it
/// comes.
ExitCode finish(const lts::Lts& graph, const Options& options,
                const std::function<std::string(lts::State)>& state_name, Console& console) {
  const base::Limits limits = options.budget.limits();
  if (options.compression.empty() && !options.normal) {
    console.note(size_of(graph));
    return write_output(graph, options, state_name, console);
  }
  Compressed result = base::LimitReached{};
  if (options.normal) {
    lts::Normalisation normalised = lts::normalise(graph, {.limits = limits});
    if (normalised.limit) return inconclusive(*normalised.limit, console);
    result = std::move(normalised.normal.lts);
  } else {
    result = compress(graph, options.compression, limits);
  }
  if (const auto* limit = std::get_if<base::LimitReached>(&result)) {
    return inconclusive(*limit, console);
  }
  const lts::Lts& small = std::get<lts::Lts>(result);
  console.note(fmt::format("{}; {}: {}", size_of(graph),
                           options.normal ? "normalised" : options.compression, size_of(small)));
  return write_output(small, options, {}, console);
}

/// What the process is made of, as FDR's "machine structure" shows it.
std::string statistics(const semantics::MachineStructure& machine, const std::string& whole,
                       const semantics::Script& script) {
  const auto number = [](std::uint64_t n) { return base::with_thousands(n); };
  std::string text;
  if (machine.is_compiled) {
    text += fmt::format("machine: compiled, {} rules, {} bytes a state\n", number(machine.rules),
                        8 * machine.words);
    text += fmt::format("leaves: {}, {} different\n", number(machine.leaf_kinds.size()),
                        number(machine.leaf_sizes.size()));
    std::vector<std::size_t> times(machine.leaf_sizes.size());
    for (const std::uint32_t kind : machine.leaf_kinds) ++times[kind];
    for (std::size_t k = 0; k < times.size(); ++k) {
      const semantics::LeafSize& leaf = machine.leaf_sizes[k];
      text += fmt::format("  {} x {}: {} states, {} transitions", times[k],
                          script.show(leaf.process, 60), number(leaf.explored_states),
                          number(leaf.explored_edges));
      if (leaf.states != leaf.explored_states) {
        text += fmt::format("; compressed: {} states, {} transitions", number(leaf.states),
                            number(leaf.edges));
      }
      text += '\n';
    }
  } else {
    text += fmt::format("machine: made as it is explored, {} formats, {} states of leaves\n",
                        number(machine.formats), number(machine.leaf_states));
  }
  return text + fmt::format("whole: {}\n", whole);
}

bool is_aut(const std::string& path) {
  return path.size() > 4 && path.compare(path.size() - 4, 4, ".aut") == 0;
}

ExitCode convert_aut(const Options& options, Console& console) {
  if (!options.process.empty()) {
    console.error("an .aut file is one process: --process has no meaning for it");
    return ExitCode::usage;
  }
  if (options.state_names) {
    console.error("the states of an .aut file have no terms: --state-names has no meaning for it");
    return ExitCode::usage;
  }
  if (options.stats) {
    console.error("a graph is no machine: --stats has no meaning for an .aut file");
    return ExitCode::usage;
  }
  Input input;
  const auto file = input.read(options.file);
  std::optional<lts::Lts> graph;
  if (file) {
    graph = lts::read_aut(options.file, input.sources.text(*file), input.sources, input.diagnostics,
                          {.tau = options.tau});
  }
  console.print(input.diagnostics, input.sources);
  if (!graph) return ExitCode::io_error;
  return finish(*graph, options, {}, console);
}

ExitCode make_lts(const Options& options, Console& console) {
  if (is_aut(options.file)) return convert_aut(options, console);
  if (options.process.empty()) {
    console.error("a script has many processes: --process says which one is meant");
    return ExitCode::usage;
  }
  Input input;
  ExitCode code = ExitCode::ok;
  const auto script = load_script(options.file, input, console, code);
  if (script == nullptr) return code;
  const base::Limits limits = options.budget.limits();
  script->set_leaf_compression(leaf_compression_of(options.leaf_compression));
  if (options.stats && options.output == "-") {
    const auto size =
        count_lts(*script, options.process, "--process", limits, input, console, code);
    if (!size) return code;
    if (size->limit) {
      console.note(fmt::format("{} states so far", base::with_thousands(size->states)));
      return inconclusive(*size->limit, console);
    }
    const std::string whole =
        fmt::format("{} states, {} transitions, repeated ones included",
                    base::with_thousands(size->states), base::with_thousands(size->transitions));
    console.result(statistics(size->structure, whole, *script));
    return ExitCode::ok;
  }
  const auto built = build_lts(*script, options.process, "--process", limits, input, console, code);
  if (!built) return code;
  if (built->limit) {
    console.note(size_of(built->lts) + " so far");
    return inconclusive(*built->limit, console);
  }
  if (options.stats) {
    console.result(statistics(built->structure, size_of(built->lts), *script));
  }
  std::function<std::string(lts::State)> state_name;
  if (options.state_names) {
    state_name = [&](lts::State s) { return script->show(built->term(s)); };
  }
  return finish(built->lts, options, state_name, console);
}

}  // namespace

Command add_lts(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* app =
      program.add_subcommand("lts", "Write the labelled transition system of a process");
  app->add_option("FILE", options->file, "The CSPM script, or a graph in an .aut file")->required();
  app->add_option("-p,--process", options->process,
                  "The process of a script: a name or an expression")
      ->type_name("EXPR");
  app->add_option("-o,--output", options->output, "Where to write; - is standard output")
      ->capture_default_str();
  app->add_option("-f,--format", options->format,
                  "aut, dot, json, fsm or graphml; default: by the name of the output, else aut")
      ->check(CLI::IsMember({"aut", "dot", "json", "fsm", "graphml"}));
  app->add_option("--tau", options->tau, "The word for the invisible event in .aut files")
      ->check(CLI::IsMember({"tau", "i"}))
      ->capture_default_str();
  app->add_option("--compress", options->compression,
                  "sbisim, dbisim, wbisim, tau_loop_factor, diamond or normal")
      ->check(
          CLI::IsMember({"sbisim", "dbisim", "wbisim", "tau_loop_factor", "diamond", "normal"}));
  app->add_flag("--normal", options->normal,
                "Normalise: deterministic and without invisible events")
      ->excludes("--compress");
  app->add_flag("--state-names", options->state_names,
                "Write the process term of each state (dot, json and graphml)");
  app->add_option(
         "--compress-leaves", options->leaf_compression,
         "none, sbisim or wbisim: what is done with the processes below the parallel operators")
      ->check(CLI::IsMember({"none", "sbisim", "wbisim"}))
      ->capture_default_str();
  app->add_flag("--stats", options->stats,
                "Print what the process is made of; the graph is written only with --output");
  options->budget.add_to(*app);
  app->footer(
      "Examples:\n"
      "  perentie lts corpus/rover/rover.csp -p ROVER_SYSTEM -o rover.aut\n"
      "  perentie lts corpus/rover/rover.csp -p 'ROVER_ABORT' -o - -f dot --state-names | dot "
      "-Tsvg");
  return {app, [options](Console& console) { return make_lts(*options, console); }};
}

}  // namespace perentie::cli

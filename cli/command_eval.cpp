// perentie eval: the value of an expression in the scope of a script.
#include <memory>

#include <fmt/format.h>

#include "commands.hpp"
#include "model.hpp"

namespace perentie::cli {
namespace {

struct Options {
  std::string file;
  std::vector<std::string> expressions;
  std::vector<std::string> processes;
  BudgetOptions budget;
};

// The text of an expression's value, or of a process with its definitions.
std::optional<std::string> text_of(semantics::Script& script, const std::string& expression,
                                   bool is_process, Input& input) {
  if (!is_process) return script.evaluate(expression, input.diagnostics);
  const auto process = script.process(expression, input.diagnostics);
  if (!process) return std::nullopt;
  return script.definitions(*process, input.diagnostics);
}

ExitCode evaluate(const Options& options, Console& console) {
  if (options.expressions.empty() && options.processes.empty()) {
    console.error("there is nothing to evaluate: --expression or --process is needed");
    return ExitCode::usage;
  }
  Input input;
  ExitCode code = ExitCode::ok;
  const auto script = load_script(options.file, input, console, code);
  if (script == nullptr) return code;
  script->set_limits(options.budget.limits());
  code = ExitCode::ok;
  const std::size_t count = options.expressions.size() + options.processes.size();
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_process = i >= options.expressions.size();
    const std::string& expression =
        is_process ? options.processes[i - options.expressions.size()] : options.expressions[i];
    const auto text = text_of(*script, expression, is_process, input);
    console.print(input.diagnostics, input.sources);
    if (text) {
      console.result(*text + '\n');
    } else if (const auto limit = script->limit()) {
      console.error(fmt::format("inconclusive: {}", base::describe(*limit)));
      code = ExitCode::inconclusive;
    } else {
      code = ExitCode::model_error;
    }
  }
  return code;
}

}  // namespace

Command add_eval(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand("eval", "Evaluate expressions in the scope of a script");
  app->add_option("FILE", options->file, "The CSPM script")->required();
  app->add_option("-e,--expression", options->expressions,
                  "The expression; may be given several times")
      ->type_name("EXPR");
  app->add_option("-p,--process", options->processes,
                  "A process, to be shown with the definitions that it leads to")
      ->type_name("EXPR");
  options->budget.add_to(*app);
  app->footer(
      "Example:\n"
      "  perentie eval corpus/rover/rover.csp -e 'card(waypointID)' -e '{| move |}'\n"
      "  perentie eval corpus/rover/rover.csp -p ROVER_ABORT");
  return {app, [options](Console& console) { return evaluate(*options, console); }};
}

}  // namespace perentie::cli

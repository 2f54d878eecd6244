// perentie eval: the value or the type of an expression in the scope of a script.
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
  std::vector<std::string> typed;
  bool call_stack = false;
  BudgetOptions budget;
};

// A process with the definitions that it leads to.
std::optional<std::string> process_text(semantics::Script& script, const std::string& expression,
                                        base::Diagnostics& diagnostics) {
  const auto process = script.process(expression, diagnostics);
  if (!process) return std::nullopt;
  return script.definitions(*process, diagnostics);
}

ExitCode evaluate(const Options& options, Console& console) {
  if (options.expressions.empty() && options.processes.empty() && options.typed.empty()) {
    console.error("there is nothing to evaluate: --expression, --process or --type is needed");
    return ExitCode::usage;
  }
  Input input;
  ExitCode code = ExitCode::ok;
  const auto script = load_script(options.file, input, console, code);
  if (script == nullptr) return code;
  script->set_limits(options.budget.limits());
  script->show_calls(options.call_stack);
  code = ExitCode::ok;
  const auto answer = [&](const std::optional<std::string>& text) {
    console.print(input.diagnostics, input.sources);
    if (text) {
      console.result(*text + '\n');
    } else if (const auto limit = script->limit()) {
      console.error(fmt::format("inconclusive: {}", base::describe(*limit)));
      code = ExitCode::inconclusive;
    } else {
      code = ExitCode::model_error;
    }
  };
  for (const std::string& expression : options.expressions) {
    answer(script->evaluate(expression, input.diagnostics));
  }
  for (const std::string& process : options.processes) {
    answer(process_text(*script, process, input.diagnostics));
  }
  for (const std::string& expression : options.typed) {
    const auto read = script->expression(expression, input.diagnostics);
    answer(read ? std::optional(script->type_of(*read)) : std::nullopt);
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
  app->add_option("-t,--type", options->typed, "An expression whose type is to be shown")
      ->type_name("EXPR");
  app->add_flag("--call-stack", options->call_stack,
                "With errors, show the calls that led to them");
  options->budget.add_to(*app);
  app->footer(
      "Example:\n"
      "  perentie eval corpus/rover/rover.csp -e 'card(waypointID)' -e '{| move |}'\n"
      "  perentie eval corpus/rover/rover.csp -p ROVER_ABORT\n"
      "  perentie eval corpus/rover/rover.csp -t '{| move |}'");
  return {app, [options](Console& console) { return evaluate(*options, console); }};
}

}  // namespace perentie::cli

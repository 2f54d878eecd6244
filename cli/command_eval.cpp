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
  BudgetOptions budget;
};

ExitCode evaluate(const Options& options, Console& console) {
  Input input;
  ExitCode code = ExitCode::ok;
  const auto script = load_script(options.file, input, console, code);
  if (script == nullptr) return code;
  script->set_limits(options.budget.limits());
  code = ExitCode::ok;
  for (const std::string& expression : options.expressions) {
    const auto text = script->evaluate(expression, input.diagnostics);
    console.print(input.diagnostics, input.sources);
    if (text) {
      fmt::print("{}\n", *text);
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
      ->required()
      ->type_name("EXPR");
  options->budget.add_to(*app);
  app->footer(
      "Example:\n"
      "  perentie eval corpus/rover/rover.csp -e 'card(waypointID)' -e '{| move |}'");
  return {app, [options](Console& console) { return evaluate(*options, console); }};
}

}  // namespace perentie::cli

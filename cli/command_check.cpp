// perentie check: the assertions of a script, in the order of the file.
#include <algorithm>
#include <cstdint>
#include <memory>

#include <fmt/format.h>

#include "check_report.hpp"
#include "commands.hpp"
#include "model.hpp"

namespace perentie::cli {
namespace {

using Outcome = semantics::CheckResult::Outcome;

struct Options {
  std::string file;
  std::vector<std::int64_t> numbers;
  std::string format = "text";
  bool explain = false;
  std::size_t jobs = processor_count();
  std::string leaf_compression = "sbisim";
  bool call_stack = false;
  BudgetOptions budget;
};

// The numbers to check, from 1: all, unless some were chosen.
std::optional<std::vector<std::size_t>> chosen(const Options& options, std::size_t count,
                                               const Console& console) {
  std::vector<std::size_t> numbers;
  if (options.numbers.empty()) {
    for (std::size_t n = 1; n <= count; ++n) numbers.push_back(n);
  }
  for (const std::int64_t n : options.numbers) {
    numbers.push_back(static_cast<std::size_t>(n));
    if (n >= 1 && numbers.back() <= count) continue;
    console.error(fmt::format("there is no assertion {}: the script has {}", n, count));
    return std::nullopt;
  }
  return numbers;
}

// The values of the script's `print` lines: on standard output, or into the report.
ExitCode show_prints(CheckRun& run, const Options& options, Console& console, CheckReport& report) {
  ExitCode code = ExitCode::ok;
  for (const semantics::ScriptPrint& print : run.prints()) {
    if (!print.expression) continue;  // its text does not parse, which was reported
    PrintedValue printed = run.evaluate(print, options.budget.limits());
    console.forget_printed();
    console.print(printed.diagnostics, report.sources);
    if (!printed.value) {
      code = worse(code, printed.limit ? Outcome::inconclusive : Outcome::error);
      if (printed.limit) {
        console.error(fmt::format("inconclusive: {}", base::describe(*printed.limit)));
      }
    } else if (options.format == "text") {
      console.result(print_as_text(printed));
    }
    report.prints.push_back(std::move(printed));
  }
  return code;
}

void write_document(const Options& options, const CheckReport& report, const Console& console) {
  if (options.format == "json") console.result(as_json(report));
  if (options.format == "junit") console.result(as_junit(report));
  if (options.format == "sarif") console.result(as_sarif(report));
  if (options.format == "markdown") console.result(as_markdown(report));
}

ExitCode run(const Options& options, Console& console) {
  Input input;
  CheckReport report{.sources = input.sources, .file = options.file, .explained = options.explain};
  const auto script = CheckRun::load(options.file, input);
  console.print(input.diagnostics, input.sources);
  if (script == nullptr) {
    report.load_errors = input.diagnostics;
    write_document(options, report, console);
    return input.failure(ExitCode::model_error);
  }
  const auto numbers = chosen(options, script->assertions().size(), console);
  if (!numbers) return ExitCode::usage;
  if (script->assertions().empty() && script->prints().empty()) {
    console.note("the script has no assertions and no prints");
  }
  ExitCode code =
      options.numbers.empty() ? show_prints(*script, options, console, report) : ExitCode::ok;
  CheckOptions checks{.limits = options.budget.limits(),
                      .jobs = options.jobs,
                      .explain = options.explain,
                      .with_components = true,
                      .leaf_compression = leaf_compression_of(options.leaf_compression),
                      .show_calls = options.call_stack,
                      .progress = {}};
  checks.progress = [&console](const lts::ExploreProgress& p) { console.progress(p); };
  script->check(*numbers, checks, [&](CheckedAssertion checked) {
    console.forget_printed();
    console.print(checked.diagnostics, input.sources);
    code = worse(code, checked.result.outcome);
    if (options.format == "text") {
      console.result(assertion_as_text(checked, report));
    } else {
      report.assertions.push_back(std::move(checked));
    }
    return !interrupted().load();
  });
  for (const std::string& compression : script->compressions_given_up()) {
    console.note(compression_given_up(compression));
  }
  write_document(options, report, console);
  return code;
}

}  // namespace

Command add_check(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand("check", "Check the assertions of a script");
  app->add_option("FILE", options->file, "The CSPM script; `-` is standard input")->required();
  app->add_option("-a,--assertion", options->numbers,
                  "Only the assertion of this number, from 1; may be given several times")
      ->type_name("N");
  app->add_flag("--explain", options->explain,
                "Say what each step and each component does in a counterexample");
  app->add_option("--format", options->format, "text, json, junit, sarif or markdown")
      ->check(CLI::IsMember({"text", "json", "junit", "sarif", "markdown"}))
      ->capture_default_str();
  app->add_option("-j,--jobs", options->jobs,
                  "How many assertions are checked side by side; default: one for each processor")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1024}))
      ->type_name("N");
  app->add_option(
         "--compress-leaves", options->leaf_compression,
         "none, sbisim or wbisim: what is done with the processes below the parallel operators; "
         "no outcome depends on it")
      ->check(CLI::IsMember({"none", "sbisim", "wbisim"}))
      ->capture_default_str();
  app->add_flag("--call-stack", options->call_stack,
                "Show the calls that led to an error of the script");
  options->budget.add_to(*app);
  app->footer(
      "Examples:\n"
      "  perentie check corpus/check/forms.csp\n"
      "  perentie check corpus/check/forms.csp -a 2 --explain\n"
      "  perentie check corpus/check/forms.csp --format junit > forms.xml\n"
      "\n"
      "The budgets are those of each assertion; those that are checked side by side share the\n"
      "memory.\n"
      "Exit codes: 0 all hold; 1 one fails; 3 one cannot be checked; 4 none fails, but a budget\n"
      "ran out.");
  return {app, [options](Console& console) { return run(*options, console); }};
}

}  // namespace perentie::cli

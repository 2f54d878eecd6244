// perentie check: the assertions of a script, in the order of the file.
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "model.hpp"
#include "perentie/base/text.hpp"
#include "perentie/semantics/check.hpp"

namespace perentie::cli {
namespace {

using Json = nlohmann::ordered_json;
using semantics::CheckResult;
using semantics::Witness;
using Outcome = CheckResult::Outcome;

struct Options {
  std::string file;
  std::vector<std::size_t> numbers;
  std::string format = "text";
  BudgetOptions budget;
};

std::string set_of(const std::vector<std::string>& events) {
  return fmt::format("{{{}}}", fmt::join(events, ", "));
}

// What the process does after the trace that it must not do.
std::string behaviour(const Witness& w) {
  switch (w.kind) {
    case Witness::Kind::event:
      return fmt::format("it performs {}", w.event);
    case Witness::Kind::acceptance:
      return fmt::format("it offers only {}", set_of(w.offered));
    case Witness::Kind::divergence:
      return "it diverges: it performs τ for ever";
    case Witness::Kind::deadlock:
      return !w.trace.empty() && w.trace.back() == lts::tick_name
                 ? "it has terminated, which counts as a deadlock"
                 : "it is deadlocked";
    case Witness::Kind::nondeterminism:
      return fmt::format("it may perform {} and may refuse it, offering only {}", w.event,
                         set_of(w.offered));
    case Witness::Kind::missing_event:
      return w.offered.empty()
                 ? fmt::format("it cannot perform {}", w.event)
                 : fmt::format("it may refuse {}, offering only {}", w.event, set_of(w.offered));
  }
  return {};
}

std::string expectation(const Witness& w) {
  if (w.kind == Witness::Kind::event && !w.allowed.empty()) {
    return fmt::format("the specification allows {}", set_of(w.allowed.front()));
  }
  if (w.kind != Witness::Kind::acceptance) return {};
  std::vector<std::string> sets;
  for (const auto& acceptance : w.allowed) sets.push_back(set_of(acceptance));
  return sets.empty()
             ? "the specification is never stable here"
             : fmt::format("the specification offers at least {}", fmt::join(sets, " or "));
}

std::string as_text(std::size_t number, std::size_t line, const std::string& assertion,
                    const CheckResult& result) {
  std::string text =
      fmt::format("{}. {}: {}  (line {}; {} states, {} transitions, {:.2f} s)\n", number, assertion,
                  name_of(result.outcome), line, base::with_thousands(result.counts.states),
                  base::with_thousands(result.counts.transitions), result.seconds);
  if (result.limit) text += fmt::format("   {}\n", base::describe(*result.limit));
  if (!result.witness) return text;
  const Witness& w = *result.witness;
  text += fmt::format("   after <{}>\n   {}\n", fmt::join(w.trace, ", "), behaviour(w));
  if (const std::string allowed = expectation(w); !allowed.empty()) {
    text += fmt::format("   {}\n", allowed);
  }
  if (!w.state.empty()) text += fmt::format("   in the state {}\n", w.state);
  return text;
}

Json as_json(std::size_t line, const std::string& assertion, const CheckResult& result) {
  Json json{{"line", line},
            {"assertion", assertion},
            {"outcome", name_of(result.outcome)},
            {"visited_states", result.counts.states},
            {"visited_transitions", result.counts.transitions},
            {"visited_plys", result.counts.plys},
            {"seconds", result.seconds}};
  if (result.limit) json["limit"] = base::describe(*result.limit);
  if (result.witness) {
    const Witness& w = *result.witness;
    Json witness{{"kind", name_of(w.kind)}, {"trace", w.trace}};
    if (!w.event.empty()) witness["event"] = w.event;
    if (w.kind == Witness::Kind::acceptance || !w.offered.empty()) witness["offered"] = w.offered;
    if (!w.allowed.empty()) witness["allowed"] = w.allowed;
    if (!w.state.empty()) witness["state"] = w.state;
    json["counterexample"] = std::move(witness);
  }
  return json;
}

// The worst of the outcomes, as an exit code: an error, then a claim that fails, then none known.
ExitCode worse(ExitCode code, Outcome outcome) {
  constexpr ExitCode order[] = {ExitCode::ok, ExitCode::inconclusive, ExitCode::refuted,
                                ExitCode::model_error};
  const ExitCode own = outcome == Outcome::holds          ? ExitCode::ok
                       : outcome == Outcome::fails        ? ExitCode::refuted
                       : outcome == Outcome::inconclusive ? ExitCode::inconclusive
                                                          : ExitCode::model_error;
  return std::max(code, own, [&](ExitCode a, ExitCode b) {
    return std::ranges::find(order, a) < std::ranges::find(order, b);
  });
}

// The numbers to check, from 1: all, unless some were chosen.
std::optional<std::vector<std::size_t>> chosen(const Options& options, std::size_t count,
                                               const Console& console) {
  std::vector<std::size_t> numbers = options.numbers;
  if (numbers.empty()) {
    for (std::size_t n = 1; n <= count; ++n) numbers.push_back(n);
  }
  for (const std::size_t n : numbers) {
    if (n >= 1 && n <= count) continue;
    console.error(fmt::format("there is no assertion {}: the script has {}", n, count));
    return std::nullopt;
  }
  return numbers;
}

// The values of the script's `print` lines: on standard output, or into `list`.
ExitCode show_prints(semantics::Script& script, const Options& options, Input& input,
                     Console& console, Json& list) {
  ExitCode code = ExitCode::ok;
  for (const semantics::ScriptPrint& print : semantics::prints_of(script.tree())) {
    if (!print.expression) continue;  // its text does not parse, which was reported
    const auto value = script.evaluate(print.expression, input.diagnostics);
    console.print(input.diagnostics, input.sources);
    if (!value) {
      code = worse(code, script.limit() ? Outcome::inconclusive : Outcome::error);
      if (const auto limit = script.limit()) {
        console.error(fmt::format("inconclusive: {}", base::describe(*limit)));
      }
    } else if (options.format == "json") {
      list.push_back({{"line", input.sources.position(print.span.begin).line},
                      {"expression", print.text},
                      {"value", *value}});
    } else {
      console.result(fmt::format("print {}: {}\n", print.text, *value));
    }
  }
  return code;
}

ExitCode run(const Options& options, Console& console) {
  Input input;
  ExitCode code = ExitCode::ok;
  const auto script = load_script(options.file, input, console, code);
  if (script == nullptr) return code;
  const auto assertions = semantics::assertions_of(script->tree());
  const auto numbers = chosen(options, assertions.size(), console);
  if (!numbers) return ExitCode::usage;
  if (assertions.empty() && semantics::prints_of(script->tree()).empty())
    console.note("the script has no assertions and no prints");
  lts::ExploreOptions exploration{.limits = options.budget.limits()};
  exploration.progress = [&console](const lts::ExploreProgress& p) { console.progress(p); };
  script->set_limits(exploration.limits);
  Json prints = Json::array();
  code = options.numbers.empty() ? show_prints(*script, options, input, console, prints)
                                 : ExitCode::ok;
  Json list = Json::array();
  for (const std::size_t number : *numbers) {
    const semantics::ScriptAssertion& assertion = assertions[number - 1];
    const CheckResult result = semantics::check(*script, assertion, exploration, input.diagnostics);
    console.clear_progress();
    console.print(input.diagnostics, input.sources);
    code = worse(code, result.outcome);
    const std::size_t line = input.sources.position(assertion.span.begin).line;
    if (options.format == "json") {
      list.push_back(as_json(line, assertion.text, result));
    } else {
      console.result(as_text(number, line, assertion.text, result));
    }
    if (interrupted().load()) break;
  }
  for (const std::string& compression : script->compressions_taken_as_identity()) {
    console.note(
        fmt::format("`{}` is not applied yet: no outcome depends on it, the number of "
                    "states does",
                    compression));
  }
  if (options.format == "json") {
    const Json report{{"schema", "perentie.check/1"},
                      {"file", options.file},
                      {"prints", std::move(prints)},
                      {"assertions", std::move(list)}};
    console.result(report.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
  }
  return code;
}

}  // namespace

Command add_check(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand("check", "Check the assertions of a script");
  app->add_option("FILE", options->file, "The CSPM script")->required();
  app->add_option("-a,--assertion", options->numbers,
                  "Only the assertion of this number, from 1; may be given several times")
      ->type_name("N");
  app->add_option("--format", options->format, "text or json")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  options->budget.add_to(*app);
  app->footer(
      "Examples:\n"
      "  perentie check corpus/check/forms.csp\n"
      "  perentie check corpus/check/forms.csp -a 2 --format json\n"
      "\n"
      "Exit codes: 0 all hold; 1 one fails; 3 one cannot be checked; 4 none fails, but a budget\n"
      "ran out.");
  return {app, [options](Console& console) { return run(*options, console); }};
}

}  // namespace perentie::cli

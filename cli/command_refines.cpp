// perentie refines: FDR's `refines` for the scripts and programs that call it.
//
// Flags, layouts and exit codes are FDR's (CSPM reference 7.1-7.3); where FDR's are not known,
// docs/cli.md says what is done here.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>

#include "commands.hpp"
#include "fdr_options.hpp"
#include "fdr_report.hpp"
#include "model.hpp"
#include "version.hpp"

namespace perentie::cli {
namespace {

using Outcome = semantics::CheckResult::Outcome;

struct Options {
  std::vector<std::string> files;
  std::string format;
  FdrLayout layout;
  bool typecheck = false;
  bool strict_exit = false;
  std::string archive, remote, remote_path;
  FdrOptions fdr;
  BudgetOptions budget;

  bool is_text() const { return format == "plain" || format == "colour"; }
};

FdrDocument document_form(const std::string& format) {
  return format == "yaml"  ? FdrDocument::yaml
         : format == "xml" ? FdrDocument::xml
                           : FdrDocument::json;
}

// Colour is for terminals, unless it was asked for.
std::string default_format() {
  const char* no_colour = std::getenv("NO_COLOR");
  const bool refused = no_colour != nullptr && *no_colour != '\0';
  return isatty(STDOUT_FILENO) != 0 && !refused ? "colour" : "plain";
}

// One file: what is printed, and how its checks ended.
class FileRun {
 public:
  FileRun(const Options& options, const std::string& file, Console& console)
      : options_(options), console_(console), report_{.sources = input_.sources, .file = file} {}

  ExitCode run() {
    const auto script = CheckRun::load(report_.file, input_);
    report_.load_diagnostics = input_.diagnostics;
    if (options_.is_text()) {
      for (const base::Diagnostic& d : input_.diagnostics.all()) {
        console_.log(fdr_message(d, input_.sources) + '\n');
      }
    }
    if (script == nullptr || options_.typecheck) {
      write(report_);
      return script == nullptr ? input_.failure(ExitCode::model_error) : ExitCode::ok;
    }
    check(*script);
    for (const semantics::ScriptPrint& print : script->prints()) add(value_of(*script, print));
    if (!is_framed() && !options_.is_text()) console_.result(document(report_));
    for (const std::string& compression : script->compressions_given_up()) {
      log(compression_given_up(compression));
    }
    return code_;
  }

 private:
  bool is_framed() const { return options_.format == "framed_json"; }

  void log(const std::string& text) {
    if (!options_.layout.quiet) console_.note(text);
  }

  std::string document(const FdrReport& report) const {
    return fdr_document(report, options_.layout, document_form(options_.format));
  }

  void write(const FdrReport& report) {
    if (!options_.is_text()) console_.result(document(report));
  }

  void check(CheckRun& script) {
    std::vector<std::size_t> numbers;
    for (std::size_t n = 1; n <= script.assertions().size(); ++n) numbers.push_back(n);
    const auto workers = static_cast<unsigned>(
        std::min<std::size_t>(options_.fdr.workers.value_or(options_.budget.workers), max_workers));
    CheckOptions checks{.limits = options_.budget.limits(),
                        .jobs = workers,
                        .explain = options_.layout.counterexamples && !options_.layout.brief,
                        .with_components = options_.layout.divide,
                        .leaf_compression = leaf_compression_of(options_.fdr.leaf_compression),
                        .show_calls = options_.fdr.stack_traces,
                        .progress = {}};
    checks.limits.workers = workers;
    if (!options_.layout.quiet) {
      checks.progress = [this](const lts::ExploreProgress& p) { console_.progress(p); };
    }
    script.check(numbers, checks, [&](CheckedAssertion checked) {
      console_.clear_progress();
      note_outcome(checked.result.outcome);
      if (options_.is_text()) {
        console_.result(fdr_text(checked, options_.layout, input_.sources));
        if (options_.layout.brief) {  // the line has no room for them
          for (const std::string& error : fdr_errors(checked, input_.sources)) {
            console_.log(error + '\n');
          }
        }
      } else if (is_framed()) {
        FdrReport frame = empty_report();
        frame.assertions.push_back(std::move(checked));
        write(frame);
      } else {
        report_.assertions.push_back(std::move(checked));
      }
      return !interrupted().load();
    });
  }

  PrintedValue value_of(CheckRun& script, const semantics::ScriptPrint& print) const {
    if (!print.expression) return {&print, {}, {}, {}};
    return script.evaluate(print, options_.budget.limits());
  }

  void add(PrintedValue printed) {
    if (!printed.value) note_outcome(printed.limit ? Outcome::inconclusive : Outcome::error);
    if (options_.is_text()) {
      console_.result(fdr_text(printed, options_.layout, input_.sources));
    } else if (is_framed()) {
      FdrReport frame = empty_report();
      frame.prints.push_back(std::move(printed));
      write(frame);
    } else {
      report_.prints.push_back(std::move(printed));
    }
  }

  FdrReport empty_report() const {
    return {.sources = input_.sources,
            .file = report_.file,
            .load_diagnostics = report_.load_diagnostics};
  }

  void note_outcome(Outcome outcome) { code_ = worse(code_, outcome); }

  const Options& options_;
  Console& console_;
  Input input_;
  FdrReport report_;
  ExitCode code_ = ExitCode::ok;
};

// What FDR's program ends with. A document about errors is valid output (7.1.4); text about a
// script that cannot be read is not.
ExitCode fdr_exit_code(const Options& options, bool script_errors, ExitCode strict) {
  if (options.strict_exit) return strict;
  const bool fails = script_errors && (options.is_text() || options.typecheck);
  return fails ? ExitCode::refuted : ExitCode::ok;
}

ExitCode run(Options options, Console& console) {
  for (const auto& [value, name] :
       {std::pair{options.archive, "--archive"}, std::pair{options.remote, "--remote"},
        std::pair{options.remote_path, "--remote-path"}}) {
    if (value.empty()) continue;
    console.error(fmt::format("{} is not supported", name));
    return ExitCode::usage;
  }
  if (options.format.empty()) options.format = default_format();
  options.layout.colour = options.format == "colour";
  options.layout.counterexamples = options.fdr.track_history;
  if (!options.layout.quiet) {
    if (options.is_text()) {
      console.result(fmt::format("Perentie {} in place of FDR's refines\n", version));
    }
    if (options.fdr.desired_counterexamples > 1) {
      console.note("one counterexample is reported for each assertion");
    }
    if (!options.fdr.range_checks) console.note("range checks stay on");
  }
  bool script_errors = false;
  ExitCode strict = ExitCode::ok;
  for (const std::string& file : options.files) {
    const ExitCode code = FileRun(options, file, console).run();
    script_errors = script_errors || code == ExitCode::model_error || code == ExitCode::io_error;
    strict = worse(strict, code);
    if (interrupted().load()) break;
  }
  return fdr_exit_code(options, script_errors, strict);
}

}  // namespace

Command add_refines(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand("refines", "What FDR's refines does, for its users");
  app->add_option("FILES", options->files, "CSPM scripts; `-` is standard input")->required();
  app->add_option("-f,--format", options->format,
                  "colour, plain, json, framed_json, yaml or xml; default: colour on a terminal,\n"
                  "otherwise plain")
      ->check(CLI::IsMember({"colour", "plain", "json", "framed_json", "yaml", "xml"}));
  app->add_flag("-b,--brief", options->layout.brief, "One line for each assertion");
  app->add_flag("-d,--divide", options->layout.divide, "Counterexamples with their components");
  app->add_flag("-q,--quiet", options->layout.quiet, "No log");
  app->add_flag("--reveal-taus", options->layout.reveal_taus,
                "Counterexamples with the events that were hidden");
  app->add_flag("-t,--typecheck", options->typecheck, "Check the types of the files only");
  app->add_flag("--strict-exit", options->strict_exit,
                "End with the exit codes of `perentie check`, not with FDR's");
  app->add_flag_callback(
      "-v,--version", [] { throw CLI::CallForVersion(fmt::format("Perentie {}", version), 0); },
      "Print the version and exit");
  for (const auto& [name, value] :
       {std::pair{"--archive", &options->archive}, std::pair{"--remote", &options->remote},
        std::pair{"--remote-path", &options->remote_path}}) {
    app->add_option(name, *value, "Not supported")->group("");
  }
  add_fdr_options(*app, options->fdr);
  options->budget.add_to(*app);
  app->footer(
      "Examples:\n"
      "  perentie refines --brief --quiet corpus/check/philosophers.csp\n"
      "  perentie refines --format json corpus/check/philosophers.csp\n"
      "\n"
      "Installed or called under the name `refines`, the program is this subcommand.\n"
      "Exit codes are FDR's: 0 also if an assertion fails, and also if a script has errors, if "
      "the\n"
      "format is not text; 1 errors of a script; 2 wrong flags.");
  return {app, [options](Console& console) { return run(*options, console); }};
}

}  // namespace perentie::cli

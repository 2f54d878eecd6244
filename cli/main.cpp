// The `perentie` program: reads the command line and runs one subcommand.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "version.hpp"

namespace perentie::cli {
namespace {

constexpr const char* description =
    "perentie: machine-readable CSP (CSPM) without FDR.\n"
    "Type-checks and evaluates models, checks their assertions, builds their labelled transition\n"
    "systems, and monitors running systems and logs against them.";

constexpr const char* footer =
    "Examples:\n"
    "  perentie check corpus/check/philosophers.csp\n"
    "  perentie repl corpus/rover/rover.csp\n"
    "  perentie monitor corpus/rover/pass.yaml\n"
    "  perentie monitor --model corpus/rover/rover.csp --process ROVER_SYSTEM \\\n"
    "      --trace corpus/rover/swapped.jsonl --mode strict\n"
    "  perentie lts corpus/rover/rover.csp -p 'ROVER_SYSTEM \\ {|radiation_level|}' -o rover.aut\n"
    "  perentie eval corpus/rover/rover.csp -e 'card(Events)'\n"
    "\n"
    "Exit codes: 0 it holds, conforms or is done; 1 it does not; 2 wrong usage or configuration;\n"
    "3 the model has errors; 4 a budget ran out (no verdict); 5 input or output failed; 130\n"
    "interrupted.";

// The words of the command line, last first. Called `refines`, the program is that subcommand.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(std::reverse_iterator(argv + argc),
                                 std::reverse_iterator(argv + std::min(argc, 1)));
  const std::string_view name = argc > 0 ? argv[0] : "";
  if (name.substr(name.find_last_of('/') + 1) == "refines") words.emplace_back("refines");
  return words;
}

// The word that stands where a subcommand should; empty if there is none.
std::string first_word(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (argv[i][0] != '-') return argv[i];
  }
  return {};
}

std::string complaint(const CLI::App& program, const CLI::Error& error, const std::string& word) {
  std::string what = error.what();
  if (program.get_subcommands().empty() && error.get_name() == "RequiredError") {
    what = word.empty() ? "a subcommand is needed" : fmt::format("no subcommand `{}`", word);
  }
  return fmt::format("perentie: error: {}\nRun with --help for more information.\n", what);
}

// What was printed may still be in a buffer: the exit code, unless it cannot be written.
ExitCode after_writing(ExitCode code, const Console& console) {
  std::cout.flush();
  if (std::cout && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  console.error("standard output could not be written");
  return ExitCode::io_error;
}

ExitCode run_command(const Command& command, Console& console) {
  try {
    return command.run(console);
  } catch (const std::bad_alloc&) {
    console.error("inconclusive: the system has no more memory to give");
    return ExitCode::inconclusive;
  }
}

ExitCode run(int argc, char** argv) {
  CLI::App program{description, "perentie"};
  program.footer(footer);
  program.require_subcommand(1);
  program.set_version_flag("--version", fmt::format("perentie {}", version));
  std::string colour = "auto";
  bool quiet = false;
  program.add_option("--color", colour, "Colour in messages: auto, always or never")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->capture_default_str();
  program.add_flag("-q,--quiet", quiet, "No notes and no progress on standard error");
  program.fallthrough();
  program.failure_message(
      [word = first_word(argc, argv)](const CLI::App* app, const CLI::Error& error) {
        return complaint(*app, error, word);
      });

  std::vector<Command> commands;
  for (const auto add : {add_monitor, add_check, add_refines, add_lts, add_eval, add_typecheck,
                         add_repl, add_dump}) {
    commands.push_back(add(program));
  }
  Console console;
  try {
    program.parse(words_of(argc, argv));
  } catch (const CLI::ParseError& error) {
    const bool is_success = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    program.exit(error);  // prints the help, the version or the complaint
    return is_success ? after_writing(ExitCode::ok, console) : ExitCode::usage;
  }
  console.set_colour(colour == "auto"     ? ColourChoice::automatic
                     : colour == "always" ? ColourChoice::always
                                          : ColourChoice::never);
  console.set_quiet(quiet);
  catch_interrupts();
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    const ExitCode code = run_command(command, console);
    return after_writing(interrupted().load() ? ExitCode::interrupted : code, console);
  }
  return ExitCode::usage;
}

}  // namespace
}  // namespace perentie::cli

int main(int argc, char** argv) { return static_cast<int>(perentie::cli::run(argc, argv)); }

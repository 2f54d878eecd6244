// perentie repl: evaluates what is typed. Lines are edited, kept and completed by libedit.
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <system_error>

#include <editline/readline.h>

#include "commands.hpp"
#include "repl.hpp"

namespace perentie::cli {
namespace {

struct Options {
  std::string file;
  bool no_history = false;
  bool call_stack = false;
  BudgetOptions budget;
};

// libedit asks a function without context: the session that it is for. Only while lines are read.
const Repl* completing = nullptr;
std::vector<std::string> candidates;

char* next_candidate(const char* word, int state) {
  if (state == 0) candidates = completing->completions(word);
  const auto number = static_cast<std::size_t>(state);
  return number < candidates.size() ? strdup(candidates[number].c_str()) : nullptr;
}

char** complete(const char* word, int, int) {
  rl_attempted_completion_over = 1;  // file names are no names of a script
  return rl_completion_matches(word, next_candidate);
}

// Where the lines of earlier sessions are kept (XDG Base Directory Specification); empty: nowhere.
std::string history_file(const Options& options) {
  if (options.no_history) return {};
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  std::filesystem::path folder;
  if (state != nullptr && *state != '\0') {
    folder = state;
  } else if (home != nullptr && *home != '\0') {
    folder = std::filesystem::path(home) / ".local/state";
  } else {
    return {};
  }
  folder /= "perentie";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  return error ? "" : (folder / "history").string();
}

void answer(Repl& repl, std::string_view line, bool& goes_on) {
  forget_interrupt();
  goes_on = repl.answer(line);
  std::cout.flush();
}

void talk(Repl& repl, const Options& options) {
  const std::string history = history_file(options);
  using_history();
  if (!history.empty()) read_history(history.c_str());
  completing = &repl;
  rl_attempted_completion_function = complete;
  static char breaks[] = " \t\n()[]{}<>,;.|\\&+-*/=!?@^#\"'";
  rl_completer_word_break_characters = breaks;
  rl_completion_append_character = 0;
  for (bool goes_on = true; goes_on;) {
    const std::string prompt = repl.name() + "> ";
    const std::unique_ptr<char, void (*)(void*)> line(readline(prompt.c_str()), std::free);
    if (!line) break;
    if (*line != '\0') add_history(line.get());
    answer(repl, line.get(), goes_on);
  }
  completing = nullptr;
  if (!history.empty()) write_history(history.c_str());
}

ExitCode converse(const Options& options, Console& console) {
  Repl repl(options.budget, options.call_stack, console);
  const bool loaded = options.file.empty() || repl.load(options.file);
  if (isatty(STDIN_FILENO) != 0) {
    console.note("`:help` lists the commands; Ctrl-D leaves");
    talk(repl, options);
    return ExitCode::ok;
  }
  if (!loaded) return ExitCode::model_error;
  std::string line;
  for (bool goes_on = true; goes_on && std::getline(std::cin, line);) answer(repl, line, goes_on);
  return ExitCode::ok;
}

}  // namespace

Command add_repl(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* app =
      program.add_subcommand("repl", "Evaluate what is typed, in the scope of a script");
  app->add_option("FILE", options->file, "The CSPM script; none: only the built-ins");
  app->add_flag("--no-history", options->no_history,
                "Neither read nor keep the lines of other sessions");
  app->add_flag("--call-stack", options->call_stack,
                "With errors, show the calls that led to them");
  options->budget.add_to(*app);
  app->footer(
      "Examples:\n"
      "  perentie repl corpus/rover/rover.csp\n"
      "  echo 'card(waypointID)' | perentie repl corpus/rover/rover.csp");
  return {app, [options](Console& console) { return converse(*options, console); }};
}

}  // namespace perentie::cli

// The subcommands: one file each. Adding a command registers its options; what it does runs after
// the command line is read.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "console.hpp"
#include "exit_codes.hpp"

namespace perentie::cli {

struct Command {
  CLI::App* app;
  std::function<ExitCode(Console&)> run;
};

Command add_monitor(CLI::App& program);
Command add_check(CLI::App& program);
Command add_refines(CLI::App& program);
Command add_lts(CLI::App& program);
Command add_eval(CLI::App& program);
Command add_typecheck(CLI::App& program);
Command add_repl(CLI::App& program);
Command add_dump(CLI::App& program);

}  // namespace perentie::cli

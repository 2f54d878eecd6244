// What the subcommands share: loading a script, budgets from options, and making an LTS.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "console.hpp"
#include "exit_codes.hpp"
#include "perentie/base/diagnostic.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/semantics/machine.hpp"
#include "perentie/semantics/process_graph.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::cli {

inline constexpr unsigned max_workers = 1024;
/// From 1 to `max_workers`.
unsigned processor_count();

/// The budgets of a run, as options.
struct BudgetOptions {
  std::uint64_t max_states = 0;  ///< 0: no limit
  std::uint64_t max_memory;      ///< bytes; 0: no limit
  double timeout = 0;            ///< seconds; 0: no limit
  unsigned workers;              ///< threads

  BudgetOptions();

  void add_to(CLI::App& app);
  base::Limits limits() const;
};

/// The compression of leaves that `option` names: `none`, `sbisim` or `wbisim`.
semantics::LeafCompression leaf_compression_of(const std::string& option);

/// The texts and messages of one run of the program.
struct Input {
  base::SourceMap sources;
  base::Diagnostics diagnostics;

  /// Reads a file into the sources; a C001 diagnostic if it cannot be read.
  std::optional<base::FileId> read(const std::string& path);
  /// What to exit with after errors: `io_error` if a file could not be read, else `otherwise`.
  ExitCode failure(ExitCode otherwise) const;
};

/// Loads a script. Null: `code` says what to exit with, and the reason was printed.
std::unique_ptr<semantics::Script> load_script(const std::string& path, Input& input,
                                               Console& console, ExitCode& code);

/// Evaluates and explores. Nothing: `code` says what to exit with, and the reason was printed. A
/// budget that ran out is a result, not a failure: the LTS is then a part. `origin`
/// is where the expression was written.
std::optional<semantics::ProcessExploration> build_lts(semantics::Script& script,
                                                       const std::string& process,
                                                       const std::string& origin,
                                                       const base::Limits& limits, Input& input,
                                                       Console& console, ExitCode& code);

/// The same without the graph.
std::optional<semantics::ProcessSize> count_lts(semantics::Script& script,
                                                const std::string& process,
                                                const std::string& origin,
                                                const base::Limits& limits, Input& input,
                                                Console& console, ExitCode& code);

/// What to say of a compression that `Script::compressions_given_up` names.
std::string compression_given_up(const std::string& compression);

}  // namespace perentie::cli

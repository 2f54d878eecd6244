// The options of FDR as flags of `perentie refines` (CSPM reference 6.5, 7.1.3).
//
// Names are FDR's with `-` for `.` and `_`. Those that say how FDR works, and that no verdict
// depends on, are read, checked for form and have no effect; the others are acted upon.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace perentie::cli {

struct FdrOptions {
  std::optional<std::size_t> workers;       ///< refinement.bfs.workers
  std::size_t desired_counterexamples = 1;  ///< refinement.desired_counterexample_count
  bool track_history = true;                ///< refinement.track_history: counterexamples
  bool range_checks = true;                 ///< cspm.runtime_range_checks
  bool stack_traces = false;                ///< cspm.evaluator.record_stack_traces
  std::string leaf_compression = "sbisim";  ///< compiler.leaf_compression, in lower case
};

void add_fdr_options(CLI::App& app, FdrOptions& options);

}  // namespace perentie::cli

// Reports: the result of a run for machines (JSON) and for people (text).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "perentie/monitor/session.hpp"

namespace perentie::monitor {

/// What the caller knows about the model and the trace of a run.
struct RunSubject {
  std::string name;     ///< of the configuration; may be empty
  std::string model;    ///< path
  std::string process;  ///< name or expression
  std::string trace;    ///< path
  Mode mode = Mode::permissive;
  std::uint64_t states = 0;       ///< of the process's LTS
  std::uint64_t transitions = 0;  ///< of the process's LTS
  double synthesis_seconds = 0;   ///< from the model's text to the monitor
  /// How the caller prints the process in each of `RunResult::model_states`; may be empty.
  std::vector<std::string> model_position;
};

/// "conforms", "violation" or "inconclusive".
std::string_view to_string(RunVerdict verdict);
/// "strict" or "permissive".
std::string_view to_string(Mode mode);

/// One JSON object on one line, of the schema `perentie.monitor/1`, with its keys in a fixed order
/// (monitor/README.md lists them). Ends without a line end.
std::string to_json(const RunResult& result, const RunSubject& subject);

/// A few lines for a reader who knows neither CSP nor this program.
std::string to_text(const RunResult& result, const RunSubject& subject);

}  // namespace perentie::monitor

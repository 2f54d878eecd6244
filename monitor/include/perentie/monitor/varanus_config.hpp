// VaranusConfig: what a Varanus configuration file (YAML) asks for.
//
// All keys of Varanus 0.9.6 and its `buchi` branch are known, and one of ours, `mapping`, which
// names the mapping of messages to events (a built-in one or a file). Relative paths are relative
// to the folder of the config; absolute ones are taken as they are.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/monitor/monitor.hpp"
#include "perentie/monitor/placed.hpp"

namespace perentie::monitor {

struct VaranusConfig {
  Placed<std::string> model;         ///< path of the CSPM root file
  Placed<std::string> main_process;  ///< a name or an expression
  /// The channels of the model, for the determinism gate. None: not given.
  std::optional<std::vector<Placed<std::string>>> alphabet;
  /// The channels that the system shows, before the event map; all others are hidden. None: not
  /// given, nothing is hidden.
  std::optional<std::vector<Placed<std::string>>> common_alphabet;
  std::optional<Placed<std::string>> map;         ///< path of the event map
  std::optional<Placed<std::string>> trace_file;  ///< path of the trace
  std::optional<Placed<std::string>> mapping;     ///< path or name of the mapping
  std::string name;  ///< default: the config's file name without `.yaml`
  Mode mode = Mode::permissive;
  std::vector<std::string> stress_events;
  std::optional<std::uint64_t> stress_repetitions;
  std::optional<std::string> predictive_ltl_ws_url;
};

/// `path` as seen from the folder of the file `from`; absolute paths and `-` stay as they are.
std::string resolve_path(std::string_view from, const std::string& path);

/// Reads a config from a file already in `sources`, whose path the relative paths in it refer to.
/// None after diagnostics if it is not one; unknown keys are only warned of.
std::optional<VaranusConfig> parse_varanus_config(base::FileId file, const base::SourceMap& sources,
                                                  base::Diagnostics& diagnostics);

/// Reads the file and parses it.
std::optional<VaranusConfig> load_varanus_config(const std::string& path, base::SourceMap& sources,
                                                 base::Diagnostics& diagnostics);

}  // namespace perentie::monitor

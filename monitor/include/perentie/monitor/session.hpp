// A whole trace against a model, offline: the trace is checked event by event up to its end or to
// the first violation, and the result says all that a report needs.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "perentie/lts/normalise.hpp"
#include "perentie/monitor/event_index.hpp"
#include "perentie/monitor/event_stream.hpp"
#include "perentie/monitor/monitor.hpp"

namespace perentie::monitor {

/// What all monitors of one process share.
struct MonitorModel {
  MonitorTable table;
  EventIndex index;
  /// By state of the table: the states that the process itself may then be in.
  lts::Runs<lts::State> members;
};

/// `normal` must be complete: a normal form that was cut off by a budget would refuse what the
/// process permits.
MonitorModel make_monitor_model(lts::NormalLts normal, const TableOptions& options = {});

enum class RunVerdict : std::uint8_t {
  conforms,
  violation,
  inconclusive,  ///< `RunResult::reason` says why there is no verdict
};

struct RunResult {
  RunVerdict verdict = RunVerdict::conforms;
  /// Of an inconclusive run, without final period: the trace could not be read to its end (and
  /// there was no violation before), or the model could not be made within its budgets.
  std::string reason;
  std::uint64_t events_checked = 0;  ///< with the offending event and with ignored ones
  std::uint64_t events_ignored = 0;  ///< outside Alpha(M), in permissive mode
  /// How many events the trace has; none if it was not read to its end.
  std::optional<std::uint64_t> events_total;

  /// The last event checked (after a violation: the offending one), as the model names it, or as
  /// the trace does if it is outside Alpha(M). Empty if there was none.
  std::string event;
  bool event_in_alphabet = false;
  TracePlace place;    ///< of that event
  std::string source;  ///< the line or message that it comes from, of a long one the beginning

  /// The events that the model permits at `state`, sorted, ✓ among them if it may terminate: before
  /// the offending event, or after the last event.
  std::vector<std::string> permitted;
  State state;                           ///< of the table; none: the run did not begin
  std::vector<lts::State> model_states;  ///< the states of the process, ascending

  /// After a violation by an event outside Alpha(M): events with a similar name.
  std::vector<std::string> similar;
  /// The events that were ignored, and how often; at most `max_ignored_names` different ones.
  std::map<std::string, std::uint64_t> ignored;
  double checking_seconds = 0;  ///< reading the trace included

  static constexpr std::size_t max_ignored_names = 100;
};

/// What is done with the rest of a trace after a violation.
enum class RestOfTrace : std::uint8_t { count, leave };

/// Checks the trace from the initial state of the model. Bad input has been reported to the
/// stream's diagnostics and ends the run.
RunResult run_trace(EventStream& stream, const MonitorModel& model, Mode mode,
                    RestOfTrace rest = RestOfTrace::count);

}  // namespace perentie::monitor

// The trace readers, one per format; `open_trace` in trace_reader.cpp chooses among them.
#pragma once

#include <memory>

#include "perentie/monitor/trace_reader.hpp"
#include "trace_input.hpp"
#include "trace_report.hpp"

namespace perentie::monitor {

/// A line or an element above this size ends the trace with a diagnostic instead of filling the
/// memory.
inline constexpr std::size_t max_record_bytes = std::size_t{64} << 20U;

/// How far a text is skipped for a byte-order mark: 3 bytes or none.
std::size_t byte_order_mark(std::string_view text);

/// Why a text that should be an event is none.
struct EventFault {
  std::size_t at = 0;  ///< the byte of the event where it shows
  std::string_view message;
};

/// Control characters, a blank between two words, broken UTF-8. None if the text may be an event.
std::optional<EventFault> find_event_fault(std::string_view event);

/// Reports the end of a trace at a failing read. False if reading did not fail.
bool report_read_error(TraceReport& report, const TraceInput& input);

std::unique_ptr<TraceReader> make_text_reader(TraceInput input, TraceReport& report);
std::unique_ptr<TraceReader> make_json_lines_reader(TraceInput input, TraceReport& report);
std::unique_ptr<TraceReader> make_json_array_reader(TraceInput input, TraceReport& report);

}  // namespace perentie::monitor

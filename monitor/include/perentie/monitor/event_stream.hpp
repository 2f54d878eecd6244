// EventStream: the events of a trace in order, whatever the trace consists of.
//
// Joins a trace reader, which gives records, and mappings, which turn messages into events. With a
// second mapping the stream follows Varanus's rule for logs: the first mapping is used unless it
// makes no event of the whole trace, and then the second one instead.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "perentie/monitor/event_map.hpp"
#include "perentie/monitor/mapping.hpp"
#include "perentie/monitor/trace_reader.hpp"

namespace perentie::monitor {

/// How messages become events. Everything must outlive the stream; null: none.
struct EventSources {
  const Mapping* mapping = nullptr;
  const Mapping* fallback = nullptr;  ///< used if `mapping` makes no event of the whole trace
  const EventMap* event_map = nullptr;
};

struct TraceEvent {
  std::string_view text;  ///< until the next event is read
  std::string_view
      source;  ///< the line or message that it comes from; until the next event is read
  TracePlace place;
};

class EventStream {
 public:
  EventStream(std::unique_ptr<TraceReader> reader, const EventSources& sources,
              TraceReport& report);
  ~EventStream();
  EventStream(EventStream&&) noexcept;

  /// The next event. False at the end of the trace and at bad input, which has then been reported.
  bool next(TraceEvent& event);
  /// True once bad input has been met.
  bool failed() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The options with which a trace for these sources must be opened.
TraceReaderOptions reader_options(const EventSources& sources, TraceFormat format);

}  // namespace perentie::monitor

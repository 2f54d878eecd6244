#include "perentie/monitor/event_stream.hpp"

#include "message_mapper.hpp"
#include "perentie/base/check.hpp"
#include "trace_report.hpp"

namespace perentie::monitor {

struct EventStream::State {
  std::unique_ptr<TraceReader> reader;
  EventSources sources;
  TraceReport* report;
  std::optional<MessageMapper> mapper;
  TraceRecord record;
  std::size_t next_event = 0;   // of the events that the mapper made of `record`
  std::size_t event_count = 0;  // how many it made
  bool any_event = false;
  bool fallback_used = false;
  bool failed = false;
  std::string renamed;

  bool next(TraceEvent& event) {
    for (;;) {
      if (next_event < event_count) {
        event = {mapper->events()[next_event++], record.source, record.place};
        any_event = true;
        return true;
      }
      if (failed) return false;
      if (!reader->next(record)) {
        if (!start_again()) return false;
        continue;
      }
      if (record.kind == TraceRecord::Kind::event) {
        event = {rename(record.text), record.source, record.place};
        any_event = true;
        return true;
      }
      map_message();
    }
  }

  void map_message() {
    next_event = 0;
    if (!mapper->map(record.text)) return report_fault(mapper->fault());
    event_count = mapper->events().size();
  }

  // At the end of a trace of which the first mapping made nothing.
  bool start_again() {
    if (reader->failed() || any_event || fallback_used || sources.fallback == nullptr) return false;
    fallback_used = true;
    mapper.emplace(*sources.fallback, sources.event_map);
    reader->rewind();
    return true;
  }

  std::string_view rename(std::string_view event) {
    if (sources.event_map == nullptr || sources.event_map->empty()) return event;
    renamed = sources.event_map->rename_event(event);
    return renamed;
  }

  void report_fault(const MappingFault& fault) {
    failed = true;
    event_count = 0;
    base::Diagnostic& diagnostic = report_in_trace(
        *report, *fault.code, {record.text, record.place}, fault.begin, fault.end, fault.message);
    if (!fault.note.empty()) diagnostic.notes.push_back({std::nullopt, fault.note});
  }
};

EventStream::EventStream(std::unique_ptr<TraceReader> reader, const EventSources& sources,
                         TraceReport& report)
    : state_(std::make_unique<State>()) {
  PERENTIE_CHECK(sources.mapping != nullptr, "an event stream without a mapping");
  state_->reader = std::move(reader);
  state_->sources = sources;
  state_->report = &report;
  state_->mapper.emplace(*sources.mapping, sources.event_map);
}

EventStream::~EventStream() = default;
EventStream::EventStream(EventStream&&) noexcept = default;

bool EventStream::next(TraceEvent& event) { return state_->next(event); }

bool EventStream::failed() const { return state_->failed || state_->reader->failed(); }

TraceReaderOptions reader_options(const EventSources& sources, TraceFormat format) {
  return {format, sources.fallback != nullptr};
}

}  // namespace perentie::monitor

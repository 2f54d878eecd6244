#include "perentie/monitor/session.hpp"

#include <algorithm>
#include <chrono>

#include "perentie/base/text.hpp"

namespace perentie::monitor {
namespace {

constexpr std::size_t max_source_bytes = 400;

// The beginning of a long text, cut between characters.
std::string shortened(std::string_view text) {
  if (text.size() <= max_source_bytes) return std::string(text);
  std::size_t end = max_source_bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return std::string(text.substr(0, end)) + "...";
}

void count_ignored(RunResult& result, std::string_view text) {
  ++result.events_ignored;
  std::string name = normalise_event_text(text);
  const auto found = result.ignored.find(name);
  if (found != result.ignored.end()) {
    ++found->second;
  } else if (result.ignored.size() < RunResult::max_ignored_names) {
    result.ignored.emplace(std::move(name), 1);
  }
}

std::vector<std::string> names_of(const MonitorTable& table, const std::vector<Event>& events) {
  std::vector<std::string> names;
  for (const Event event : events) names.emplace_back(table.name(event));
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> similar_events(const MonitorTable& table, std::string_view text) {
  std::vector<std::string_view> names;
  for (std::uint32_t e = 0; e < table.event_count(); ++e) names.push_back(table.name(Event{e}));
  const std::vector<std::string_view> near = base::nearest_words(text, names);
  return {near.begin(), near.end()};
}

// What is known of the last event checked, and of where the model is.
void describe_end(RunResult& result, const MonitorModel& model, const Monitor& monitor,
                  Event event) {
  result.event_in_alphabet = !event.is_none();
  if (event) {
    result.event = std::string(model.table.name(event));
  } else {
    result.event = normalise_event_text(result.event);
    if (result.verdict == RunVerdict::violation) {
      result.similar = similar_events(model.table, result.event);
    }
  }
  result.permitted = names_of(model.table, monitor.expected());
  result.state = monitor.state();
  const auto members = model.members[monitor.state().value];
  result.model_states.assign(members.begin(), members.end());
}

}  // namespace

MonitorModel make_monitor_model(lts::NormalLts normal, const TableOptions& options) {
  MonitorTable table = MonitorTable::compile(normal.lts, options);
  EventIndex index(table);
  return {std::move(table), std::move(index), std::move(normal.members)};
}

RunResult run_trace(EventStream& stream, const MonitorModel& model, Mode mode, RestOfTrace rest) {
  const auto start = std::chrono::steady_clock::now();
  RunResult result;
  Monitor monitor(model.table, mode);
  TraceEvent traced;
  Event event;
  while (!monitor.violated() && stream.next(traced)) {
    event = model.index.find(traced.text);
    ++result.events_checked;
    const Verdict verdict = monitor.step(event);
    if (verdict == Verdict::ignored) count_ignored(result, traced.text);
    // Which event is the last is known too late to ask for its text; the model has that of its own.
    if (event.is_none()) result.event.assign(traced.text);
    result.place = traced.place;
    if (verdict == Verdict::violation) {
      result.verdict = RunVerdict::violation;
      result.source = shortened(traced.source);
    }
  }
  if (!monitor.violated() || rest == RestOfTrace::count) {
    std::uint64_t total = result.events_checked;
    while (stream.next(traced)) ++total;
    if (!stream.failed()) result.events_total = total;
  }
  if (stream.failed() && result.verdict == RunVerdict::conforms) {
    result.verdict = RunVerdict::inconclusive;
    result.reason = "the trace could not be read to its end";
  }
  describe_end(result, model, monitor, event);
  result.checking_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace perentie::monitor

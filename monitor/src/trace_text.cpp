// The text format: one event per line, with or without `Event:` before it.
#include <algorithm>

#include "line_reader.hpp"
#include "perentie/monitor/diagnostic_codes.hpp"

namespace perentie::monitor {
namespace {

constexpr std::string_view prefix = "Event:";

class TextReader final : public TraceReader {
 public:
  TextReader(TraceInput input, TraceReport& report) : lines_(std::move(input), report) {}

  bool next(TraceRecord& record) override {
    PlacedText line;
    if (!lines_.next(line)) return false;
    std::string_view event = line.text;
    if (event.starts_with(prefix)) {
      event.remove_prefix(prefix.size());
      event.remove_prefix(std::min(event.find_first_not_of(" \t"), event.size()));
    }
    const std::size_t skipped = line.text.size() - event.size();
    if (const auto fault = find_event_fault(event)) {
      const std::size_t at = skipped + fault->at;
      report_in_trace(lines_.report(), codes::malformed_event, line, at, at + 1,
                      std::string(fault->message));
      return lines_.fail();
    }
    const TracePlace place{line.place.line, line.place.column + skipped};
    record = {TraceRecord::Kind::event, event, line.text, place};
    return true;
  }

  void rewind() override { lines_.rewind(); }
  bool failed() const override { return lines_.failed(); }

 private:
  LineReader lines_;
};

}  // namespace

std::unique_ptr<TraceReader> make_text_reader(TraceInput input, TraceReport& report) {
  return std::make_unique<TextReader>(std::move(input), report);
}

}  // namespace perentie::monitor

// JSON lines: one object (a message) or string (an event) per line.
//
// The reader only looks at how a line begins; what is inside a message is the mapper's business,
// and so is the complaint if it is not JSON.
#include <algorithm>

#include "json_text.hpp"
#include "line_reader.hpp"
#include "perentie/monitor/diagnostic_codes.hpp"

namespace perentie::monitor {
namespace {

class JsonLinesReader final : public TraceReader {
 public:
  JsonLinesReader(TraceInput input, TraceReport& report) : lines_(std::move(input), report) {}

  bool next(TraceRecord& record) override {
    PlacedText line;
    if (!lines_.next(line)) return false;
    if (line.text.front() == '{') {
      record = {TraceRecord::Kind::message, line.text, line.text, line.place};
      return true;
    }
    if (line.text.front() == '"') return read_event(line, record);
    report_in_trace(lines_.report(), codes::malformed_message, line, 0, 1,
                    "this line is not a JSON object or string");
    return lines_.fail();
  }

  void rewind() override { lines_.rewind(); }
  bool failed() const override { return lines_.failed(); }

 private:
  bool read_event(const PlacedText& line, TraceRecord& record) {
    event_.clear();
    if (const auto fault = find_json_fault(line.text)) {
      report_in_trace(lines_.report(), codes::malformed_message, line, fault->begin, fault->end,
                      fault->cut_off ? "the line ends in the middle of a JSON string"
                                     : "this line is not one JSON string");
      return lines_.fail();
    }
    append_unescaped(line.text.substr(1, line.text.size() - 2), event_);
    if (const auto fault = find_event_fault(event_)) {
      report_in_trace(lines_.report(), codes::malformed_event, line, 0, line.text.size(),
                      std::string(fault->message));
      return lines_.fail();
    }
    record = {TraceRecord::Kind::event, event_, line.text, line.place};
    return true;
  }

  LineReader lines_;
  std::string event_;
};

}  // namespace

std::unique_ptr<TraceReader> make_json_lines_reader(TraceInput input, TraceReport& report) {
  return std::make_unique<JsonLinesReader>(std::move(input), report);
}

}  // namespace perentie::monitor

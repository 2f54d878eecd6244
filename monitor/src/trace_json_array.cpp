// JSON arrays of events (strings) and messages (objects): one after the other, over any number of
// lines.
//
// Elements are cut out of the stream by following brackets and quotation marks, so an array of any
// length on one line passes through a window of one element. What is inside a message is the
// mapper's business.
#include <algorithm>

#include <fmt/format.h>

#include "json_text.hpp"
#include "perentie/monitor/diagnostic_codes.hpp"
#include "trace_readers.hpp"

namespace perentie::monitor {
namespace {

// Follows one element byte by byte; it may be fed in pieces.
class ElementScanner {
 public:
  /// True if the element is complete with this byte.
  bool completed_by(char c) {
    if (quoted_) {
      if (escaped_) {
        escaped_ = false;
      } else if (c == '\\') {
        escaped_ = true;
      } else if (c == '"') {
        quoted_ = false;
      }
    } else if (c == '"') {
      quoted_ = true;
    } else if (c == '{' || c == '[') {
      ++depth_;
    } else if (c == '}' || c == ']') {
      --depth_;
    }
    return !quoted_ && depth_ <= 0;
  }

 private:
  std::int64_t depth_ = 0;
  bool quoted_ = false;
  bool escaped_ = false;
};

class JsonArrayReader final : public TraceReader {
 public:
  JsonArrayReader(TraceInput input, TraceReport& report)
      : input_(std::move(input)), report_(&report) {
    skip_byte_order_mark();
  }

  bool next(TraceRecord& record) override {
    if (failed_) return false;
    advance(std::exchange(element_bytes_, 0));
    return find_element() && take_element(record);
  }

  void rewind() override {
    input_.rewind();
    input_.more();
    skip_byte_order_mark();
    position_ = Position::outside;
    place_ = {};
    element_bytes_ = 0;
    failed_ = false;
  }

  bool failed() const override { return failed_; }

 private:
  enum class Position : std::uint8_t { outside, at_first_element, at_element, after_element };

  void skip_byte_order_mark() { input_.consume(byte_order_mark(input_.window())); }

  // Goes on to the beginning of the next element. False at the end of the trace and at a fault.
  bool find_element() {
    for (;;) {
      if (!skip_blanks()) return at_end();
      const char c = input_.window().front();
      switch (position_) {
        case Position::outside:
          if (c != '[') return fail_here("expected `[`, which begins an array of events");
          advance(1);
          position_ = Position::at_first_element;
          break;
        case Position::at_first_element:
          if (c == ']') {
            advance(1);
            position_ = Position::outside;
            break;
          }
          return true;
        case Position::at_element:
          return true;
        case Position::after_element:
          if (c != ',' && c != ']') return fail_here("expected `,` or `]` after an element");
          advance(1);
          position_ = c == ',' ? Position::at_element : Position::outside;
          break;
      }
    }
  }

  bool take_element(TraceRecord& record) {
    const char first = input_.window().front();
    if (first != '{' && first != '"') {
      return fail_here("an element must be an event (a string) or a message (an object)");
    }
    if (!scan_element()) return false;
    position_ = Position::after_element;
    const PlacedText element{input_.window().substr(0, element_bytes_), place_};
    if (first == '{') {
      record = {TraceRecord::Kind::message, element.text, element.text, place_};
      return true;
    }
    return read_event(element, record);
  }

  // Finds the end of the element at the window's front, of which all gets into the window.
  bool scan_element() {
    ElementScanner scanner;
    std::size_t scanned = 0;
    for (;;) {
      const std::string_view window = input_.window();
      for (; scanned < window.size(); ++scanned) {
        if (!scanner.completed_by(window[scanned])) continue;
        element_bytes_ = scanned + 1;
        return true;
      }
      if (window.size() > max_record_bytes) {
        report_in_trace(*report_, codes::overlong_line, {window.substr(0, 80), place_}, 0, 1,
                        fmt::format("the element is longer than {} MiB", max_record_bytes >> 20U));
        return fail();
      }
      if (input_.more()) continue;
      if (report_read_error(*report_, input_)) return fail();
      report_in_trace(*report_, codes::malformed_message, {input_.window(), place_}, scanned,
                      scanned, "the trace ends in the middle of an element");
      return fail();
    }
  }

  bool read_event(const PlacedText& element, TraceRecord& record) {
    event_.clear();
    if (!append_unescaped(element.text.substr(1, element.text.size() - 2), event_)) {
      report_in_trace(*report_, codes::malformed_message, element, 0, element.text.size(),
                      "this string has an escape that JSON does not know");
      return fail();
    }
    if (const auto fault = find_event_fault(event_)) {
      report_in_trace(*report_, codes::malformed_event, element, 0, element.text.size(),
                      std::string(fault->message));
      return fail();
    }
    record = {TraceRecord::Kind::event, event_, element.text, place_};
    return true;
  }

  // Skips blanks; false at the end of the input.
  bool skip_blanks() {
    for (;;) {
      const std::string_view window = input_.window();
      const std::size_t blanks = std::min(window.find_first_not_of(" \t\r\n"), window.size());
      advance(blanks);
      if (blanks < window.size()) return true;
      if (!input_.more()) return false;
    }
  }

  void advance(std::size_t count) {
    for (const char c : input_.window().substr(0, count)) {
      if (c == '\n') {
        ++place_.line;
        place_.column = 1;
      } else if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) {
        ++place_.column;
      }
    }
    input_.consume(count);
  }

  bool at_end() {
    if (report_read_error(*report_, input_)) return fail();
    if (position_ == Position::outside) return false;
    report_in_trace(*report_, codes::malformed_message, {input_.window(), place_}, 0, 0,
                    "the trace ends before the array is closed by `]`");
    return fail();
  }

  bool fail_here(std::string message) {
    report_in_trace(*report_, codes::malformed_message, {input_.window().substr(0, 80), place_}, 0,
                    1, std::move(message));
    return fail();
  }

  bool fail() {
    failed_ = true;
    return false;
  }

  TraceInput input_;
  TraceReport* report_;
  Position position_ = Position::outside;
  TracePlace place_;               // of the window's front
  std::size_t element_bytes_ = 0;  // the element handed out last
  bool failed_ = false;
  std::string event_;
};

}  // namespace

std::unique_ptr<TraceReader> make_json_array_reader(TraceInput input, TraceReport& report) {
  return std::make_unique<JsonArrayReader>(std::move(input), report);
}

}  // namespace perentie::monitor

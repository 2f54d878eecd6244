#include "perentie/monitor/trace_reader.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <simdjson.h>

#include "perentie/monitor/diagnostic_codes.hpp"
#include "trace_readers.hpp"

namespace perentie::monitor {
namespace {

constexpr std::array<std::pair<std::string_view, TraceFormat>, 4> format_names{{
    {"auto", TraceFormat::automatic},
    {"json-lines", TraceFormat::json_lines},
    {"json-array", TraceFormat::json_array},
    {"text", TraceFormat::text},
}};

constexpr std::string_view blanks = " \t\r\n\f\v";

// Why the beginning of a file shows that it holds no text that we read; empty if it may.
std::string_view why_no_text(std::string_view beginning) {
  if (beginning.starts_with("\xFF\xFE") || beginning.starts_with("\xFE\xFF")) {
    return "it is UTF-16; a trace must be UTF-8";
  }
  if (beginning.find('\0') != std::string_view::npos) return "it is a binary file";
  return {};
}

TraceFormat detect(std::string_view beginning) {
  const std::size_t first = beginning.find_first_not_of(blanks, byte_order_mark(beginning));
  if (first == std::string_view::npos) return TraceFormat::text;
  switch (beginning[first]) {
    case '{':
    case '"':
      return TraceFormat::json_lines;
    case '[':
      return TraceFormat::json_array;
    default:
      return TraceFormat::text;
  }
}

// Fills the window until it shows something other than a byte-order mark and blanks.
void read_beginning(TraceInput& input) {
  while (input.more() && input.window().size() <= max_record_bytes) {
    const std::string_view window = input.window();
    if (window.size() < 4) continue;
    if (window.find_first_not_of(blanks, byte_order_mark(window)) != std::string_view::npos) return;
  }
}

std::unique_ptr<TraceReader> make_reader(TraceInput input, TraceFormat format,
                                         TraceReport& report) {
  read_beginning(input);
  if (report_read_error(report, input)) return nullptr;
  if (const std::string_view why = why_no_text(input.window()); !why.empty()) {
    report.diagnostics.report(codes::not_a_trace,
                              fmt::format("`{}` holds no trace: {}", report.path, why));
    return nullptr;
  }
  if (format == TraceFormat::automatic) format = detect(input.window());
  switch (format) {
    case TraceFormat::json_lines:
      return make_json_lines_reader(std::move(input), report);
    case TraceFormat::json_array:
      return make_json_array_reader(std::move(input), report);
    default:
      return make_text_reader(std::move(input), report);
  }
}

bool is_control(char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F; }

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// The first blank between two words outside quotation marks.
std::size_t find_blank_between_words(std::string_view text) {
  bool quoted = false;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i - 1] == '"') quoted = !quoted;
    if (quoted || (text[i] != ' ' && text[i] != '\t') || !is_word(text[i - 1])) continue;
    const std::size_t next = text.find_first_not_of(" \t", i);
    if (next != std::string_view::npos && is_word(text[next])) return i;
  }
  return std::string_view::npos;
}

}  // namespace

std::optional<TraceFormat> trace_format_from_name(std::string_view name) {
  for (const auto& [known, format] : format_names) {
    if (known == name) return format;
  }
  return std::nullopt;
}

std::size_t byte_order_mark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
}

std::optional<EventFault> find_event_fault(std::string_view event) {
  // Nearly all events are only words and dots.
  const bool plain =
      std::all_of(event.begin(), event.end(), [](char c) { return is_word(c) || c == '.'; });
  if (plain && !event.empty()) return std::nullopt;
  const auto control = std::find_if(event.begin(), event.end(), is_control);
  if (control != event.end()) {
    return EventFault{static_cast<std::size_t>(control - event.begin()),
                      "this is not an event: it has a control character"};
  }
  if (!simdjson::validate_utf8(event.data(), event.size())) {
    return EventFault{0, "this is not an event: it is not UTF-8"};
  }
  if (event.starts_with('{') || event.starts_with('[') || event.starts_with('"')) {
    return EventFault{0, "this is not an event but looks like JSON (--trace-format json-lines)"};
  }
  const std::size_t blank = find_blank_between_words(event);
  if (blank != std::string_view::npos) {
    return EventFault{
        blank, "this is not an event: blanks may stand only around dots, commas and brackets"};
  }
  if (event.find_first_not_of(" \t") == std::string_view::npos) {
    return EventFault{0, "this is not an event: it is empty"};
  }
  return std::nullopt;
}

bool report_read_error(TraceReport& report, const TraceInput& input) {
  if (input.read_error().empty()) return false;
  report.diagnostics.report(codes::unreadable_file, fmt::format("cannot read the trace `{}`: {}",
                                                                report.path, input.read_error()));
  return true;
}

std::unique_ptr<TraceReader> open_trace(const std::string& path, const TraceReaderOptions& options,
                                        TraceReport& report) {
  std::string error;
  std::optional<TraceInput> input = TraceInput::open(path, options, error);
  if (!input) {
    report.diagnostics.report(codes::unreadable_file,
                              fmt::format("cannot read the trace `{}`: {}", report.path, error));
    return nullptr;
  }
  return make_reader(std::move(*input), options.format, report);
}

std::unique_ptr<TraceReader> open_trace_text(std::string text, const TraceReaderOptions& options,
                                             TraceReport& report) {
  return make_reader(TraceInput::of_text(text), options.format, report);
}

}  // namespace perentie::monitor

#include "line_reader.hpp"

#include <fmt/format.h>

#include "perentie/monitor/diagnostic_codes.hpp"

namespace perentie::monitor {
namespace {

constexpr std::string_view blanks = " \t\r\f\v";

}  // namespace

bool LineReader::next(PlacedText& line) {
  std::string_view whole;
  while (!failed_ && take_line(whole)) {
    const std::size_t skipped = line_number_ == 1 ? byte_order_mark(whole) : 0;
    const std::size_t first = whole.find_first_not_of(blanks, skipped);
    if (first == std::string_view::npos) continue;
    const std::size_t last = whole.find_last_not_of(blanks);
    line = {whole.substr(first, last + 1 - first), {line_number_, 1 + first - skipped}};
    return true;
  }
  return false;
}

bool LineReader::take_line(std::string_view& line) {
  input_.consume(to_consume_);
  to_consume_ = 0;
  std::size_t searched = 0;
  for (;;) {
    const std::string_view window = input_.window();
    const std::size_t end = window.find('\n', searched);
    if (end != std::string_view::npos) {
      line = window.substr(0, end);
      to_consume_ = end + 1;
      break;
    }
    if (window.size() > max_record_bytes) {
      report_in_trace(*report_, codes::overlong_line, {window.substr(0, 80), {line_number_ + 1, 1}},
                      0, 1, fmt::format("the line is longer than {} MiB", max_record_bytes >> 20U));
      return fail();
    }
    searched = window.size();
    if (input_.more()) continue;
    if (report_read_error(*report_, input_)) return fail();
    line = input_.window();
    to_consume_ = line.size();
    if (line.empty()) return false;
    break;
  }
  ++line_number_;
  return true;
}

void LineReader::rewind() {
  input_.rewind();
  line_number_ = 0;
  to_consume_ = 0;
  failed_ = false;
}

}  // namespace perentie::monitor

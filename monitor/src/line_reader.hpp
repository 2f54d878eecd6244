// LineReader: the lines of a trace without their ends, for the formats that are made of lines.
#pragma once

#include "trace_readers.hpp"

namespace perentie::monitor {

class LineReader {
 public:
  LineReader(TraceInput input, TraceReport& report) : input_(std::move(input)), report_(&report) {}

  /// The next line that is not blank, without blanks around it, valid until the next call and
  /// followed by `TraceInput::padding` readable bytes. False at the end and at input that cannot be
  /// read.
  bool next(PlacedText& line);
  void rewind();

  bool failed() const { return failed_; }
  /// The caller found the line bad and has reported it: the trace ends here.
  bool fail() {
    failed_ = true;
    return false;
  }
  TraceReport& report() { return *report_; }

 private:
  bool take_line(std::string_view& line);

  TraceInput input_;
  TraceReport* report_;
  std::uint64_t line_number_ = 0;
  std::size_t to_consume_ = 0;  // the line handed out last, with its end
  bool failed_ = false;
};

}  // namespace perentie::monitor

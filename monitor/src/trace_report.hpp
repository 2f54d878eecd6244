// Diagnostics about places in a trace that is not kept in memory.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "perentie/monitor/trace_reader.hpp"

namespace perentie::monitor {

/// A record of a trace as it stands in its file, and where it begins.
struct PlacedText {
  std::string_view text;
  TracePlace place;
};

/// Reports about the bytes [begin, end) of `in`, which is excerpted around them.
base::Diagnostic& report_in_trace(TraceReport& report, const base::DiagnosticCode& code,
                                  const PlacedText& in, std::size_t begin, std::size_t end,
                                  std::string message);

}  // namespace perentie::monitor

#include "trace_report.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace perentie::monitor {
namespace {

// How much of a long line is kept on either side of the place.
constexpr std::size_t context_bytes = 256;

bool is_utf8_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::size_t characters(std::string_view text) {
  return text.size() -
         static_cast<std::size_t>(std::count_if(text.begin(), text.end(), is_utf8_continuation));
}

// The place `offset` bytes after the beginning of `in`.
TracePlace place_at(const PlacedText& in, std::size_t offset) {
  const std::string_view before = in.text.substr(0, offset);
  const std::size_t line_end = before.rfind('\n');
  if (line_end == std::string_view::npos) {
    return {in.place.line, in.place.column + characters(before)};
  }
  const auto lines = static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n'));
  return {in.place.line + lines, 1 + characters(before.substr(line_end + 1))};
}

std::uint32_t clamp(std::uint64_t number) {
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(number, std::numeric_limits<std::uint32_t>::max()));
}

}  // namespace

base::Diagnostic& report_in_trace(TraceReport& report, const base::DiagnosticCode& code,
                                  const PlacedText& in, std::size_t begin, std::size_t end,
                                  std::string message) {
  begin = std::min(begin, in.text.size());
  end = std::clamp(end, begin, in.text.size());

  std::size_t from = begin > context_bytes ? begin - context_bytes : 0;
  while (from > 0 && is_utf8_continuation(in.text[from])) --from;
  const std::size_t line_break = in.text.substr(from, begin - from).rfind('\n');
  if (line_break != std::string_view::npos) from += line_break + 1;
  const std::size_t shown_end = std::min(end, begin + context_bytes);

  const TracePlace place = place_at(in, from);
  const std::optional<base::FileId> excerpt = report.sources.add_excerpt(
      {report.path, clamp(place.line), clamp(place.column)},
      std::string(in.text.substr(from, shown_end + context_bytes - from)));
  if (!excerpt) {
    return report.diagnostics.report(
        code, fmt::format("{} (line {} of {})", message, place.line, report.path));
  }
  const base::Offset base = report.sources.span(*excerpt).begin;
  return report.diagnostics.report(code,
                                   {base + static_cast<base::Offset>(begin - from),
                                    base + static_cast<base::Offset>(shown_end - from)},
                                   std::move(message));
}

}  // namespace perentie::monitor

#include "perentie/base/diagnostic.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace perentie::base {
namespace {

// Longer source lines are cut around the caret, so that one-line files stay readable.
constexpr std::size_t max_line_width = 160;

struct Style {
  std::string_view bold = "";
  std::string_view error = "";
  std::string_view warning = "";
  std::string_view note = "";
  std::string_view caret = "";
  std::string_view off = "";
};

Style style_for(bool colour) {
  if (!colour) return {};
  return {"\033[1m", "\033[1;31m", "\033[1;35m", "\033[1;36m", "\033[1;32m", "\033[0m"};
}

// The bytes of a line as one printable column each: tabs and control characters become blanks.
std::string printable(std::string_view line) {
  std::string text(line);
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return text;
}

std::size_t columns(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::string source_excerpt(Span span, const SourceMap& sources, const Style& style) {
  const std::string_view line = sources.line_at(span.begin);
  const Span file = sources.span(sources.file_of(span.begin));
  const auto line_begin = static_cast<std::size_t>(line.data() - sources.text(file).data());
  const std::size_t start =
      std::min<std::size_t>(span.begin - file.begin - line_begin, line.size());
  const std::size_t end =
      std::clamp<std::size_t>(span.end - file.begin - line_begin, start, line.size());

  std::size_t from = 0;
  if (line.size() > max_line_width && start > max_line_width / 2) from = start - max_line_width / 2;
  const std::string_view shown = line.substr(from, max_line_width);
  const std::string_view before = line.substr(from, start - from);
  const std::string_view under = shown.substr(before.size(), end - start);
  const std::string_view lead = from > 0 ? "..." : "";
  const std::string_view tail = from + shown.size() < line.size() ? "..." : "";
  const std::size_t width = std::max<std::size_t>(columns(under), 1);
  return fmt::format("{}{}{}\n{}{}^{}{}\n", lead, printable(shown), tail,
                     std::string(lead.size() + columns(before), ' '), style.caret,
                     std::string(width - 1, '~'), style.off);
}

std::string place(const std::optional<Span>& span, const SourceMap& sources) {
  if (!span) return "perentie: ";
  const Position at = sources.position(span->begin);
  return fmt::format("{}:{}:{}: ", at.path, at.line, at.column);
}

}  // namespace

Diagnostic& Diagnostics::report(const DiagnosticCode& code, Span span, std::string message) {
  return keep({&code, span, std::move(message), {}});
}

Diagnostic& Diagnostics::report(const DiagnosticCode& code, std::string message) {
  return keep({&code, std::nullopt, std::move(message), {}});
}

void Diagnostics::clear() {
  diagnostics_.clear();
  error_count_ = 0;
}

Diagnostic& Diagnostics::keep(Diagnostic diagnostic) {
  if (diagnostic.code->severity == Severity::error && ++error_count_ > max_kept_errors) {
    overflow_ = std::move(diagnostic);
    return overflow_;
  }
  return diagnostics_.emplace_back(std::move(diagnostic));
}

std::string render(const Diagnostic& diagnostic, const SourceMap& sources, bool colour) {
  const Style style = style_for(colour);
  const bool is_error = diagnostic.code->severity == Severity::error;
  std::string text =
      fmt::format("{}{}{}{}{}:{} {}{}{} [{}]\n", style.bold, place(diagnostic.span, sources),
                  style.off, is_error ? style.error : style.warning, is_error ? "error" : "warning",
                  style.off, style.bold, diagnostic.message, style.off, diagnostic.code->id);
  if (diagnostic.span) text += source_excerpt(*diagnostic.span, sources, style);
  for (const Note& note : diagnostic.notes) {
    text += fmt::format("{}{}{}{}note:{} {}\n", style.bold, place(note.span, sources), style.off,
                        style.note, style.off, note.message);
    if (note.span) text += source_excerpt(*note.span, sources, style);
  }
  return text;
}

std::string render_all(const Diagnostics& diagnostics, const SourceMap& sources, bool colour) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.all())
    text += render(diagnostic, sources, colour);
  if (diagnostics.error_count() > Diagnostics::max_kept_errors) {
    text += fmt::format("perentie: {} more errors are not shown\n",
                        diagnostics.error_count() - Diagnostics::max_kept_errors);
  }
  return text;
}

}  // namespace perentie::base

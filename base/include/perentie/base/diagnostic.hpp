// Diagnostics: what we tell a user about their input.
//
// Every step reports into a `Diagnostics` sink and never throws across a library boundary. A
// message is one sentence without final period that names the offending thing in `backquotes`;
// notes say where something was defined or what was probably meant. Each library lists its codes
// once, in its diagnostic_codes.def.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/base/source.hpp"

namespace perentie::base {

enum class Severity : std::uint8_t { error, warning };

/// One kind of diagnostic. Codes are never reused: L lexing, P parsing, N names, T types, E
/// evaluation, M monitor, I files of transition systems, C the program.
struct DiagnosticCode {
  std::string_view id;  ///< such as "P003"
  Severity severity;
  std::string_view title;  ///< what the kind is about, for the list of codes
};

struct Note {
  std::optional<Span> span;
  std::string message;
};

struct Diagnostic {
  const DiagnosticCode* code;
  std::optional<Span> span;  ///< none: the message is about no particular place
  std::string message;
  std::vector<Note> notes;
};

class Diagnostics {
 public:
  /// Errors beyond this number are counted but not kept.
  static constexpr std::size_t max_kept_errors = 100;

  /// Reports at a place. The reference is good until the next report: add notes at once.
  Diagnostic& report(const DiagnosticCode& code, Span span, std::string message);
  /// Reports about the input as a whole.
  Diagnostic& report(const DiagnosticCode& code, std::string message);

  /// Forgets everything reported: what comes next is about something else.
  void clear();

  bool has_errors() const { return error_count_ > 0; }
  std::size_t error_count() const { return error_count_; }
  const std::vector<Diagnostic>& all() const { return diagnostics_; }

 private:
  Diagnostic& keep(Diagnostic diagnostic);

  std::vector<Diagnostic> diagnostics_;
  std::size_t error_count_ = 0;
  Diagnostic overflow_{};
};

/// The clang layout: `file:line:col: error: message [code]`, the source line, a caret under the
/// span, then the notes.
std::string render(const Diagnostic& diagnostic, const SourceMap& sources, bool colour = false);
/// All kept diagnostics in order of report, with a closing line if some were dropped.
std::string render_all(const Diagnostics& diagnostics, const SourceMap& sources,
                       bool colour = false);

}  // namespace perentie::base

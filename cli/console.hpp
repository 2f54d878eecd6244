// Console: everything the program says beside its result. Diagnostics and progress go to standard
// error, results to standard output, so that a result can be piped.
#pragma once

#include <string>
#include <string_view>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/lts/explore.hpp"

namespace perentie::cli {

enum class ColourChoice { automatic, always, never };

class Console {
 public:
  void set_colour(ColourChoice choice);
  void set_quiet(bool quiet) { quiet_ = quiet; }

  /// Prints the diagnostics that were not printed before.
  void print(const base::Diagnostics& diagnostics, const base::SourceMap& sources);
  /// The diagnostics were cleared: none of the next ones was printed before.
  void forget_printed() { printed_ = 0; }
  /// A result, to standard output. That it could not be written is noticed when the program ends.
  void result(std::string_view text) const;
  /// Text of a certain layout to standard error, as it is.
  void log(std::string_view text);
  /// `perentie: error: message`.
  void error(std::string_view message) const;
  /// `perentie: message`; silent with --quiet.
  void note(std::string_view message) const;

  /// One line that is overwritten; only on a terminal. `clear_progress` removes it.
  void progress(const lts::ExploreProgress& progress);
  void clear_progress();

 private:
  std::string styled(std::string_view style, std::string_view text) const;

  bool colour_ = false;
  bool quiet_ = false;
  bool progress_shown_ = false;
  std::size_t printed_ = 0;
};

/// Set by SIGINT (Ctrl-C) and SIGTERM; every long step looks at it.
const std::atomic<bool>& interrupted();
void catch_interrupts();
/// What comes next was not interrupted yet.
void forget_interrupt();

}  // namespace perentie::cli

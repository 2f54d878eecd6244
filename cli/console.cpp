#include "console.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "perentie/base/text.hpp"

namespace perentie::cli {
namespace {

std::atomic<bool> interrupt_flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets the flag");

// Unlike fmt::print, throws nothing if the file is full or closed.
void write(std::FILE* file, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), file);
}

bool is_terminal() { return isatty(STDERR_FILENO) != 0; }

bool terminal_has_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  const bool refused = no_colour != nullptr && *no_colour != '\0';
  return is_terminal() && !refused && term != nullptr && std::string_view(term) != "dumb";
}

}  // namespace

void Console::set_colour(ColourChoice choice) {
  colour_ = choice == ColourChoice::always ||
            (choice == ColourChoice::automatic && terminal_has_colour());
}

std::string Console::styled(std::string_view style, std::string_view text) const {
  return colour_ ? fmt::format("\033[{}m{}\033[0m", style, text) : std::string(text);
}

void Console::print(const base::Diagnostics& diagnostics, const base::SourceMap& sources) {
  clear_progress();
  for (; printed_ < diagnostics.all().size(); ++printed_) {
    write(stderr, base::render(diagnostics.all()[printed_], sources, colour_));
  }
  if (diagnostics.error_count() > base::Diagnostics::max_kept_errors) {
    note(fmt::format("{} more errors are not shown",
                     diagnostics.error_count() - base::Diagnostics::max_kept_errors));
  }
}

// What was found is not lost if the program is killed afterwards.
void Console::result(std::string_view text) const {
  write(stdout, text);
  std::fflush(stdout);
}

void Console::log(std::string_view text) {
  clear_progress();
  write(stderr, text);
}

void Console::error(std::string_view message) const {
  write(stderr, fmt::format("perentie: {} {}\n", styled("1;31", "error:"), message));
}

void Console::note(std::string_view message) const {
  if (!quiet_) write(stderr, fmt::format("perentie: {}\n", message));
}

void Console::progress(const lts::ExploreProgress& progress) {
  if (quiet_ || !is_terminal()) return;
  write(
      stderr,
      fmt::format("\r\033[Kstates {}  transitions {}  ply {}  frontier {}  {} MB  {:.0f} s",
                  base::with_thousands(progress.states), base::with_thousands(progress.transitions),
                  progress.ply, base::with_thousands(progress.frontier), progress.bytes >> 20U,
                  progress.seconds));
  std::fflush(stderr);
  progress_shown_ = true;
}

void Console::clear_progress() {
  if (progress_shown_) write(stderr, "\r\033[K");
  progress_shown_ = false;
}

const std::atomic<bool>& interrupted() { return interrupt_flag; }

void catch_interrupts() {
  // A second signal ends the program at once: the first restores the default action.
  for (const int signal : {SIGINT, SIGTERM}) {
    std::signal(signal, [](int caught) {
      interrupt_flag.store(true);
      std::signal(caught, SIG_DFL);
    });
  }
}

void forget_interrupt() {
  interrupt_flag.store(false);
  catch_interrupts();
}

}  // namespace perentie::cli

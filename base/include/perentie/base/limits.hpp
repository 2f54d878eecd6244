// Budgets: what a long step may use, and how it says that a budget ran out.
//
// An exhausted budget is a value in the step's result (`LimitReached`), reported to the user as
// *inconclusive*; it is never an error and never a verdict.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace perentie::base {

enum class LimitKind : std::uint8_t { states, memory, depth, time, cancelled };

struct LimitReached {
  LimitKind kind;
  std::uint64_t limit = 0;  ///< states, bytes (0: all that there are), levels or milliseconds
};

/// One sentence without final period, such as "the limit of 1,000 states was reached".
std::string describe(const LimitReached& reached);

struct Limits {
  std::optional<std::uint64_t> max_states = {};
  std::optional<std::uint64_t> max_memory_bytes = {};
  std::optional<std::chrono::milliseconds> timeout = {};
  std::chrono::milliseconds time_used = {};  ///< of `timeout`, before the run began
  /// Threads that share the work of one step, where they can. No result depends on it, but how far
  /// a search comes that memory or time ends.
  unsigned workers = 1;
  const std::atomic<bool>* cancelled = nullptr;  ///< set from a signal handler or another thread
};

/// The limits of one run with the moment it began.
class Budget {
 public:
  explicit Budget(Limits limits) : limits_(limits), start_(Clock::now()) {}

  /// Time and cancellation. Costs a clock read: call it every few thousand units of work.
  std::optional<LimitReached> check_time() const;
  std::optional<LimitReached> check_states(std::uint64_t states) const;
  std::optional<LimitReached> check_memory(std::uint64_t bytes) const;

  double elapsed_seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }
  const Limits& limits() const { return limits_; }
  /// The limits of a step that begins now: what is left of the time.
  Limits rest() const;

 private:
  using Clock = std::chrono::steady_clock;

  Limits limits_;
  Clock::time_point start_;
};

}  // namespace perentie::base

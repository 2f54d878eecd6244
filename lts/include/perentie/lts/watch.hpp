// Watch: looks at the clock of a budget often enough to stop in time, and seldom enough to cost
// nothing.
//
// A long loop asks `due()` once per unit of work. Units may take nanoseconds or seconds: the watch
// spaces its looks so that about a millisecond passes between two of them.
#pragma once

#include <cstdint>
#include <optional>

#include "perentie/base/limits.hpp"

namespace perentie::lts {

class Watch {
 public:
  explicit Watch(const base::Limits& limits) : budget_(limits) {}

  /// Whether a look is due after this unit of work. True at the first call.
  bool due() { return --countdown_ == 0; }
  /// The time limit or the cancellation, if reached. Call it when a look is due.
  std::optional<base::LimitReached> look();

  /// Whether a report of progress is due after a look: about every 100 ms.
  bool report_due();

  const base::Budget& budget() const { return budget_; }

 private:
  base::Budget budget_;
  std::uint32_t countdown_ = 1;
  std::uint32_t spacing_ = 1;  // units of work from one look to the next
  double last_look_ = 0;       // seconds since the budget began
  double last_report_ = 0;
};

}  // namespace perentie::lts

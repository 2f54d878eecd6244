#include "perentie/lts/watch.hpp"

#include <algorithm>

namespace perentie::lts {

std::optional<base::LimitReached> Watch::look() {
  constexpr double target_seconds = 1e-3;
  constexpr std::uint32_t max_spacing = 1U << 16U;
  const double now = budget_.elapsed_seconds();
  const double elapsed = now - last_look_;
  last_look_ = now;
  if (elapsed < target_seconds) {
    spacing_ = std::min(spacing_ * 2, max_spacing);
  } else {
    spacing_ = std::max(static_cast<std::uint32_t>(spacing_ * (target_seconds / elapsed)), 1U);
  }
  countdown_ = spacing_;
  return budget_.check_time();
}

bool Watch::report_due() {
  constexpr double seconds_between_reports = 0.1;
  if (last_look_ - last_report_ < seconds_between_reports) return false;
  last_report_ = last_look_;
  return true;
}

}  // namespace perentie::lts

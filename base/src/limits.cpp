#include "perentie/base/limits.hpp"

#include <fmt/format.h>

#include "perentie/base/text.hpp"

namespace perentie::base {

std::string describe(const LimitReached& reached) {
  switch (reached.kind) {
    case LimitKind::states:
      return fmt::format("the limit of {} states was reached", with_thousands(reached.limit));
    case LimitKind::memory:
      if (reached.limit == 0) return "the system has no more memory to give";
      return fmt::format("the limit of {} bytes of memory was reached",
                         with_thousands(reached.limit));
    case LimitKind::depth:
      return fmt::format("the limit of {} nested evaluations was reached",
                         with_thousands(reached.limit));
    case LimitKind::time:
      return fmt::format("the time limit of {:g} s was reached",
                         static_cast<double>(reached.limit) / 1000.0);
    case LimitKind::cancelled:
      return "the run was interrupted";
  }
  return {};
}

std::optional<LimitReached> Budget::check_time() const {
  if (limits_.cancelled != nullptr && limits_.cancelled->load(std::memory_order_relaxed)) {
    return LimitReached{LimitKind::cancelled};
  }
  if (limits_.timeout && Clock::now() - start_ + limits_.time_used > *limits_.timeout) {
    return LimitReached{LimitKind::time, static_cast<std::uint64_t>(limits_.timeout->count())};
  }
  return std::nullopt;
}

Limits Budget::rest() const {
  Limits rest = limits_;
  rest.time_used += std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start_);
  return rest;
}

std::optional<LimitReached> Budget::check_states(std::uint64_t states) const {
  if (limits_.max_states && states > *limits_.max_states) {
    return LimitReached{LimitKind::states, *limits_.max_states};
  }
  return std::nullopt;
}

std::optional<LimitReached> Budget::check_memory(std::uint64_t bytes) const {
  if (limits_.max_memory_bytes && bytes > *limits_.max_memory_bytes) {
    return LimitReached{LimitKind::memory, *limits_.max_memory_bytes};
  }
  return std::nullopt;
}

}  // namespace perentie::base

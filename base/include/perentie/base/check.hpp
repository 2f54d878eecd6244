// PERENTIE_CHECK: a condition that only a bug of ours can break.
//
// User errors are diagnostics and exhausted budgets are values; neither goes through here.
// A broken check prints where and why, says that the bug is ours, and aborts.
#pragma once

namespace perentie::base {

[[noreturn]] void check_failed(const char* file, int line, const char* condition,
                               const char* message);

}  // namespace perentie::base

// A macro because the condition's text and place are part of the message (clang 14 lacks
// std::source_location).
#define PERENTIE_CHECK(condition, message)                                     \
  do {                                                                         \
    if (!(condition)) {                                                        \
      ::perentie::base::check_failed(__FILE__, __LINE__, #condition, message); \
    }                                                                          \
  } while (false)

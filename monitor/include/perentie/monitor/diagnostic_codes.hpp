// The diagnostic codes of the monitor library, from diagnostic_codes.def.
#pragma once

#include <array>

#include "perentie/base/diagnostic.hpp"

namespace perentie::monitor::codes {

#define PERENTIE_MONITOR_DIAGNOSTIC(name, id, severity, title) \
  inline constexpr base::DiagnosticCode name{id, base::Severity::severity, title};
#include "perentie/monitor/diagnostic_codes.def"
#undef PERENTIE_MONITOR_DIAGNOSTIC

/// All of them, in the order of their ids.
inline constexpr auto all = std::to_array<const base::DiagnosticCode*>({
#define PERENTIE_MONITOR_DIAGNOSTIC(name, id, severity, title) &name,
#include "perentie/monitor/diagnostic_codes.def"
#undef PERENTIE_MONITOR_DIAGNOSTIC
});

}  // namespace perentie::monitor::codes

// The diagnostics of the lts library by name; the table is diagnostic_codes.def.
#pragma once

#include <array>

#include "perentie/base/diagnostic.hpp"

namespace perentie::lts::codes {

#define PERENTIE_DIAGNOSTIC(name, id, severity, title) \
  inline constexpr base::DiagnosticCode name{id, base::Severity::severity, title};
#include "perentie/lts/diagnostic_codes.def"
#undef PERENTIE_DIAGNOSTIC

/// All of them, in the order of their codes.
inline constexpr auto all = std::to_array<const base::DiagnosticCode*>({
#define PERENTIE_DIAGNOSTIC(name, id, severity, title) &name,
#include "perentie/lts/diagnostic_codes.def"
#undef PERENTIE_DIAGNOSTIC
});

}  // namespace perentie::lts::codes

// The diagnostics of the semantics library as constants.
#pragma once

#include <array>

#include "perentie/base/diagnostic.hpp"

namespace perentie::semantics::codes {

#define PERENTIE_DIAGNOSTIC(name, id, severity, title) \
  inline constexpr base::DiagnosticCode name{id, base::Severity::severity, title};
#include "perentie/semantics/diagnostic_codes.def"
#undef PERENTIE_DIAGNOSTIC

inline constexpr auto all = std::to_array<const base::DiagnosticCode*>({
#define PERENTIE_DIAGNOSTIC(name, id, severity, title) &name,
#include "perentie/semantics/diagnostic_codes.def"
#undef PERENTIE_DIAGNOSTIC
});

}  // namespace perentie::semantics::codes

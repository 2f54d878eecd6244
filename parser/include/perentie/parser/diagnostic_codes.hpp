// The diagnostics of the parser library by name; the table is diagnostic_codes.def.
#pragma once

#include <array>

#include "perentie/base/diagnostic.hpp"

namespace perentie::parser::codes {

#define PERENTIE_DIAGNOSTIC(name, id, severity, title) \
  inline constexpr base::DiagnosticCode name{id, base::Severity::severity, title};
#include "perentie/parser/diagnostic_codes.def"
#undef PERENTIE_DIAGNOSTIC

/// All of them, in the order of their codes.
inline constexpr auto all = std::to_array<const base::DiagnosticCode*>({
#define PERENTIE_DIAGNOSTIC(name, id, severity, title) &name,
#include "perentie/parser/diagnostic_codes.def"
#undef PERENTIE_DIAGNOSTIC
});

}  // namespace perentie::parser::codes

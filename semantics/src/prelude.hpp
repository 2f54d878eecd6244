// The text of prelude.csp, embedded at build time.
#pragma once

#include <string_view>

namespace perentie::semantics {

extern const std::string_view prelude_text;

}  // namespace perentie::semantics

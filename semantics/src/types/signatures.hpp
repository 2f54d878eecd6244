// The text of signatures.csp, embedded at build time.
#pragma once

#include <string_view>

namespace perentie::semantics {

extern const std::string_view signatures_text;

}  // namespace perentie::semantics

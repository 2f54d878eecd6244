// Values in messages: as `show` prints them, but cut when long, and without names of functions.
#pragma once

#include <string>

#include "perentie/semantics/symbols.hpp"
#include "perentie/semantics/value.hpp"

namespace perentie::semantics {

std::string brief(const ValueStore& values, const Resolution& resolution, ValueId value);

}  // namespace perentie::semantics

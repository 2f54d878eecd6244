// Topic patterns: `*` stands for any characters but `/`, `**` for any characters.
#pragma once

#include <string_view>

namespace perentie::monitor {

bool matches_glob(std::string_view pattern, std::string_view text);

}  // namespace perentie::monitor

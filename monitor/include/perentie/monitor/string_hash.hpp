// StringHash: lets a hash table of strings be asked with a string_view, without a copy.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

namespace perentie::monitor {

struct StringHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const noexcept {
    return std::hash<std::string_view>{}(text);
  }
};

}  // namespace perentie::monitor

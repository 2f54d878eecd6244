// JSON at the level of its text: strings without their escapes, and where a text stops being JSON.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace perentie::monitor {

/// Appends the characters that the inside of a JSON string (without its quotation marks) stands
/// for. False if it has an escape that JSON does not know or half a surrogate pair.
bool append_unescaped(std::string_view inside, std::string& out);

struct JsonFault {
  std::size_t begin = 0;  ///< bytes of the text: the token that cannot stand there
  std::size_t end = 0;
  bool cut_off = false;  ///< the text ends before it is complete
};

/// The first fault of a text that should be one JSON value; none if it is one. NaN, Infinity and
/// -Infinity, which Python writes, count as numbers. For messages, not for speed.
std::optional<JsonFault> find_json_fault(std::string_view text);

}  // namespace perentie::monitor

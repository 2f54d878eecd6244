// The JSON text of a field to what stands for it in an event.
//
// Strings give their characters, integers and booleans themselves, a number such as 38.0 the
// integer (CSPM has no fractions), other numbers their text, a list its elements with dots between
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace perentie::monitor {

enum class FieldKind : std::uint8_t {
  value,      ///< text was appended
  null,       ///< null or an empty list: nothing was appended
  nested,     ///< an object, or a list of something else than single values
  malformed,  ///< not JSON
};

FieldKind append_text(std::string_view field, std::string& out);

/// The number that a JSON number, or a string that holds one, stands for. Finite.
std::optional<double> to_number(std::string_view field);

/// Appends such a number cut to an integer, towards zero. False if it is none.
bool append_integer(std::string_view field, std::string& out);

}  // namespace perentie::monitor

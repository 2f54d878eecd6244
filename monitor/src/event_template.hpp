// Event templates: `inspect.{location}` and `{channel}[.{data}]` as parts.
//
// `{x}` is a value, `[...]` an optional group, `{{`, `}}`, `[[` and `]]` are the brackets
// themselves.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "perentie/monitor/mapping.hpp"

namespace perentie::monitor {

/// A template, or what is wrong with it.
struct ParsedTemplate {
  EventTemplate parts;
  std::string error;  ///< empty: nothing
};

/// Parses a template; `value_index(name)` gives the value that `{name}` stands for, or none.
ParsedTemplate parse_event_template(
    std::string_view text,
    const std::function<std::optional<std::uint32_t>(std::string_view)>& value_index);

}  // namespace perentie::monitor

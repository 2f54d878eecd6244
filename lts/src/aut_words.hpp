// How labels are spelt in .aut files, for the writer and the reader of them.
#pragma once

#include <string>
#include <string_view>

namespace perentie::lts {

inline constexpr std::string_view aut_tick = "tick";

/// The text between the quotes for an event: escaped, and not mistaken for the words of τ and ✓.
std::string escape_aut_event(std::string_view name, std::string_view tau_word);
/// The name for the text between the quotes. A backslash that begins no escape stands for itself.
std::string unescape_aut(std::string_view text);

}  // namespace perentie::lts

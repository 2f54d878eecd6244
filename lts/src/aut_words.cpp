#include "aut_words.hpp"

#include <fmt/format.h>

#include <charconv>

namespace perentie::lts {

namespace {

std::string as_hex(char c) { return fmt::format("\\x{:02x}", static_cast<unsigned char>(c)); }

std::string escaped(char c) {
  switch (c) {
    case '"':
      return "\\\"";
    case '\\':
      return "\\\\";
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? as_hex(c) : std::string(1, c);
  }
}

/// The character that the escape at the start of `text` stands for, and its length there; length 0
/// if there is no escape.
struct Escape {
  char character = 0;
  std::size_t length = 0;
};
Escape escape_at(std::string_view text) {
  if (text.size() < 2 || text[0] != '\\') return {};
  switch (text[1]) {
    case '"':
    case '\\':
      return {text[1], 2};
    case 'n':
      return {'\n', 2};
    case 'r':
      return {'\r', 2};
    case 't':
      return {'\t', 2};
    case 'x': {
      unsigned char code = 0;
      const std::string_view digits = text.substr(2, 2);
      const auto [end, error] =
          std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
      if (error != std::errc{} || end != text.data() + 4) return {};
      return {static_cast<char>(code), 4};
    }
    default:
      return {};
  }
}

}  // namespace

std::string escape_aut_event(std::string_view name, std::string_view tau_word) {
  if (!name.empty() && (name == tau_word || name == aut_tick)) {
    return as_hex(name[0]) + escape_aut_event(name.substr(1), {});
  }
  std::string text;
  for (const char c : name) text += escaped(c);
  return text;
}

std::string unescape_aut(std::string_view text) {
  std::string name;
  while (!text.empty()) {
    const Escape escape = escape_at(text);
    name += escape.length > 0 ? escape.character : text[0];
    text.remove_prefix(escape.length > 0 ? escape.length : 1);
  }
  return name;
}

}  // namespace perentie::lts

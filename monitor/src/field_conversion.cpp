#include "field_conversion.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "json_text.hpp"

namespace perentie::monitor {
namespace {

// Below this, every integer is a double of its own.
constexpr double exact_integers = 9007199254740992.0;  // 2^53

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// An optional sign and digits, nothing else.
bool is_integer_text(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

// A finite number; one too large for a double is an infinity.
std::optional<double> parse_double(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;  // the words `inf`, `nan`
  return value;
}

void append_integer_text(std::string_view text, std::string& out) {
  out += text == "-0" ? std::string_view("0") : text;
}

FieldKind append_number(std::string_view field, std::string& out) {
  if (is_integer_text(field)) {
    append_integer_text(field, out);
    return FieldKind::value;
  }
  const std::optional<double> number = parse_double(field);
  if (!number) return FieldKind::malformed;
  if (std::trunc(*number) == *number && std::abs(*number) < exact_integers) {
    out += std::to_string(static_cast<std::int64_t>(*number));
  } else {
    out += field;
  }
  return FieldKind::value;
}

FieldKind append_string(std::string_view field, std::string& out) {
  if (field.size() < 2 || !field.ends_with('"')) return FieldKind::malformed;
  return append_unescaped(field.substr(1, field.size() - 2), out) ? FieldKind::value
                                                                  : FieldKind::malformed;
}

// The element at the front of the inside of a list, which it is removed from with its comma.
std::string_view take_element(std::string_view& inside) {
  bool quoted = false;
  std::size_t end = 0;
  for (; end < inside.size() && (quoted || inside[end] != ','); ++end) {
    if (quoted && inside[end] == '\\') {
      ++end;
    } else if (inside[end] == '"') {
      quoted = !quoted;
    }
  }
  end = std::min(end, inside.size());
  std::string_view element = inside.substr(0, end);
  inside.remove_prefix(std::min(end + 1, inside.size()));
  element.remove_prefix(std::min(element.find_first_not_of(" \t\r\n"), element.size()));
  return element.substr(0, element.find_last_not_of(" \t\r\n") + 1);
}

FieldKind append_list(std::string_view field, std::string& out) {
  std::string_view inside = field.substr(1, field.size() - 2);
  if (inside.find_first_not_of(" \t\r\n") == std::string_view::npos) return FieldKind::null;
  for (bool first = true; !inside.empty(); first = false) {
    const std::string_view element = take_element(inside);
    if (element.starts_with('{') || element.starts_with('[') || element == "null") {
      return FieldKind::nested;
    }
    if (!first) out += '.';
    if (append_text(element, out) != FieldKind::value) return FieldKind::malformed;
  }
  return FieldKind::value;
}

// What is inside the quotation marks of a string; a number as it is.
std::string_view number_text(std::string_view field) {
  if (field.size() >= 2 && field.starts_with('"')) return field.substr(1, field.size() - 2);
  return field;
}

}  // namespace

FieldKind append_text(std::string_view field, std::string& out) {
  if (field.empty()) return FieldKind::malformed;
  switch (field.front()) {
    case '"':
      return append_string(field, out);
    case '[':
      return append_list(field, out);
    case '{':
      return FieldKind::nested;
    default:
      break;
  }
  if (field == "null") return FieldKind::null;
  if (field == "true" || field == "false" || field == "NaN" || field == "Infinity" ||
      field == "-Infinity") {
    out += field;
    return FieldKind::value;
  }
  return append_number(field, out);
}

std::optional<double> to_number(std::string_view field) {
  const std::optional<double> number = parse_double(number_text(field));
  if (!number || !std::isfinite(*number)) return std::nullopt;
  return number;
}

bool append_integer(std::string_view field, std::string& out) {
  const std::string_view text = number_text(field);
  if (is_integer_text(text)) {
    append_integer_text(text, out);
    return true;
  }
  const std::optional<double> number = to_number(field);
  if (!number) return false;
  const double whole = std::trunc(*number);
  out += fmt::format("{:.0f}", whole == 0 ? 0.0 : whole);  // no negative zero
  return true;
}

}  // namespace perentie::monitor

#include "json_text.hpp"

#include <algorithm>
#include <cstdint>

#include <nlohmann/json.hpp>

namespace perentie::monitor {
namespace {

std::optional<std::uint32_t> hex4(std::string_view text) {
  if (text.size() < 4) return std::nullopt;
  std::uint32_t value = 0;
  for (const char c : text.substr(0, 4)) {
    std::uint32_t digit = 0;
    if (c >= '0' && c <= '9') {
      digit = static_cast<std::uint32_t>(c - '0');
    } else if (c >= 'a' && c <= 'f') {
      digit = static_cast<std::uint32_t>(c - 'a') + 10;
    } else if (c >= 'A' && c <= 'F') {
      digit = static_cast<std::uint32_t>(c - 'A') + 10;
    } else {
      return std::nullopt;
    }
    value = value * 16 + digit;
  }
  return value;
}

void append_utf8(std::uint32_t code_point, std::string& out) {
  const auto put = [&out](std::uint32_t byte) { out += static_cast<char>(byte); };
  if (code_point < 0x80) {
    put(code_point);
  } else if (code_point < 0x800) {
    put(0xC0U | (code_point >> 6U));
    put(0x80U | (code_point & 0x3FU));
  } else if (code_point < 0x10000) {
    put(0xE0U | (code_point >> 12U));
    put(0x80U | ((code_point >> 6U) & 0x3FU));
    put(0x80U | (code_point & 0x3FU));
  } else {
    put(0xF0U | (code_point >> 18U));
    put(0x80U | ((code_point >> 12U) & 0x3FU));
    put(0x80U | ((code_point >> 6U) & 0x3FU));
    put(0x80U | (code_point & 0x3FU));
  }
}

// Reads what follows `\u`, with the second half of a surrogate pair, and removes it from `rest`.
bool append_code_point(std::string_view& rest, std::string& out) {
  std::optional<std::uint32_t> code = hex4(rest);
  if (!code) return false;
  rest.remove_prefix(4);
  if (*code >= 0xD800 && *code < 0xDC00) {
    const std::optional<std::uint32_t> low =
        rest.starts_with("\\u") ? hex4(rest.substr(2)) : std::nullopt;
    if (!low || *low < 0xDC00 || *low >= 0xE000) return false;
    rest.remove_prefix(6);
    code = 0x10000 + ((*code - 0xD800) << 10U) + (*low - 0xDC00);
  } else if (*code >= 0xDC00 && *code < 0xE000) {
    return false;
  }
  append_utf8(*code, out);
  return true;
}

// NaN and the infinities become numbers of the same length, so that places stay what they are.
std::string with_plain_numbers(std::string_view text) {
  std::string plain(text);
  bool quoted = false;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    if (plain[i] == '"') quoted = !quoted;
    if (quoted && plain[i] == '\\') ++i;
    if (quoted || i >= plain.size()) continue;
    for (const std::string_view word :
         {std::string_view("-Infinity"), std::string_view("Infinity"), std::string_view("NaN")}) {
      if (std::string_view(plain).substr(i).starts_with(word)) {
        std::fill_n(plain.begin() + static_cast<std::ptrdiff_t>(i), word.size(), ' ');
        plain[i] = '0';
      }
    }
  }
  return plain;
}

// Takes everything and remembers where the parser stopped.
struct FaultFinder : nlohmann::json_sax<nlohmann::json> {
  std::size_t stopped_after = 0;  // bytes read, with the offending token's
  std::string token;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string& last_token,
                   const nlohmann::json::exception&) override {
    stopped_after = position;
    token = last_token;
    return false;
  }
};

}  // namespace

bool append_unescaped(std::string_view inside, std::string& out) {
  for (;;) {
    const std::size_t escape = inside.find('\\');
    out += inside.substr(0, escape);
    if (escape == std::string_view::npos) return true;
    if (escape + 1 == inside.size()) return false;
    const char c = inside[escape + 1];
    inside.remove_prefix(escape + 2);
    switch (c) {
      case '"':
      case '\\':
      case '/':
        out += c;
        break;
      case 'b':
        out += '\b';
        break;
      case 'f':
        out += '\f';
        break;
      case 'n':
        out += '\n';
        break;
      case 'r':
        out += '\r';
        break;
      case 't':
        out += '\t';
        break;
      case 'u':
        if (!append_code_point(inside, out)) return false;
        break;
      default:
        return false;
    }
  }
}

std::optional<JsonFault> find_json_fault(std::string_view text) {
  const std::string plain = with_plain_numbers(text);
  FaultFinder finder;
  if (nlohmann::json::sax_parse(plain, &finder)) return std::nullopt;
  JsonFault fault;
  fault.cut_off = finder.stopped_after > plain.size();
  fault.end = std::min(finder.stopped_after, text.size());
  fault.begin = fault.end;
  if (fault.cut_off || fault.end == 0) return fault;
  // The parser stops at the first character that cannot stand there, or behind a string that
  // cannot; what it calls the last token may begin earlier than that.
  const bool is_string = finder.token.size() > 1 && finder.token.front() == '"' &&
                         finder.token.back() == '"' && finder.token.size() <= fault.end;
  fault.begin -= is_string ? finder.token.size() : 1;
  return fault;
}

}  // namespace perentie::monitor

// Numbers, characters and strings (CSPM reference 1.4).
//
// In characters and strings `\n`, `\r` and `\t` are control characters and `\x` is x for every
// other x. A string may hold any byte but a newline.

#include <fmt/format.h>

#include "lexer_state.hpp"
#include "perentie/parser/diagnostic_codes.hpp"

namespace perentie::parser {
namespace {

char unescape(char c) {
  switch (c) {
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    default:
      return c;
  }
}

bool is_ascii(char c) { return static_cast<signed char>(c) >= 0; }

}  // namespace

void Lexer::scan_number() {
  const std::size_t begin = at_;
  std::int64_t value = 0;
  bool too_large = false;
  for (; peek() >= '0' && peek() <= '9'; ++at_) {
    const std::int64_t digit = peek() - '0';
    too_large = too_large || value > (largest_integer - digit) / 10;
    if (!too_large) value = value * 10 + digit;
  }
  if (too_large) {
    report(codes::integer_too_large, begin, at_,
           fmt::format("this number is too large: the largest is {}", largest_integer));
  }
  out_->integers.push_back(value);
  emit(TokenKind::integer, begin, at_, static_cast<std::uint32_t>(out_->integers.size() - 1));
}

void Lexer::scan_character() {
  const std::size_t begin = at_;
  const bool escaped = peek(1) == '\\';
  const std::size_t length = escaped ? 4 : 3;
  const char c = peek(length - 2);
  if (begin + length <= text_.size() && peek(length - 1) == '\'' && c != '\n' && is_ascii(c)) {
    at_ += length;
    const auto byte = static_cast<unsigned char>(escaped ? unescape(c) : c);
    return emit(TokenKind::character, begin, at_, byte);
  }
  // Take a short quoted text on this line as a whole, so that its rest is not read as CSPM.
  constexpr std::size_t longest = 40;
  const std::string_view rest = text_.substr(begin + 1, longest);
  const std::size_t stop = rest.find_first_of("'\n");
  at_ = stop != std::string_view::npos && rest[stop] == '\'' ? begin + 1 + stop + 1 : begin + 1;
  base::Diagnostic& diagnostic =
      report(codes::bad_character_literal, begin, at_,
             "a character literal is exactly one ASCII character between quotes, such as `'a'`");
  if (at_ > begin + 3) diagnostic.notes.push_back({std::nullopt, "strings are written `\"..\"`"});
  emit(TokenKind::error, begin, at_);
}

void Lexer::scan_string() {
  const std::size_t begin = at_;
  const auto in_line = [&](std::size_t i) { return i < text_.size() && text_[i] != '\n'; };
  std::string value;
  for (++at_; in_line(at_) && text_[at_] != '"'; ++at_) {
    const bool escaped = text_[at_] == '\\' && in_line(at_ + 1);
    if (escaped) ++at_;
    value.push_back(escaped ? unescape(text_[at_]) : text_[at_]);
  }
  if (in_line(at_)) {
    ++at_;
  } else {
    report(codes::bad_string, begin, begin + 1, "this string is not closed on its line");
  }
  emit(TokenKind::string, begin, at_, intern(value));
}

}  // namespace perentie::parser

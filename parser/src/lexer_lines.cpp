// What takes a whole line or a bracket of its own: `include`, `print`, `[T=` and `:[..]`
// (CSPM reference 1.3.5, 1.6.3, 1.6.5, 2.8).
#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "lexer_state.hpp"
#include "perentie/base/text.hpp"
#include "perentie/parser/diagnostic_codes.hpp"
#include "perentie/parser/spelling.hpp"

namespace perentie::parser {
namespace {

constexpr std::string_view blanks = " \t\r\f\v";

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_alpha(char c) { return is_upper(c) || (c >= 'a' && c <= 'z'); }

constexpr auto known_properties = std::to_array<std::string_view>(
    {"deadlock free", "livelock free", "divergence free", "deterministic", "has trace",
     "tau priority", "tau priority over", "partial order reduce"});

}  // namespace

// After the word `include`. The path runs from quote to quote; whatever follows on the line is read
// as usual.
void Lexer::scan_include(std::size_t word_begin) {
  const bool alone = line_start_;
  const std::size_t line_end = end_of_line();
  const std::string_view line = text_.substr(0, line_end);
  const std::size_t open = std::min(line.find_first_not_of(blanks, at_), line_end);
  const bool quoted = open < line_end && line[open] == '"';
  const std::size_t close = quoted ? line.find('"', open + 1) : std::string_view::npos;
  if (alone && close != std::string_view::npos && close > open + 1) {
    at_ = close + 1;
    stop_after_include_ = true;
    return emit(TokenKind::include_, open, at_, intern(line.substr(open + 1, close - open - 1)));
  }
  at_ = line_end;
  report(codes::bad_include_line, word_begin, std::max(at_, word_begin + 1),
         alone ? "an include is written `include \"file.csp\"`"
               : "`include` is a reserved word and must begin its line");
  emit(TokenKind::error, word_begin, at_);
}

// After the word `print`: if a blank follows, the rest of the line is the text of an expression,
// which is not read here. Otherwise `print` is an ordinary name (1.3.5).
bool Lexer::scan_print() {
  if (peek() != ' ' && peek() != '\t') return false;
  const std::size_t line_end = end_of_line();
  const std::size_t begin = std::min(text_.find_first_not_of(blanks, at_), line_end);
  if (begin == line_end) return false;
  std::size_t end = line_end;
  while (blanks.find(text_[end - 1]) != std::string_view::npos) --end;
  at_ = end;
  emit(TokenKind::print_, begin, end, intern(text_.substr(begin, end - begin)));
  return true;
}

// `[T=` and its like, without blanks inside. Not `[T==`, which compares.
bool Lexer::scan_refines() {
  std::size_t end = at_ + 1;
  while (end < text_.size() && is_upper(text_[end])) ++end;
  const bool has_sign =
      end < text_.size() && text_[end] == '=' && (end + 1 == text_.size() || text_[end + 1] != '=');
  const std::optional<Model> model = model_of(text_.substr(at_ + 1, end - at_ - 1));
  if (!has_sign || !model) return false;
  const std::size_t begin = at_;
  at_ = end + 1;
  emit(TokenKind::refines, begin, at_, static_cast<std::uint32_t>(*model));
  return true;
}

// At `:[`. Blanks and comments may stand between the parts, newlines before brackets; a `:`
// directly after the closing bracket belongs to it.
void Lexer::scan_property() {
  const std::size_t begin = at_;
  at_ += 2;
  emit(TokenKind::property_open, begin, at_);
  while (true) {
    skip_gap();
    const bool continues = !gap_.newline;
    gap_.newline = false;
    if (is_alpha(peek()) && continues) {
      scan_property_word();
    } else if (peek() == '[') {
      scan_property_parameter();
    } else {
      break;
    }
  }
  if (peek() == ']') {
    const std::size_t close = at_;
    at_ += peek(1) == ':' ? 2U : 1U;
    return emit(TokenKind::property_close, close, at_);
  }
  report(codes::unclosed_property, begin, begin + 2, "this property is not closed by `]`");
  emit(TokenKind::error, at_, at_);
}

// Words with single blanks or `-` between them, as one token.
void Lexer::scan_property_word() {
  const std::size_t begin = at_;
  std::string words;
  while (true) {
    while (is_alpha(peek())) words.push_back(text_[at_++]);
    std::size_t next = at_;
    if (peek() == '-') ++next;
    while (next < text_.size() && text_[next] == ' ') ++next;
    if (next == at_ || next >= text_.size() || !is_alpha(text_[next])) break;
    words.push_back(' ');
    at_ = next;
  }
  if (const std::optional<PropertyWord> word = property_word_of(words)) {
    return emit(TokenKind::property, begin, at_, static_cast<std::uint32_t>(*word));
  }
  base::Diagnostic& diagnostic =
      report(codes::unknown_property, begin, at_, fmt::format("`{}` is not a property", words));
  for (const std::string_view near : base::nearest_words(words, known_properties, 1)) {
    diagnostic.notes.push_back({std::nullopt, fmt::format("did you mean `{}`?", near)});
  }
  emit(TokenKind::error, begin, at_);
}

// `[FD]`: a model, or the strength of a partial order reduction.
void Lexer::scan_property_parameter() {
  const std::size_t begin = at_;
  constexpr std::size_t longest = 40;
  std::string_view word = text_.substr(begin + 1, longest);
  word = word.substr(0, word.find_first_of("]\n"));
  at_ = begin + 1 + word.size();
  if (peek() == ']') ++at_;
  word.remove_prefix(std::min(word.find_first_not_of(blanks), word.size()));
  word = word.substr(0, word.find_last_not_of(blanks) + 1);
  if (const std::optional<Model> model = model_of(word)) {
    return emit(TokenKind::property_model, begin, at_, static_cast<std::uint32_t>(*model));
  }
  if (const std::optional<PartialOrderMode> mode = reduction_of(word)) {
    return emit(TokenKind::property_reduction, begin, at_, static_cast<std::uint32_t>(*mode));
  }
  report(codes::unknown_property, begin, at_,
         fmt::format("`{}` is neither a model nor a reduction", word))
      .notes.push_back({std::nullopt,
                        "the models are `T`, `F`, `FD`, `V`, `VD`, `R` and `RD`; the reductions "
                        "are `precise`, `hybrid` and `fast`"});
  emit(TokenKind::error, begin, at_);
}

}  // namespace perentie::parser

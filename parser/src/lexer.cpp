#include "perentie/parser/lexer.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>

#include "lexer_state.hpp"
#include "perentie/parser/diagnostic_codes.hpp"

namespace perentie::parser {
namespace {

// After so many unreadable places a text is hardly a script.
constexpr int max_errors = 20;

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v' || c == '\n';
}
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
constexpr bool is_word(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

struct Spelled {
  std::string_view text;
  TokenKind kind;
};

/// The texts of one token class, by first character and then longest first, so that the first
/// candidate that matches is the longest match.
template <TokenClass wanted>
class SpelledTable {
 public:
  constexpr SpelledTable() {
    constexpr auto all = std::to_array<std::pair<TokenClass, Spelled>>({
#define PERENTIE_TOKEN(id, token_class, spelling, before, after, operand) \
  {TokenClass::token_class, {spelling, TokenKind::id}},
#include "perentie/parser/token_kinds.def"
#undef PERENTIE_TOKEN
    });
    for (const auto& [token_class, spelled] : all) {
      if (token_class == wanted) entries_[size_++] = spelled;
    }
    std::sort(entries_.begin(), entries_.begin() + size_, [](const Spelled& a, const Spelled& b) {
      if (a.text[0] != b.text[0]) return a.text[0] < b.text[0];
      return a.text.size() > b.text.size();
    });
    for (std::size_t i = size_; i > 0; --i) {
      first_[index(entries_[i - 1].text[0])] = static_cast<std::uint8_t>(i - 1);
    }
  }

  /// The candidates that begin with `c`.
  template <class Accept>
  constexpr const Spelled* find(char c, Accept accept) const {
    if (index(c) >= first_.size()) return nullptr;
    for (std::size_t i = first_[index(c)]; i < size_ && entries_[i].text[0] == c; ++i) {
      if (accept(entries_[i])) return &entries_[i];
    }
    return nullptr;
  }

 private:
  static constexpr std::size_t index(char c) { return static_cast<unsigned char>(c); }

  std::array<Spelled, 80> entries_{};
  std::array<std::uint8_t, 128> first_{};
  std::uint8_t size_ = 0;
};

constexpr SpelledTable<TokenClass::symbol> symbols;
constexpr SpelledTable<TokenClass::keyword> keywords;

struct Confusable {
  std::string_view text;
  std::string_view advice;
};
// What is written in books or put there by editors, and what CSPM writes for it.
constexpr auto confusables = std::to_array<Confusable>({
    {"→", "write `->`"},
    {"⟶", "write `->`"},
    {"□", "write `[]`"},
    {"⊓", "write `|~|`"},
    {"⦀", "write `|||`"},
    {"∥", "write `||`"},
    {"‖", "write `||`"},
    {"▷", "write `[>`"},
    {"△", "write `/\\`"},
    {"∖", "write `\\`"},
    {"⊑", "write `[T=`, `[F=` or `[FD=`"},
    {"≠", "write `!=`"},
    {"≤", "write `<=`"},
    {"≥", "write `>=`"},
    {"∧", "write `and`"},
    {"∨", "write `or`"},
    {"¬", "write `not`"},
    {"⟨", "write `<`"},
    {"⟩", "write `>`"},
    {"∈", "write `<-` or `:`"},
    {"←", "write `<-`"},
    {"•", "write `@`"},
    {"×", "write `*`"},
    {"−", "write `-`"},
    {"–", "write `-`"},
    {"—", "write `--` for a comment"},
    {"…", "write `..`"},
    {"“", "write `\"`"},
    {"”", "write `\"`"},
    {"‘", "write `'`"},
    {"’", "write `'`"},
    {"\u00A0", "it is a no-break space; write an ordinary space"},
});

}  // namespace

Lexer::Lexer(base::Span range, const base::SourceMap& sources, base::Interner& names,
             base::Diagnostics& diagnostics, TokenStream& out)
    : range_(range),
      base_(range.begin),
      sources_(&sources),
      names_(&names),
      diagnostics_(&diagnostics),
      out_(&out) {}

Lexer::Stop Lexer::run() {
  text_ = sources_->text(range_);
  if (at_ == 0) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    if (text_.starts_with("{\\rtf1")) {
      report(codes::rich_text, 0, 6, "this file is rich text; save the script as plain text");
      at_ = text_.size();
    }
  }
  stop_after_include_ = false;
  while (!stop_after_include_) {
    skip_gap();
    if (at_ >= text_.size()) return Stop::at_end;
    scan_token();
  }
  return Stop::after_include;
}

void Lexer::skip_gap() {
  gap_ = {at_, false, false};
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == '\n') {
      gap_.newline = line_start_ = true;
      ++at_;
    } else if (is_blank(c)) {
      ++at_;
    } else if (c == '-' && peek(1) == '-') {
      at_ = end_of_line();
    } else if (c == '{' && peek(1) == '-') {
      if (!skip_block_comment()) break;
    } else {
      break;
    }
  }
  gap_.blank = at_ > gap_.begin;
}

// Comments nest. A `-` inside takes the next byte with it, whatever that is: `--}` closes nothing
// (1.2.3); and so does a `{`.
bool Lexer::skip_block_comment() {
  const std::size_t start = at_;
  at_ += 2;
  std::size_t depth = 1;
  while (depth > 0) {
    if (at_ >= text_.size()) {
      report_unclosed_comment(start);
      return false;
    }
    const char c = text_[at_++];
    if ((c != '-' && c != '{') || at_ >= text_.size()) continue;
    const char next = text_[at_++];
    if (c == '-' && next == '}') --depth;
    if (c == '{' && next == '-') ++depth;
  }
  return true;
}

void Lexer::report_unclosed_comment(std::size_t start) {
  base::Diagnostic& diagnostic =
      report(codes::unclosed_comment, start, start + 2, "this comment is not closed by `-}`");
  if (is_digit(text_[start + 2 < text_.size() ? start + 2 : start])) {
    diagnostic.notes.push_back(
        {std::nullopt, "a set that begins with a negative number needs a blank: `{ -1}`"});
  }
  emit(TokenKind::error, start, start + 2);
}

void Lexer::scan_token() {
  const char c = text_[at_];
  if (is_letter(c)) {
    scan_word();
  } else if (is_digit(c)) {
    scan_number();
  } else if (c == '\'') {
    scan_character();
  } else if (c == '"') {
    scan_string();
  } else {
    scan_symbol();
  }
}

void Lexer::scan_word() {
  const std::size_t begin = at_;
  while (is_word(peek())) ++at_;
  while (peek() == '\'') ++at_;
  const std::string_view word = text_.substr(begin, at_ - begin);
  if (word == "include") return scan_include(begin);
  if (word == "print" && line_start_ && scan_print()) return;
  const Spelled* keyword =
      keywords.find(word[0], [&](const Spelled& candidate) { return candidate.text == word; });
  if (keyword == nullptr) return emit(TokenKind::identifier, begin, at_, intern(word));
  emit(keyword->kind, begin, at_);
  // A `let` is a bracket too: newlines between its declarations do not end an open `<` around it.
  if (keyword->kind == TokenKind::let_) open_bracket();
  if (keyword->kind == TokenKind::within_) close_bracket();
}

void Lexer::scan_symbol() {
  if (peek() == '[' && scan_refines()) return;
  const Spelled* symbol = symbols.find(peek(), [&](const Spelled& candidate) {
    return text_.compare(at_, candidate.text.size(), candidate.text) == 0;
  });
  if (symbol == nullptr) return scan_unreadable();
  classify_symbol(symbol->kind, symbol->text.size());
}

// Settles the symbols whose meaning depends on what is around them.
void Lexer::classify_symbol(TokenKind kind, std::size_t length) {
  const std::size_t begin = at_;
  const auto take = [&](TokenKind as, std::size_t size) {
    at_ = begin + size;
    emit(as, begin, at_);
  };
  switch (kind) {
    case TokenKind::left_paren:
      // `(|` opens a map only if a blank follows; `(|~| ..` and `(||| ..` are processes (1.4.7).
      if (peek(1) == '|' && (is_blank(peek(2)) || at_ + 2 >= text_.size())) {
        take(TokenKind::left_map, 2);
      } else {
        take(kind, length);
      }
      return open_bracket();
    case TokenKind::left_brace:
    case TokenKind::left_productions:
    case TokenKind::left_rename:
    case TokenKind::left_parallel:
    case TokenKind::left_bracket:
    case TokenKind::left_sync:
    case TokenKind::left_interrupt:
      take(kind, length);
      return open_bracket();
    case TokenKind::right_paren:
    case TokenKind::right_brace:
    case TokenKind::right_productions:
    case TokenKind::right_map:
    case TokenKind::right_rename:
    case TokenKind::right_parallel:
    case TokenKind::right_exception:
    case TokenKind::right_bracket:
    case TokenKind::right_sync:
    case TokenKind::right_interrupt:
      take(kind, length);
      return close_bracket();
    case TokenKind::less: {
      // A bracket exactly where an expression may begin (1.5.3): a newline before `<` starts a
      // declaration.
      if (info(previous_).ends_operand && !gap_.newline) return take(kind, length);
      take(TokenKind::left_sequence, 1);
      ++open_sequences_.back();
      return;
    }
    case TokenKind::greater:
    case TokenKind::greater_equal:
      // Inside an open sequence `>` closes it (1.5.1); `>==` can only be `>` and `==`.
      if (open_sequences_.back() > 0 &&
          (kind == TokenKind::greater || (peek(2) == '=' && kind == TokenKind::greater_equal))) {
        --open_sequences_.back();
        return take(TokenKind::right_sequence, 1);
      }
      return take(kind, length);
    case TokenKind::restrict:
      if (peek(1) == '[') return scan_property();
      return take(kind, length);
    case TokenKind::annotate: {
      const bool spaced = gap_.blank || is_blank(peek(2)) || at_ + 2 >= text_.size();
      return take(spaced ? kind : TokenKind::scope, length);
    }
    default:
      return take(kind, length);
  }
}

// One error token and message for the whole character, or for the whole run of odd bytes.
void Lexer::scan_unreadable() {
  const std::size_t begin = at_;
  const std::string_view rest = text_.substr(at_);
  const auto* known = std::find_if(confusables.begin(), confusables.end(),
                                   [&](const Confusable& c) { return rest.starts_with(c.text); });
  if (known != confusables.end()) {
    at_ += known->text.size();
    // Someone's typography, not a sign of binary data.
    diagnostics_->report(
        codes::bad_character, span(begin, at_),
        fmt::format("`{}` is not a symbol of CSPM: {}", known->text, known->advice));
    return emit(TokenKind::error, begin, at_);
  }
  const auto is_odd = [](char c) {
    return !is_blank(c) && (static_cast<signed char>(c) < 0x20 || c == 0x7F);
  };
  if (!is_odd(peek())) {
    ++at_;
    report(codes::bad_character, begin, at_,
           fmt::format("`{}` is not a symbol of CSPM", text_[begin]));
    return emit(TokenKind::error, begin, at_);
  }
  while (at_ < text_.size() && is_odd(text_[at_])) ++at_;
  const bool is_text = static_cast<signed char>(text_[begin]) < 0;
  report(codes::bad_character, begin, at_,
         is_text ? "outside comments and strings a script holds only ASCII characters"
                 : fmt::format("the byte 0x{:02X} is not text",
                               static_cast<unsigned>(static_cast<unsigned char>(text_[begin]))));
  emit(TokenKind::error, begin, at_);
}

void Lexer::close_bracket() {
  if (open_sequences_.size() > 1) open_sequences_.pop_back();
}

void Lexer::emit(TokenKind kind, std::size_t begin, std::size_t end, std::uint32_t value) {
  if (gap_.newline && !info(previous_).soaks_after && !info(kind).soaks_before) {
    out_->tokens.push_back({TokenKind::newline, 0, span(gap_.begin, gap_.begin)});
    // A sequence cannot go on across a newline: forget `<` that nobody closed.
    open_sequences_.back() = 0;
  }
  gap_ = {};
  line_start_ = false;
  out_->tokens.push_back({kind, value, span(begin, end)});
  previous_ = kind;
}

std::size_t Lexer::end_of_line() const { return std::min(text_.find('\n', at_), text_.size()); }

base::Diagnostic& Lexer::report(const base::DiagnosticCode& code, std::size_t begin,
                                std::size_t end, std::string message) {
  if (errors_ < max_errors) {
    ++errors_;
    return diagnostics_->report(code, span(begin, end), std::move(message));
  }
  if (errors_ == max_errors) {
    ++errors_;
    diagnostics_->report(codes::not_a_script, span(begin, end),
                         "this does not look like a CSPM script; the rest is not read");
  }
  at_ = text_.size();
  return overflow_;
}

TokenStream lex(base::FileId file, const base::SourceMap& sources, base::Interner& names,
                base::Diagnostics& diagnostics) {
  TokenStream stream;
  const base::Span range = sources.span(file);
  Lexer lexer(range, sources, names, diagnostics, stream);
  while (lexer.run() == Lexer::Stop::after_include) {
  }
  stream.tokens.push_back({TokenKind::end_of_file, 0, {range.end, range.end}});
  return stream;
}

}  // namespace perentie::parser

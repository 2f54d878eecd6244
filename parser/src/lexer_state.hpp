// The state of lexing one text. It stops after each include, so that the caller can put the tokens
// of the included file there and then go on.
//
// Invariants: `at_` only grows; tokens are appended in the order of the text; `previous_` is the
// kind of the last one (`newline` at the start of a file).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/interner.hpp"
#include "perentie/base/source.hpp"
#include "perentie/parser/token.hpp"

namespace perentie::parser {

class Lexer {
 public:
  /// `range` is the file, or a stretch of it.
  Lexer(base::Span range, const base::SourceMap& sources, base::Interner& names,
        base::Diagnostics& diagnostics, TokenStream& out);

  enum class Stop { at_end, after_include };
  /// Appends tokens up to the end of the text, or up to and including the next `include_` token.
  Stop run();

 private:
  struct Gap {  // what lay between the previous token and this one
    std::size_t begin = 0;
    bool blank = false;    // anything at all
    bool newline = false;  // a newline outside block comments
  };

  // lexer.cpp
  void skip_gap();
  bool skip_block_comment();
  void report_unclosed_comment(std::size_t start);
  void scan_token();
  void scan_word();
  void scan_symbol();
  void scan_unreadable();
  void classify_symbol(TokenKind kind, std::size_t length);
  void open_bracket() { open_sequences_.push_back(0); }
  void close_bracket();
  void emit(TokenKind kind, std::size_t begin, std::size_t end, std::uint32_t value = 0);

  // lexer_literals.cpp
  void scan_number();
  void scan_character();
  void scan_string();

  // lexer_lines.cpp
  void scan_include(std::size_t word_begin);
  bool scan_print();
  bool scan_refines();
  void scan_property();
  void scan_property_word();
  void scan_property_parameter();

  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  std::size_t end_of_line() const;
  base::Span span(std::size_t begin, std::size_t end) const {
    return {base_ + static_cast<base::Offset>(begin), base_ + static_cast<base::Offset>(end)};
  }
  std::uint32_t intern(std::string_view text) { return names_->intern(text).value; }
  base::Diagnostic& report(const base::DiagnosticCode& code, std::size_t begin, std::size_t end,
                           std::string message);

  std::string_view text_;  // the text being lexed; `run` fetches it anew, the map may have moved it
  base::Span range_;
  base::Offset base_;
  const base::SourceMap* sources_;
  base::Interner* names_;
  base::Diagnostics* diagnostics_;
  TokenStream* out_;

  std::size_t at_ = 0;
  Gap gap_;
  bool line_start_ = true;  // no token stands before this one on its line
  TokenKind previous_ = TokenKind::newline;
  bool stop_after_include_ = false;
  int errors_ = 0;
  base::Diagnostic overflow_{};  // takes the messages of an abandoned text
  /// For each open bracket (and `let`), outermost first, the number of open `<` directly inside it.
  std::vector<std::size_t> open_sequences_{0};
};

}  // namespace perentie::parser

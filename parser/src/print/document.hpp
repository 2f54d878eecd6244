// Documents: text with places where a line may break, and the choice of where it does.
//
// A group whose content fits on the rest of the line stays on it; in one that does not, every
// `line` breaks, and every `fill` after which the next piece would not fit. Nothing here recurses,
// and the work is linear in the number of commands.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace perentie::parser {

class Document {
 public:
  /// The text must live as long as the document. A blank is put before it if the text before could
  /// otherwise run into it and be read as another token.
  void text(std::string_view text);
  /// Keeps a text for the life of the document.
  std::string_view keep(std::string text) { return strings_.emplace_back(std::move(text)); }
  /// A blank, or the end of the line.
  void line() { add(Kind::line); }
  void fill() { add(Kind::fill); }
  /// The end of the line, always.
  void hard_line() { add(Kind::hard_line); }
  void open_group() { add(Kind::open_group); }
  void close_group() { add(Kind::close_group); }
  void indent() { add(Kind::indent); }
  void dedent() { add(Kind::dedent); }

  /// The laid out text, without a newline at its end. A width of 0 breaks at hard lines only.
  std::string layout(std::size_t width) const;

 private:
  enum class Kind : std::uint8_t {
    text,
    line,
    fill,
    hard_line,
    open_group,
    close_group,
    indent,
    dedent
  };
  struct Command {
    Kind kind;
    std::string_view text;
  };
  struct Measures;

  void add(Kind kind) {
    commands_.push_back({kind, {}});
    if (kind == Kind::line || kind == Kind::fill || kind == Kind::hard_line) last_ = ' ';
  }
  Measures measure() const;

  std::vector<Command> commands_;
  char last_ = ' ';  // the last character so far
  std::deque<std::string> strings_;
};

}  // namespace perentie::parser

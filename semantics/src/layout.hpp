// Layout: text broken into lines the way FDR's printer does, so that printed terms can be compared
// with its own line by line.
//
// Input: texts and marks in the order of printing; groups nest. A group is printed on one line if
// what it holds and what follows it up to the next break does: lines are at most 100 characters, of
// which 67 are not indentation. Otherwise its breaks become line breaks, all of them
// (`open`) or as few as possible (`open_fill`), to the column at which the group began. Two passes
// over the input, no recursion.
// Source: the style of Hughes and Peyton Jones's library that libcspm prints with, and its recorded
// output; texts are measured in bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace perentie::semantics {

enum class Mark : std::uint8_t {
  open,       // a group whose breaks are taken together
  open_fill,  // a group whose breaks are taken one by one
  close,
  space,  // a break that is a blank where it is not taken
  hang,   // the same; the next line is indented by four more
  cut,    // a break that is nothing where it is not taken
};

class Layout {
 public:
  void text(std::string_view text);
  void mark(Mark mark);
  std::string finish() const;

 private:
  struct Token {
    bool is_text;
    Mark mark;          // if it is no text
    std::size_t begin;  // of the text
    std::size_t end;
  };
  std::vector<std::size_t> measure() const;

  std::string characters_;
  std::vector<Token> tokens_;
};

}  // namespace perentie::semantics

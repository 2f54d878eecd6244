#include "print/document.hpp"

#include <algorithm>
#include <utility>

namespace perentie::parser {
namespace {

constexpr std::size_t indent_width = 2;

/// Whether two texts written without a blank between them could be read as another token.
bool needs_blank(char last, char first) {
  const auto follows = [&](std::string_view set) {
    return set.find(first) != std::string_view::npos;
  };
  switch (last) {
    case '-':
      return follows("->");
    case '{':
      return follows("-|");
    case '<':
      return follows("-=>");
    case '>':
      return follows("=");
    case '|':
      return follows("|~>})]\\");
    case '[':
      return follows("[|]+>");
    case '/':
      return follows("\\+");
    case '+':
      return follows("]\\");
    case '.':
      return follows(".");
    case ':':
      return follows(":[");
    case '@':
      return follows("@");
    case '=':
      return follows("=>*");
    case '!':
      return follows("=");
    default:
      return false;
  }
}

}  // namespace

void Document::text(std::string_view text) {
  if (text.empty()) return;
  if (needs_blank(last_, text.front())) commands_.push_back({Kind::text, " "});
  commands_.push_back({Kind::text, text});
  last_ = text.back();
}

/// What deciding needs to know about each command, computed beforehand.
struct Document::Measures {
  std::vector<std::size_t> width;  // of all before the command, were it all on one line
  std::vector<std::size_t> hard;   // hard lines before the command
  std::vector<std::size_t> next;  // groups: the end; fills: the next break of the group, or its end
  std::vector<std::size_t> rest;  // the width from the command to the next possible break
};

Document::Measures Document::measure() const {
  const std::size_t size = commands_.size();
  Measures m{std::vector<std::size_t>(size + 1), std::vector<std::size_t>(size + 1),
             std::vector<std::size_t>(size + 1, size), std::vector<std::size_t>(size + 1)};
  struct Open {
    std::size_t group;
    std::size_t last_break;  // or the group itself
  };
  std::vector<Open> open{{size, size}};
  for (std::size_t i = 0; i < size; ++i) {
    const Kind kind = commands_[i].kind;
    const bool is_break = kind == Kind::line || kind == Kind::fill || kind == Kind::hard_line;
    m.width[i + 1] = m.width[i] + (kind == Kind::text ? commands_[i].text.size() : is_break);
    m.hard[i + 1] = m.hard[i] + (kind == Kind::hard_line ? 1 : 0);
    if (is_break || kind == Kind::close_group) {
      const std::size_t last = std::exchange(open.back().last_break, i);
      if (last < size && commands_[last].kind == Kind::fill) m.next[last] = i;
    }
    if (kind == Kind::open_group) open.push_back({i, i});
    if (kind == Kind::close_group) {
      m.next[open.back().group] = i;
      open.pop_back();
    }
  }
  for (std::size_t i = size; i-- > 0;) {
    const Kind kind = commands_[i].kind;
    const bool is_break = kind == Kind::line || kind == Kind::fill || kind == Kind::hard_line;
    const std::size_t own = kind == Kind::text ? commands_[i].text.size() : 0;
    m.rest[i] = is_break ? 0 : own + m.rest[i + 1];
  }
  return m;
}

std::string Document::layout(std::size_t width) const {
  const Measures m = measure();
  std::string out;
  std::size_t line_begin = 0;
  std::size_t indentation = 0;
  std::vector<bool> broken{true};  // for each open group; the outermost is the document

  const auto fits = [&](std::size_t first, std::size_t last) {
    if (m.hard[last] > m.hard[first]) return false;
    if (width == 0) return true;
    const std::size_t column = out.size() - line_begin;
    return column + m.width[last] - m.width[first] + m.rest[last] <= width;
  };
  const auto new_line = [&] {
    while (!out.empty() && out.back() == ' ') out.pop_back();
    out.push_back('\n');
    line_begin = out.size();
    out.append(indentation * indent_width, ' ');
  };
  for (std::size_t i = 0; i < commands_.size(); ++i) {
    switch (commands_[i].kind) {
      case Kind::text:
        out += commands_[i].text;
        break;
      case Kind::indent:
        ++indentation;
        break;
      case Kind::dedent:
        --indentation;
        break;
      case Kind::hard_line:
        new_line();
        break;
      case Kind::open_group:
        broken.push_back(!fits(i, m.next[i]));
        break;
      case Kind::close_group:
        broken.pop_back();
        break;
      case Kind::line:
        if (broken.back()) {
          new_line();
        } else {
          out.push_back(' ');
        }
        break;
      case Kind::fill:
        if (broken.back() && !fits(i, m.next[i])) {
          new_line();
        } else {
          out.push_back(' ');
        }
        break;
    }
  }
  return out;
}

}  // namespace perentie::parser

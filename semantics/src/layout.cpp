#include "layout.hpp"

#include "perentie/base/check.hpp"

namespace perentie::semantics {
namespace {

constexpr std::size_t line_length = 100;
constexpr std::size_t ribbon_length = 67;
constexpr std::size_t hanging_indent = 4;

bool is_break(Mark mark) { return mark == Mark::space || mark == Mark::hang || mark == Mark::cut; }

std::size_t width_of(Mark mark) { return mark == Mark::space || mark == Mark::hang ? 1 : 0; }

}  // namespace

void Layout::text(std::string_view text) {
  const std::size_t begin = characters_.size();
  characters_ += text;
  tokens_.push_back({true, {}, begin, characters_.size()});
}

void Layout::mark(Mark mark) { tokens_.push_back({false, mark, 0, 0}); }

// What must fit on the rest of the line, by token: for a group all of it and what follows up to the
// next break; for a break what follows up to the next break of its group or behind the group.
std::vector<std::size_t> Layout::measure() const {
  struct Group {
    std::size_t behind;    // the first break after the group
    std::size_t item_end;  // the first break after the item that a break begins
  };
  std::vector<std::size_t> needed(tokens_.size(), 0);
  std::vector<Group> groups;
  std::size_t next_break = 0;  // places are distances from the end of the text
  std::size_t place = 0;
  for (std::size_t i = tokens_.size(); i-- > 0;) {
    const Token& token = tokens_[i];
    if (token.is_text) {
      place += token.end - token.begin;
    } else if (token.mark == Mark::close) {
      groups.push_back({next_break, next_break});
    } else if (is_break(token.mark)) {
      PERENTIE_CHECK(!groups.empty(), "a break outside all groups");
      next_break = place;
      place += width_of(token.mark);
      needed[i] = place - groups.back().item_end;
      groups.back().item_end = next_break;
    } else {
      needed[i] = place - groups.back().behind;
      groups.pop_back();
    }
  }
  return needed;
}

std::string Layout::finish() const {
  struct Group {
    std::size_t column;
    enum { on_one_line, all_breaks, few_breaks } kind;
  };
  const std::vector<std::size_t> needed = measure();
  std::vector<Group> groups;
  std::string text;
  std::size_t indent = 0;
  std::size_t column = 0;
  const auto fits = [&](std::size_t width) {
    return column + width <= line_length && column - indent + width <= ribbon_length;
  };
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    const Token& token = tokens_[i];
    if (token.is_text) {
      text.append(characters_, token.begin, token.end - token.begin);
      column += token.end - token.begin;
    } else if (token.mark == Mark::close) {
      groups.pop_back();
    } else if (!is_break(token.mark)) {
      const bool is_inside_line = !groups.empty() && groups.back().kind == Group::on_one_line;
      const auto broken = token.mark == Mark::open ? Group::all_breaks : Group::few_breaks;
      groups.push_back({column, is_inside_line || fits(needed[i]) ? Group::on_one_line : broken});
    } else {
      const Group& group = groups.back();
      const bool is_taken =
          group.kind == Group::all_breaks || (group.kind == Group::few_breaks && !fits(needed[i]));
      if (is_taken) {
        indent = group.column + (token.mark == Mark::hang ? hanging_indent : 0);
        text += '\n' + std::string(indent, ' ');
        column = indent;
      } else {
        text.append(width_of(token.mark), ' ');
        column += width_of(token.mark);
      }
    }
  }
  return text;
}

}  // namespace perentie::semantics

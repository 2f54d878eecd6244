#include "event_template.hpp"

#include <fmt/format.h>

namespace perentie::monitor {
namespace {

class TemplateParser {
 public:
  using ValueIndex = std::function<std::optional<std::uint32_t>(std::string_view)>;

  TemplateParser(std::string_view text, const ValueIndex& value_index)
      : text_(text), value_index_(&value_index) {}

  ParsedTemplate parse() {
    while (at_ < text_.size() && result_.error.empty()) {
      const char c = text_[at_];
      const bool doubled = text_.substr(at_ + 1, 1) == text_.substr(at_, 1);
      if (c != '{' && c != '}' && c != '[' && c != ']') {
        literal_ += c;
        ++at_;
      } else if (doubled) {
        literal_ += c;
        at_ += 2;
      } else {
        bracket(c);
      }
    }
    end_literal();
    if (result_.error.empty() && group_open_) result_.error = "`[` is not closed by `]`";
    if (result_.error.empty() && result_.parts.empty()) result_.error = "it is empty";
    return std::move(result_);
  }

 private:
  void bracket(char c) {
    if (c == '{') return value();
    if (c == '}') return fail("`}` closes nothing; a brace itself is written `}}`");
    if (c == '[' && group_open_) return fail("`[` stands inside another `[`");
    if (c == ']' && !group_open_) {
      return fail("`]` closes nothing; a bracket itself is written `]]`");
    }
    end_literal();
    group_open_ = c == '[';
    if (group_open_) {
      ++groups_;
    } else if (!group_has_value_) {
      return fail("an optional group must hold a value such as `{data}`");
    }
    group_has_value_ = false;
    ++at_;
  }

  void value() {
    const std::size_t close = text_.find('}', at_);
    if (close == std::string_view::npos) return fail("`{` is not closed by `}`");
    const std::string_view name = text_.substr(at_ + 1, close - at_ - 1);
    end_literal();
    const std::optional<std::uint32_t> index = (*value_index_)(name);
    if (!index) {
      return fail(fmt::format("`{{{}}}` names neither a value of the rule nor a field", name));
    }
    result_.parts.push_back({{}, index, current_group()});
    group_has_value_ = true;
    at_ = close + 1;
  }

  void end_literal() {
    if (literal_.empty()) return;
    result_.parts.push_back({std::move(literal_), std::nullopt, current_group()});
    literal_.clear();
  }

  void fail(std::string message) { result_.error = std::move(message); }
  std::uint32_t current_group() const { return group_open_ ? groups_ : 0; }

  std::string_view text_;
  const ValueIndex* value_index_;
  ParsedTemplate result_;
  std::string literal_;
  std::size_t at_ = 0;
  std::uint32_t groups_ = 0;
  bool group_open_ = false;
  bool group_has_value_ = false;
};

}  // namespace

ParsedTemplate parse_event_template(std::string_view text,
                                    const TemplateParser::ValueIndex& value_index) {
  return TemplateParser(text, value_index).parse();
}

}  // namespace perentie::monitor

#include "perentie/monitor/event_map.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "json_text.hpp"
#include "perentie/monitor/diagnostic_codes.hpp"

namespace perentie::monitor {
namespace {

constexpr std::string_view blanks = " \t\r\n";

// Reads the flat object token by token, so that every complaint has its place.
class EventMapParser {
 public:
  EventMapParser(base::Span file, std::string_view text, base::Diagnostics& diagnostics)
      : file_(file), text_(text), diagnostics_(&diagnostics) {}

  std::optional<EventMap> parse() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    if (const auto fault = find_json_fault(text_.substr(at_))) {
      report(codes::malformed_json, at_ + fault->begin, at_ + fault->end,
             fault->cut_off ? "the event map ends before its JSON object does"
                            : "the event map is not JSON from here on");
      return std::nullopt;
    }
    skip_blanks();
    if (text_[at_] != '{') {
      report(codes::wrong_type, at_, at_ + 1,
             "an event map must be a JSON object of names to names");
      return std::nullopt;
    }
    EventMap map;
    bool good = true;
    ++at_;
    for (skip_blanks(); text_[at_] != '}'; skip_blanks()) good = entry(map) && good;
    if (!good) return std::nullopt;
    return map;
  }

 private:
  // `"name": "model name"` with the comma after it. The text is known to be JSON.
  bool entry(EventMap& map) {
    const std::string name = string();
    skip_blanks();
    ++at_;  // the colon
    skip_blanks();
    const bool good = text_[at_] == '"';
    if (good) {
      map.add(name, string());
    } else {
      const std::size_t begin = at_;
      skip_value();
      report(codes::wrong_type, begin, at_,
             fmt::format("the model's name for `{}` must be a string", name));
    }
    skip_blanks();
    if (text_[at_] == ',') ++at_;
    return good;
  }

  std::string string() {
    const std::size_t begin = ++at_;
    while (text_[at_] != '"') at_ += text_[at_] == '\\' ? 2U : 1U;
    std::string value;
    append_unescaped(text_.substr(begin, at_ - begin), value);
    ++at_;
    return value;
  }

  void skip_value() {
    std::size_t depth = 0;
    do {
      const char c = text_[at_];
      if (c == '"') {
        string();
        continue;
      }
      if (depth == 0 && (c == ',' || c == '}' || blanks.find(c) != std::string_view::npos)) return;
      if (c == '{' || c == '[') ++depth;
      if (c == '}' || c == ']') --depth;
      ++at_;
    } while (depth > 0 || (text_[at_] != ',' && text_[at_] != '}'));
  }

  void skip_blanks() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }

  void report(const base::DiagnosticCode& code, std::size_t begin, std::size_t end,
              std::string message) {
    diagnostics_->report(code,
                         {file_.begin + static_cast<base::Offset>(begin),
                          file_.begin + static_cast<base::Offset>(end)},
                         std::move(message));
  }

  base::Span file_;
  std::string_view text_;
  base::Diagnostics* diagnostics_;
  std::size_t at_ = 0;
};

}  // namespace

std::string EventMap::rename_event(std::string_view event) const {
  const auto whole = names_.find(event);
  if (whole != names_.end()) return whole->second;
  const std::size_t dot = std::min(event.find('.'), event.size());
  std::string_view channel = event.substr(0, dot);
  channel = channel.substr(0, channel.find_last_not_of(" \t") + 1);
  return std::string((*this)(channel)) + std::string(event.substr(dot));
}

std::optional<EventMap> parse_event_map(base::FileId file, const base::SourceMap& sources,
                                        base::Diagnostics& diagnostics) {
  return EventMapParser(sources.span(file), sources.text(file), diagnostics).parse();
}

std::optional<EventMap> load_event_map(const std::string& path, base::SourceMap& sources,
                                       base::Diagnostics& diagnostics) {
  const base::AddedFile added = base::add_file(path, sources);
  if (!added.file) {
    diagnostics.report(codes::unreadable_file,
                       fmt::format("cannot read the event map `{}`: {}", path, added.error));
    return std::nullopt;
  }
  return parse_event_map(*added.file, sources, diagnostics);
}

}  // namespace perentie::monitor

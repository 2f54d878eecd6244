#include "perentie/monitor/event_index.hpp"

namespace perentie::monitor {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool is_identifier_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '\'';
}

// Drops blanks outside quotation marks, except that one stays between two words: `move . 1` is
// `move.1`, but `move 1` is no event and must not become `move1`.
std::string without_blanks(std::string_view text) {
  std::string kept;
  kept.reserve(text.size());
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (!quoted && is_blank(c)) {
      std::size_t next = i + 1;
      while (next < text.size() && is_blank(text[next])) ++next;
      const bool between_words = !kept.empty() && is_identifier_character(kept.back()) &&
                                 next < text.size() && is_identifier_character(text[next]);
      if (between_words) kept += ' ';
      i = next - 1;
      continue;
    }
    if (c == '"' && (i == 0 || text[i - 1] != '\\')) quoted = !quoted;
    kept += c;
  }
  return kept;
}

// `True` and `False`, where they stand as a whole field, in lower case.
void lower_booleans(std::string& text) {
  for (const std::string_view word : {std::string_view("True"), std::string_view("False")}) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      const std::size_t end = at + word.size();
      const bool whole = at > 0 && !is_identifier_character(text[at - 1]) &&
                         (end == text.size() || !is_identifier_character(text[end]));
      if (whole) text[at] = word[0] == 'T' ? 't' : 'f';
    }
  }
}

}  // namespace

std::string normalise_event_text(std::string_view text) {
  std::string normal = without_blanks(text);
  lower_booleans(normal);
  return normal;
}

EventIndex::EventIndex(const MonitorTable& table) {
  const lts::LabelNames& names = table.label_names();
  std::vector<Event> event_of(names.size());
  for (std::uint32_t e = 0; e < table.event_count(); ++e) {
    event_of[table.alphabet()[e].value] = Event{e};
  }
  for (std::uint32_t i = lts::tick.value; i < names.size(); ++i) {
    events_.emplace(names[i], event_of[i]);
  }
  for (std::uint32_t i = lts::tick.value + 1; i < names.size(); ++i) {
    events_.emplace(normalise_event_text(names[i]), event_of[i]);
  }
  for (const char* name : {"tick", "_tick"}) events_.emplace(name, event_of[lts::tick.value]);
}

Event EventIndex::find_normalised(std::string_view text) const {
  const std::string normal = normalise_event_text(text);
  if (normal == text) return Event{};
  const auto found = events_.find(std::string_view(normal));
  return found != events_.end() ? found->second : Event{};
}

}  // namespace perentie::monitor

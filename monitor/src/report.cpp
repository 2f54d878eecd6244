#include "perentie/monitor/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "perentie/base/text.hpp"

namespace perentie::monitor {
namespace {

constexpr std::size_t max_shown = 12;  // events or positions in a line of the text report

// "1 event", "2 events".
std::string count_of(std::uint64_t number, std::string_view noun) {
  return fmt::format("{} {}{}", base::with_thousands(number), noun, number == 1 ? "" : "s");
}

std::string list_of(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size() && i < max_shown; ++i) {
    text += (i > 0 ? ", " : "") + items[i];
  }
  if (items.size() > max_shown) text += fmt::format(", and {} more", items.size() - max_shown);
  return text;
}

std::string headline(const RunResult& result, const RunSubject& subject) {
  switch (result.verdict) {
    case RunVerdict::conforms:
      return fmt::format("CONFORMS: {} permits the trace {}", subject.process, subject.trace);
    case RunVerdict::violation:
      return fmt::format("VIOLATION: {} does not permit the trace {}", subject.process,
                         subject.trace);
    case RunVerdict::inconclusive:
      return fmt::format("INCONCLUSIVE: {}", result.reason);
  }
  return {};
}

std::string why_refused(const RunResult& result) {
  if (!result.event_in_alphabet) {
    return "the model has no such event, and the mode is strict";
  }
  return "the model does not permit it here";
}

// What comes from a trace may hold characters that a terminal would obey.
std::string printable(std::string_view value) {
  std::string text(value);
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  }
  return text;
}

void append_line(std::string& text, std::string_view label, std::string_view value) {
  text += fmt::format("  {:<11}{}\n", label, printable(value));
}

void append_violation(std::string& text, const RunResult& result, const RunSubject& subject) {
  append_line(text, "event",
              fmt::format("{}, number {}: {}", result.event,
                          base::with_thousands(result.events_checked), why_refused(result)));
  append_line(text, "at",
              fmt::format("{}:{}:{}", subject.trace, result.place.line, result.place.column));
  if (result.source != result.event) append_line(text, "", result.source);
  if (!result.similar.empty()) append_line(text, "similar", list_of(result.similar));
}

std::string permitted_text(const RunResult& result) {
  if (result.permitted.empty()) return "nothing: the model has stopped";
  return list_of(result.permitted);
}

// A line a state: terms are long.
void append_position(std::string& text, const std::vector<std::string>& position) {
  constexpr std::size_t max_states_shown = 3;
  for (std::size_t i = 0; i < position.size() && i < max_states_shown; ++i) {
    append_line(text, i == 0 ? "model at" : "or at", position[i]);
  }
  if (position.size() > max_states_shown) {
    append_line(text, "", fmt::format("or at {} more states", position.size() - max_states_shown));
  }
}

std::string checked_text(const RunResult& result, const RunSubject& subject) {
  std::string text = count_of(result.events_checked, "event");
  if (result.events_total) {
    text = fmt::format("{} of {}", base::with_thousands(result.events_checked),
                       count_of(*result.events_total, "event"));
  }
  return fmt::format("{}, {} mode", text, to_string(subject.mode));
}

void append_ignored(std::string& text, const RunResult& result) {
  if (result.events_ignored == 0) return;
  std::vector<std::string> names;
  for (const auto& [name, count] : result.ignored) {
    names.push_back(count == 1 ? name : fmt::format("{} ({} times)", name, count));
  }
  append_line(text, "ignored",
              fmt::format("{} that the model does not have: {}",
                          count_of(result.events_ignored, "event"), list_of(names)));
}

// Why a verdict may say less than it seems to; empty if it does not.
std::string_view note_on(const RunResult& result) {
  if (result.verdict != RunVerdict::conforms) return {};
  if (result.events_checked == 0) return "the trace has no events";
  if (result.events_ignored < result.events_checked) return {};
  return "no event of the trace is an event of the model: do the names agree?";
}

}  // namespace

std::string_view to_string(RunVerdict verdict) {
  switch (verdict) {
    case RunVerdict::conforms:
      return "conforms";
    case RunVerdict::violation:
      return "violation";
    case RunVerdict::inconclusive:
      return "inconclusive";
  }
  return {};
}

std::string_view to_string(Mode mode) { return mode == Mode::strict ? "strict" : "permissive"; }

std::string to_json(const RunResult& result, const RunSubject& subject) {
  const bool violation = result.verdict == RunVerdict::violation;
  nlohmann::ordered_json json;
  json["schema"] = "perentie.monitor/1";
  json["verdict"] = to_string(result.verdict);
  json["reason"] = nullptr;
  if (!result.reason.empty()) json["reason"] = result.reason;
  json["events_checked"] = result.events_checked;
  json["events_total"] = nullptr;
  if (result.events_total) json["events_total"] = *result.events_total;
  json["events_ignored"] = result.events_ignored;
  json["note"] = nullptr;
  if (const auto note = note_on(result); !note.empty()) json["note"] = note;
  json["event"] = nullptr;
  if (result.events_checked > 0) json["event"] = result.event;
  json["event_in_alphabet"] = result.event_in_alphabet;
  json["expected"] = violation ? result.permitted : std::vector<std::string>{};
  json["permitted_next"] = violation ? std::vector<std::string>{} : result.permitted;
  json["line"] = nullptr;
  json["column"] = nullptr;
  if (result.events_checked > 0) {
    json["line"] = result.place.line;
    json["column"] = result.place.column;
  }
  json["source"] = nullptr;
  if (violation) json["source"] = result.source;
  json["model_position"] = subject.model_position;
  json["ignored"] = result.ignored;
  json["name"] = subject.name;
  json["model"] = subject.model;
  json["process"] = subject.process;
  json["trace"] = subject.trace;
  json["mode"] = to_string(subject.mode);
  json["states"] = subject.states;
  json["transitions"] = subject.transitions;
  json["synthesis_seconds"] = subject.synthesis_seconds;
  json["checking_seconds"] = result.checking_seconds;
  // What a trace holds need not be UTF-8; JSON must be.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string to_text(const RunResult& result, const RunSubject& subject) {
  const bool violation = result.verdict == RunVerdict::violation;
  std::string text = headline(result, subject) + "\n";
  if (result.state.is_none()) return text;  // the run did not begin
  if (violation) {
    append_violation(text, result, subject);
  } else if (result.events_checked > 0) {
    append_line(text, "last event", result.event);
  }
  append_line(text, violation ? "permitted" : "next", permitted_text(result));
  append_position(text, subject.model_position);
  append_line(text, "checked", checked_text(result, subject));
  if (!result.events_total && violation) {
    append_line(text, "note",
                "the rest of the trace was not read; the verdict does not depend on it");
  }
  append_ignored(text, result);
  if (const auto note = note_on(result); !note.empty()) append_line(text, "note", note);
  return text;
}

}  // namespace perentie::monitor

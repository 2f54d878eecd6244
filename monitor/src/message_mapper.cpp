#include "message_mapper.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "field_conversion.hpp"
#include "glob.hpp"
#include "json_text.hpp"
#include "perentie/monitor/diagnostic_codes.hpp"

namespace perentie::monitor {
namespace {

constexpr std::size_t max_known_topics = 1000;

std::string_view without_leading_slash(std::string_view topic) {
  if (topic.starts_with('/')) topic.remove_prefix(1);
  return topic;
}

}  // namespace

MessageMapper::MessageMapper(const Mapping& mapping, const EventMap* event_map)
    : mapping_(&mapping), event_map_(event_map), topic_slot_(finder_.slot_for(mapping.topic)) {
  for (const Rule& rule : mapping.rules) {
    CompiledRule compiled;
    compiled.rule = &rule;
    if (!rule.topic) rules_without_topic_.push_back(static_cast<std::uint32_t>(rules_.size()));
    for (const FieldPath& path : rule.has) compiled.has.push_back(finder_.slot_for(path));
    for (const MappedValue& value : rule.values) {
      compiled.values.push_back(finder_.slot_for(value.field));
    }
    rules_.push_back(std::move(compiled));
  }
}

bool MessageMapper::map(std::string_view message) {
  message_ = message;
  event_count_ = 0;
  if (!finder_.find(message)) return structure_fault();
  const Field topic = finder_.field(topic_slot_);
  const std::vector<std::uint32_t>* const rules = rules_for(topic);
  if (rules == nullptr) return false;
  for (const std::uint32_t rule : *rules) {
    if (has_fields(rules_[rule])) return apply(rules_[rule]);
  }
  if (is_absent(topic)) {
    return set_fault(codes::no_topic, message.substr(0, 1),
                     fmt::format("the message has no `{}`", to_string(mapping_->topic)));
  }
  if (mapping_->ignore_unknown_topics) return true;
  return set_fault(
      codes::unmapped_topic, topic,
      fmt::format("the mapping `{}` has no rule for the topic {}", mapping_->name, topic));
}

// The rules for messages with this topic, in order; null after a fault. They are remembered for the
// topics met, but not for more of them than a system has.
const std::vector<std::uint32_t>* MessageMapper::rules_for(Field topic) {
  if (is_absent(topic)) return &rules_without_topic_;
  if (const auto known = rules_by_topic_.find(topic); known != rules_by_topic_.end()) {
    return &known->second;
  }
  std::string text;
  if (!topic.starts_with('"')) {
    set_fault(codes::no_topic, topic,
              fmt::format("`{}` must be a string", to_string(mapping_->topic)));
    return nullptr;
  }
  if (append_text(topic, text) != FieldKind::value) {
    structure_fault();
    return nullptr;
  }
  if (rules_by_topic_.size() == max_known_topics) rules_by_topic_.clear();
  std::vector<std::uint32_t>& rules = rules_by_topic_[std::string(topic)];
  for (std::uint32_t i = 0; i < rules_.size(); ++i) {
    if (topic_matches(*rules_[i].rule, text)) rules.push_back(i);
  }
  return &rules;
}

bool MessageMapper::topic_matches(const Rule& rule, std::string_view topic) const {
  if (!rule.topic) return true;
  if (!mapping_->leading_slash_optional) return matches_glob(*rule.topic, topic);
  return matches_glob(without_leading_slash(*rule.topic), without_leading_slash(topic));
}

bool MessageMapper::has_fields(const CompiledRule& rule) const {
  return std::all_of(rule.has.begin(), rule.has.end(),
                     [this](Slot slot) { return !is_absent(finder_.field(slot)); });
}

bool MessageMapper::apply(const CompiledRule& rule) {
  for (const EventTemplate& parts : rule.rule->events) {
    if (event_count_ == events_.size()) events_.emplace_back();
    std::string& event = events_[event_count_];
    event.clear();
    const Outcome outcome = fill(rule, parts, event);
    if (outcome == Outcome::fault) return false;
    if (outcome == Outcome::text) ++event_count_;
  }
  return true;
}

MessageMapper::Outcome MessageMapper::fill(const CompiledRule& rule, const EventTemplate& parts,
                                           std::string& event) {
  std::uint32_t group = 0;  // the optional group that the last part was of
  std::uint32_t dropped_group = 0;
  std::size_t group_start = 0;  // where its text begins
  for (const TemplatePart& part : parts) {
    if (part.group != group) group_start = event.size();
    group = part.group;
    if (group != 0 && group == dropped_group) continue;
    if (!part.value) {
      event += part.literal;
      continue;
    }
    const MappedValue& value = rule.rule->values[*part.value];
    const Field field = finder_.field(rule.values[*part.value]);
    const Outcome outcome = append_value(value, field, event);
    if (outcome == Outcome::null && group == 0) {
      return field_fault(value, field, "is null, but the event needs it");
    }
    if (outcome == Outcome::null) {
      event.resize(group_start);
      dropped_group = group;
    } else if (outcome != Outcome::text) {
      return outcome;
    }
  }
  return Outcome::text;
}

MessageMapper::Outcome MessageMapper::append_value(const MappedValue& value, Field field,
                                                   std::string& out) {
  if (is_absent(field)) return fall_back(value.missing, value, field, "is missing", out);
  if (field == "null") return Outcome::null;
  if (!value.event_map || event_map_ == nullptr) return append_mapped(value, field, out);
  value_.clear();
  const Outcome outcome = append_mapped(value, field, value_);
  if (outcome == Outcome::text) out += (*event_map_)(value_);
  return outcome;
}

MessageMapper::Outcome MessageMapper::append_mapped(const MappedValue& value, Field field,
                                                    std::string& out) {
  if (!value.thresholds.empty()) return append_threshold(value, field, out);
  const std::size_t start = out.size();
  const Outcome outcome = append_plain(value, field, out);
  if (outcome != Outcome::text || value.table.empty()) return outcome;
  const auto entry = value.table.find(std::string_view(out).substr(start));
  out.resize(start);
  if (entry == value.table.end()) {
    return fall_back(value.otherwise, value, field, "is not in the table", out);
  }
  out += entry->second;
  return Outcome::text;
}

MessageMapper::Outcome MessageMapper::append_threshold(const MappedValue& value, Field field,
                                                       std::string& out) {
  std::optional<double> number = to_number(field);
  if (!number) return field_fault(value, field, "is not a number");
  if (value.integer) number = std::trunc(*number);
  const auto above =
      std::upper_bound(value.thresholds.begin(), value.thresholds.end(), *number,
                       [](double n, const Threshold& threshold) { return n < threshold.at_least; });
  if (above == value.thresholds.begin()) {
    return fall_back(value.otherwise, value, field, "is below the lowest threshold", out);
  }
  out += (above - 1)->text;
  return Outcome::text;
}

MessageMapper::Outcome MessageMapper::append_plain(const MappedValue& value, Field field,
                                                   std::string& out) {
  if (value.integer) {
    return append_integer(field, out) ? Outcome::text
                                      : field_fault(value, field, "is not a number");
  }
  switch (append_text(field, out)) {
    case FieldKind::value:
      return Outcome::text;
    case FieldKind::null:
      return Outcome::null;
    case FieldKind::nested:
      return field_fault(value, field, "is not a single value or a list of them");
    case FieldKind::malformed:
      structure_fault();
      return Outcome::fault;
  }
  return Outcome::fault;
}

MessageMapper::Outcome MessageMapper::fall_back(const Fallback& fallback, const MappedValue& value,
                                                Field field, std::string_view why,
                                                std::string& out) {
  switch (fallback.action) {
    case Fallback::Action::error:
      return field_fault(value, field, why);
    case Fallback::Action::ignore:
      return Outcome::ignored;
    case Fallback::Action::null:
      return Outcome::null;
    case Fallback::Action::keep:
      return append_plain(value, field, out);
    case Fallback::Action::use:
      out += fallback.text;
      return Outcome::text;
  }
  return Outcome::fault;
}

MessageMapper::Outcome MessageMapper::field_fault(const MappedValue& value, Field field,
                                                  std::string_view why) {
  const std::string path = to_string(value.field);
  if (is_absent(field) || field == "null") {
    set_fault(codes::unmappable_field, is_absent(field) ? message_.substr(0, 1) : field,
              fmt::format("the field `{}` {}", path, why));
  } else {
    constexpr std::size_t shown = 40;
    set_fault(codes::unmappable_field, field,
              fmt::format("the field `{}` is {}{}, which {}", path, field.substr(0, shown),
                          field.size() > shown ? "..." : "", why));
  }
  fault_.note = fmt::format("the mapping is `{}`", mapping_->name);
  return Outcome::fault;
}

bool MessageMapper::structure_fault() {
  const JsonFault fault = find_json_fault(message_).value_or(JsonFault{0, message_.size(), false});
  fault_ = {&codes::malformed_message, fault.begin, fault.end, {}, {}};
  if (fault.cut_off) {
    fault_.message = "the message is cut off: the text ends before the JSON object does";
  } else if (fault.begin == 0 && fault.end == message_.size()) {
    fault_.message = "the message is not JSON";
  } else {
    fault_.message = "the message is not JSON from here on";
  }
  if (message_.starts_with("{u'") || message_.starts_with("{'")) {
    fault_.note = "this is how Python prints a dictionary; write messages with `json.dumps`";
  }
  return false;
}

bool MessageMapper::set_fault(const base::DiagnosticCode& code, Field at, std::string message) {
  const auto begin = static_cast<std::size_t>(at.data() - message_.data());
  fault_ = {&code, begin, begin + at.size(), std::move(message), {}};
  return false;
}

}  // namespace perentie::monitor

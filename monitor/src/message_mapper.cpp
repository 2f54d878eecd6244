#include "message_mapper.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <simdjson.h>

#include "field_conversion.hpp"
#include "glob.hpp"
#include "json_text.hpp"
#include "perentie/monitor/diagnostic_codes.hpp"
#include "trace_input.hpp"

namespace perentie::monitor {
namespace {

namespace ondemand = simdjson::ondemand;

static_assert(TraceInput::padding >= simdjson::SIMDJSON_PADDING);

std::string_view without_leading_slash(std::string_view topic) {
  if (topic.starts_with('/')) topic.remove_prefix(1);
  return topic;
}

std::string_view trim(std::string_view text) {
  return text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
}

}  // namespace

// Finds the fields that have a slot. The wanted paths form a tree, which the pass follows as far as
// the message does; all else is skipped by its brackets.
struct MessageMapper::Reader {
  struct Node {
    std::vector<std::pair<std::string, std::uint32_t>> keys;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> indices;
    Slot slot = no_slot;

    bool has_children() const { return !keys.empty() || !indices.empty(); }
  };

  std::vector<Node> nodes = std::vector<Node>(1);  // the root first
  ondemand::parser parser;
  std::vector<Field>* fields = nullptr;
  bool has_escapes = false;

  template <class Key>
  static std::uint32_t child(std::vector<std::pair<Key, std::uint32_t>>& children, const Key& key,
                             std::vector<Node>& nodes) {
    for (const auto& [known, node] : children) {
      if (known == key) return node;
    }
    const auto node = static_cast<std::uint32_t>(nodes.size());
    children.emplace_back(key, node);
    nodes.emplace_back();
    return node;
  }

  std::uint32_t node_for(const FieldPath& path) {
    std::uint32_t node = 0;
    for (const auto& step : path) {
      if (const auto* key = std::get_if<std::string>(&step)) {
        auto keys = std::move(nodes[node].keys);
        const std::uint32_t next = child(keys, *key, nodes);
        nodes[node].keys = std::move(keys);
        node = next;
      } else {
        auto indices = std::move(nodes[node].indices);
        const std::uint32_t next = child(indices, std::get<std::uint32_t>(step), nodes);
        nodes[node].indices = std::move(indices);
        node = next;
      }
    }
    return node;
  }

  simdjson::error_code read(std::string_view message, std::vector<Field>& out) {
    fields = &out;
    has_escapes = message.find('\\') != std::string_view::npos;
    ondemand::document document;
    SIMDJSON_TRY(
        parser.iterate(message.data(), message.size(), message.size() + TraceInput::padding)
            .get(document));
    ondemand::object object;
    SIMDJSON_TRY(document.get_object().get(object));
    SIMDJSON_TRY(read_object(object, nodes[0]));
    // The document must end with the object: where it does, there is no current location.
    return document.current_location().error() == simdjson::OUT_OF_BOUNDS ? simdjson::SUCCESS
                                                                          : simdjson::TAPE_ERROR;
  }

  // The depth of this recursion is that of the mapping's paths, which is limited.
  simdjson::error_code read_object(ondemand::object& object, const Node& node) {
    for (auto entry : object) {
      ondemand::field field;
      SIMDJSON_TRY(std::move(entry).get(field));
      const Node* child = nullptr;
      SIMDJSON_TRY(find_key(field, node, child));
      if (child != nullptr) SIMDJSON_TRY(read_value(field.value(), *child));
    }
    return simdjson::SUCCESS;
  }

  simdjson::error_code find_key(ondemand::field& field, const Node& node, const Node*& child) {
    std::string_view unescaped;
    if (has_escapes) SIMDJSON_TRY(field.unescaped_key().get(unescaped));
    for (const auto& [key, next] : node.keys) {
      if (has_escapes ? unescaped == key : field.key().unsafe_is_equal(key)) child = &nodes[next];
    }
    return simdjson::SUCCESS;
  }

  simdjson::error_code read_array(ondemand::array& array, const Node& node) {
    std::uint32_t index = 0;
    for (auto entry : array) {
      ondemand::value value;
      SIMDJSON_TRY(std::move(entry).get(value));
      for (const auto& [wanted, next] : node.indices) {
        if (wanted == index) SIMDJSON_TRY(read_value(value, nodes[next]));
      }
      ++index;
    }
    return simdjson::SUCCESS;
  }

  simdjson::error_code read_value(ondemand::value& value, const Node& node) {
    const std::string_view token = value.raw_json_token();
    if (token.starts_with('{')) {
      ondemand::object object;
      SIMDJSON_TRY(value.get_object().get(object));
      if (node.slot != no_slot) {
        SIMDJSON_TRY(object.raw_json().get((*fields)[node.slot]));
        SIMDJSON_TRY(object.reset().error());
      }
      return node.keys.empty() ? simdjson::SUCCESS : read_object(object, node);
    }
    if (token.starts_with('[')) {
      ondemand::array array;
      SIMDJSON_TRY(value.get_array().get(array));
      if (node.slot != no_slot) {
        SIMDJSON_TRY(array.raw_json().get((*fields)[node.slot]));
        SIMDJSON_TRY(array.reset().error());
      }
      return node.indices.empty() ? simdjson::SUCCESS : read_array(array, node);
    }
    if (node.slot != no_slot) (*fields)[node.slot] = trim(token);
    return simdjson::SUCCESS;
  }
};

MessageMapper::MessageMapper(const Mapping& mapping, const EventMap* event_map)
    : mapping_(&mapping), event_map_(event_map), reader_(std::make_unique<Reader>()) {
  topic_slot_ = slot_for(mapping.topic);
  for (const Rule& rule : mapping.rules) {
    CompiledRule compiled;
    compiled.rule = &rule;
    if (rule.topic) {
      compiled.topic =
          mapping.leading_slash_optional ? without_leading_slash(*rule.topic) : *rule.topic;
      compiled.exact_topic = compiled.topic.find('*') == std::string::npos;
    }
    for (const FieldPath& path : rule.has) compiled.has.push_back(slot_for(path));
    for (const MappedValue& value : rule.values) compiled.values.push_back(slot_for(value.field));
    rules_.push_back(std::move(compiled));
  }
}

MessageMapper::~MessageMapper() = default;

MessageMapper::Slot MessageMapper::slot_for(const FieldPath& path) {
  Slot& slot = reader_->nodes[reader_->node_for(path)].slot;
  if (slot == no_slot) {
    slot = static_cast<Slot>(fields_.size());
    fields_.emplace_back();
  }
  return slot;
}

bool MessageMapper::map(std::string_view message) {
  message_ = message;
  event_count_ = 0;
  std::fill(fields_.begin(), fields_.end(), Field{});
  if (reader_->read(message, fields_) != simdjson::SUCCESS) return structure_fault();
  if (!read_topic()) return false;
  for (const CompiledRule& rule : rules_) {
    if (applies(rule)) return apply(rule);
  }
  const Field topic = fields_[topic_slot_];
  if (topic.data() == nullptr) {
    return set_fault(codes::no_topic, message.substr(0, 1),
                     fmt::format("the message has no `{}`", to_string(mapping_->topic)));
  }
  if (mapping_->ignore_unknown_topics) return true;
  return set_fault(
      codes::unmapped_topic, topic,
      fmt::format("the mapping `{}` has no rule for the topic {}", mapping_->name, topic));
}

bool MessageMapper::read_topic() {
  topic_.clear();
  const Field field = fields_[topic_slot_];
  if (field.data() == nullptr) return true;
  if (!field.starts_with('"')) {
    return set_fault(codes::no_topic, field,
                     fmt::format("`{}` must be a string", to_string(mapping_->topic)));
  }
  if (append_text(field, topic_) != FieldKind::value) return structure_fault();
  return true;
}

bool MessageMapper::applies(const CompiledRule& rule) const {
  if (rule.rule->topic) {
    if (fields_[topic_slot_].data() == nullptr) return false;
    std::string_view topic = topic_;
    if (mapping_->leading_slash_optional) topic = without_leading_slash(topic);
    if (rule.exact_topic ? rule.topic != topic : !matches_glob(rule.topic, topic)) return false;
  }
  return std::all_of(rule.has.begin(), rule.has.end(),
                     [this](Slot slot) { return fields_[slot].data() != nullptr; });
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
    const Field field = fields_[rule.values[*part.value]];
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
  if (field.data() == nullptr) return fall_back(value.missing, value, field, "is missing", out);
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
    case Fallback::Action::keep: {
      const MappedValue plain{value.name, value.field, {}, value.integer, {}, {}, {}, false};
      return append_plain(plain, field, out);
    }
    case Fallback::Action::use:
      out += fallback.text;
      return Outcome::text;
  }
  return Outcome::fault;
}

MessageMapper::Outcome MessageMapper::field_fault(const MappedValue& value, Field field,
                                                  std::string_view why) {
  const std::string path = to_string(value.field);
  if (field.data() == nullptr || field == "null") {
    set_fault(codes::unmappable_field, field.data() == nullptr ? message_.substr(0, 1) : field,
              fmt::format("the field `{}` {}", path, why));
  } else {
    constexpr std::size_t shown = 40;
    set_fault(codes::unmappable_field, field,
              fmt::format("the field `{}` is {}{}, which {}", path, field.substr(0, shown),
                          field.size() > shown ? "..." : "", why));
  }
  fault_.note = fmt::format("the topic is `{}`, and the mapping is `{}`", topic_, mapping_->name);
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

// MessageMapper: one JSON message to the texts of its events, by the rules of a mapping.
//
// The fields that any rule needs are found in one pass; then the first rule that is for the message
// makes its events. Which rules are for a topic is worked out once per topic. Nothing is allocated
// per message once the buffers have grown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "field_finder.hpp"
#include "perentie/base/diagnostic.hpp"
#include "perentie/monitor/event_map.hpp"
#include "perentie/monitor/mapping.hpp"
#include "perentie/monitor/string_hash.hpp"

namespace perentie::monitor {

/// Why a message could not be mapped, and which of its bytes show it.
struct MappingFault {
  const base::DiagnosticCode* code = nullptr;
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string message;
  std::string note;  ///< empty: none
};

class MessageMapper {
 public:
  /// Both must outlive the mapper; the event map may be null.
  MessageMapper(const Mapping& mapping, const EventMap* event_map);

  /// Maps one message, which must be followed by `TraceInput::padding` readable bytes. False:
  /// `fault()` says why; otherwise `events()` holds what was made, possibly nothing.
  bool map(std::string_view message);

  std::span<const std::string> events() const { return {events_.data(), event_count_}; }
  const MappingFault& fault() const { return fault_; }

 private:
  using Slot = FieldFinder::Slot;

  struct CompiledRule {
    const Rule* rule;
    std::vector<Slot> has;
    std::vector<Slot> values;  // by index into Rule::values
  };

  enum class Outcome : std::uint8_t { text, null, ignored, fault };

  const std::vector<std::uint32_t>* rules_for(Field topic);
  bool topic_matches(const Rule& rule, std::string_view topic) const;
  bool has_fields(const CompiledRule& rule) const;
  bool apply(const CompiledRule& rule);
  Outcome fill(const CompiledRule& rule, const EventTemplate& parts, std::string& event);
  Outcome append_value(const MappedValue& value, Field field, std::string& out);
  Outcome append_mapped(const MappedValue& value, Field field, std::string& out);
  Outcome append_threshold(const MappedValue& value, Field field, std::string& out);
  Outcome append_plain(const MappedValue& value, Field field, std::string& out);
  Outcome fall_back(const Fallback& fallback, const MappedValue& value, Field field,
                    std::string_view why, std::string& out);
  Outcome field_fault(const MappedValue& value, Field field, std::string_view why);
  bool structure_fault();
  bool set_fault(const base::DiagnosticCode& code, Field at, std::string message);

  const Mapping* mapping_;
  const EventMap* event_map_;
  FieldFinder finder_;
  Slot topic_slot_;
  std::vector<CompiledRule> rules_;
  std::vector<std::uint32_t> rules_without_topic_;
  /// By the JSON text of the topic.
  std::unordered_map<std::string, std::vector<std::uint32_t>, StringHash, std::equal_to<>>
      rules_by_topic_;

  std::string_view message_;
  std::vector<std::string> events_;
  std::size_t event_count_ = 0;
  std::string value_;
  MappingFault fault_;
};

}  // namespace perentie::monitor

// MessageMapper: one JSON message to the texts of its events, by the rules of a mapping.
//
// The fields that any rule needs are numbered (`slots`) and found in one pass over the message,
// which need not be read further than its structure elsewhere. Then the first rule that is for the
// message makes its events. Nothing is allocated per message once the buffers have grown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/monitor/event_map.hpp"
#include "perentie/monitor/mapping.hpp"

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
  ~MessageMapper();
  MessageMapper(const MessageMapper&) = delete;
  MessageMapper& operator=(const MessageMapper&) = delete;

  /// Maps one message, which must be followed by `TraceInput::padding` readable bytes. False:
  /// `fault()` says why; otherwise `events()` holds what was made, possibly nothing.
  bool map(std::string_view message);

  std::span<const std::string> events() const { return {events_.data(), event_count_}; }
  const MappingFault& fault() const { return fault_; }

 private:
  struct Reader;  // the pass over the message, with simdjson

  using Slot = std::uint32_t;
  static constexpr Slot no_slot = ~Slot{0};

  // What stands in a slot: the field's JSON text. No data: the message has no such field.
  using Field = std::string_view;

  struct CompiledRule {
    const Rule* rule;
    std::string topic;  // without the leading slash where that is optional
    bool exact_topic = false;
    std::vector<Slot> has;
    std::vector<Slot> values;  // by index into Rule::values
  };

  enum class Outcome : std::uint8_t { text, null, ignored, fault };

  Slot slot_for(const FieldPath& path);
  bool read_topic();
  bool applies(const CompiledRule& rule) const;
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
  std::vector<CompiledRule> rules_;
  Slot topic_slot_;
  std::unique_ptr<Reader> reader_;

  std::string_view message_;
  std::string topic_;
  std::vector<Field> fields_;  // by slot
  std::vector<std::string> events_;
  std::size_t event_count_ = 0;
  std::string value_;
  MappingFault fault_;
};

}  // namespace perentie::monitor

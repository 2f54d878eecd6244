// FieldFinder: the fields of a JSON message that somebody wants, found in one pass.
//
// Wanted paths are numbered as slots and form a tree. The pass follows the tree as far as the
// message does and skips all else by its brackets, with simdjson's on-demand parser. What is
// skipped is checked for its structure only: NaN and Infinity, which Python writes, do no harm
// there.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/monitor/mapping.hpp"

namespace perentie::monitor {

/// The JSON text of a field within its message. No data: the message has no such field.
using Field = std::string_view;

inline bool is_absent(Field field) { return field.data() == nullptr; }

class FieldFinder {
 public:
  using Slot = std::uint32_t;

  FieldFinder();
  ~FieldFinder();
  FieldFinder(const FieldFinder&) = delete;
  FieldFinder& operator=(const FieldFinder&) = delete;

  /// The slot of a path; equal paths have the same.
  Slot slot_for(const FieldPath& path);

  /// Finds the fields of a message, which must be followed by `TraceInput::padding` readable bytes.
  /// False if it is not one JSON object.
  bool find(std::string_view message);

  /// What stood in a slot, until the message goes away. Of equal keys the last one counts.
  Field field(Slot slot) const { return fields_[slot]; }

 private:
  static constexpr Slot no_slot = ~Slot{0};

  struct Node {
    std::vector<std::pair<std::string, std::uint32_t>> keys;       // to nodes
    std::vector<std::pair<std::uint32_t, std::uint32_t>> indices;  // to nodes
    Slot slot = no_slot;
  };

  struct Pass;

  std::uint32_t child_of(std::uint32_t node, const FieldPath::value_type& step);

  std::vector<Node> nodes_ = std::vector<Node>(1);  // the root first
  std::vector<Field> fields_;                       // by slot
  std::unique_ptr<Pass> pass_;
};

}  // namespace perentie::monitor

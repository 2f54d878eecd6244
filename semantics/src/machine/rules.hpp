// The rules of a process by structural recursion over its static operators.
//
// A rule says which leaves perform which of their events together and which event the whole then
// performs. Each operator makes the rules of the whole from those of its operands (CSPM reference
// 4.2). ✓ has no rules here: every operator synchronises it among all leaves (4.1.3).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "machine/event_bits.hpp"
#include "perentie/semantics/event.hpp"
#include "perentie/semantics/process.hpp"

namespace perentie::semantics {

struct RulePart {
  std::uint32_t leaf;
  EventId event;  ///< of the leaf
};

struct SyncRule {
  EventId event;        ///< of the whole
  std::uint32_t first;  ///< of the parts
  std::uint32_t count;
};

/// Whether an operator is compiled into rules. It has process operands and stays in place.
bool is_compiled_operator(ProcKind kind);

class RuleBuilder {
 public:
  using Rules = std::vector<SyncRule>;

  RuleBuilder(const EventTable& events, const ProcStore& processes, std::size_t max_rules)
      : events_(events), processes_(processes), max_rules_(max_rules) {}

  /// Every event of a leaf by itself. `alphabet` may contain τ, not ✓.
  Rules leaf(std::uint32_t leaf, std::span<const EventId> alphabet);
  /// The rules of a term of a compiled operator from those of its operands in order. Nothing: there
  /// would be too many.
  std::optional<Rules> combine(ProcId term, std::vector<Rules> operands);

  std::span<const RulePart> parts(const SyncRule& rule) const {
    return std::span<const RulePart>(parts_).subspan(rule.first, rule.count);
  }

 private:
  bool unite(Rules& left, const Rules& right);
  bool join(const Rules& left, const Rules& right, std::optional<EventId> result, Rules& out);
  std::optional<Rules> synchronise(Rules left, Rules right, const EventBits& shared);
  std::optional<Rules> alphabetised(ProcId term, std::vector<Rules> operands);
  std::optional<Rules> linked(EventRelationId links, const Rules& left, const Rules& right);
  std::optional<Rules> renamed(EventRelationId relation, const Rules& operand);

  const EventTable& events_;
  const ProcStore& processes_;
  std::size_t max_rules_;
  std::vector<RulePart> parts_;
};

}  // namespace perentie::semantics

// Events and sets of events.
//
// An event is a complete channel value (`c.1.true`). The table numbers events in order of first
// use; the numbers are the labels of the LTS, so 0 is τ and 1 is ✓. Event sets and relations
// between events are hash-consed sorted sequences of labels: equal sets are equal ids.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "perentie/base/id.hpp"
#include "perentie/base/term_table.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/semantics/value.hpp"

namespace perentie::semantics {

using EventId = lts::Label;
using EventSetId = base::Id<struct EventSetTag>;
using EventRelationId = base::Id<struct EventRelationTag>;

struct EventPair {
  EventId from;
  EventId to;

  friend constexpr auto operator<=>(const EventPair&, const EventPair&) = default;
};

class EventTable {
 public:
  EventTable();

  /// The event of a complete channel value.
  EventId intern(ValueId value);
  /// The same if it was interned before, else none.
  EventId find(ValueId value) const {
    const auto found = events_.find(value.bits);
    return found == events_.end() ? EventId{} : found->second;
  }
  /// The channel value of an event other than τ and ✓.
  ValueId value(EventId event) const { return values_[event.value]; }
  std::size_t size() const { return values_.size(); }

  EventSetId make_set(std::vector<EventId> events);
  std::span<const EventId> events(EventSetId set) const;
  bool contains(EventSetId set, EventId event) const;
  EventSetId empty_set() const { return empty_set_; }

  EventRelationId make_relation(std::vector<EventPair> pairs);
  /// Pairs in ascending order.
  std::span<const EventPair> pairs(EventRelationId relation) const;
  /// The sub-run of pairs whose first event is `from`.
  std::span<const EventPair> images(EventRelationId relation, EventId from) const;
  /// The relation with every pair turned round.
  EventRelationId inverse(EventRelationId relation);

  std::size_t memory_bytes() const {
    return sets_.memory_bytes() + relations_.memory_bytes() + values_.capacity() * sizeof(ValueId);
  }

 private:
  std::vector<ValueId> values_;  // by event; the first two are placeholders for τ and ✓
  std::unordered_map<std::uint32_t, EventId> events_;  // by the bits of the value
  base::TermTable sets_;
  base::TermTable relations_;
  EventSetId empty_set_;
};

}  // namespace perentie::semantics

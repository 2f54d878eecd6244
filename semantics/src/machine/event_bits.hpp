// EventBits: a set of events that answers in constant time.
#pragma once

#include <vector>

#include "perentie/semantics/event.hpp"

namespace perentie::semantics {

class EventBits {
 public:
  EventBits() = default;
  EventBits(const EventTable& events, EventSetId set) {
    for (const EventId event : events.events(set)) add(event);
  }

  void add(EventId event) {
    if (event.value >= bits_.size()) bits_.resize(event.value + 1);
    bits_[event.value] = true;
  }
  bool contains(EventId event) const { return event.value < bits_.size() && bits_[event.value]; }

 private:
  std::vector<bool> bits_;  // by event
};

}  // namespace perentie::semantics

#include "perentie/semantics/event.hpp"

#include <algorithm>

namespace perentie::semantics {

EventTable::EventTable() : values_(2) { empty_set_ = make_set({}); }

EventId EventTable::intern(ValueId value) {
  const EventId next{static_cast<std::uint32_t>(values_.size())};
  const auto [entry, inserted] = events_.emplace(value.bits, next);
  if (inserted) values_.push_back(value);
  return entry->second;
}

EventSetId EventTable::make_set(std::vector<EventId> events) {
  std::sort(events.begin(), events.end());
  events.erase(std::unique(events.begin(), events.end()), events.end());
  const auto* words = reinterpret_cast<const std::uint32_t*>(events.data());
  return EventSetId{sets_.intern(0, std::span<const std::uint32_t>(words, events.size()))};
}

std::span<const EventId> EventTable::events(EventSetId set) const {
  static_assert(sizeof(EventId) == sizeof(std::uint32_t));
  const auto words = sets_.words(set.value);
  return {reinterpret_cast<const EventId*>(words.data()), words.size()};
}

bool EventTable::contains(EventSetId set, EventId event) const {
  const auto all = events(set);
  return std::binary_search(all.begin(), all.end(), event);
}

EventRelationId EventTable::make_relation(std::vector<EventPair> pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  const auto* words = reinterpret_cast<const std::uint32_t*>(pairs.data());
  return EventRelationId{
      relations_.intern(0, std::span<const std::uint32_t>(words, 2 * pairs.size()))};
}

std::span<const EventPair> EventTable::pairs(EventRelationId relation) const {
  static_assert(sizeof(EventPair) == 2 * sizeof(std::uint32_t));
  const auto words = relations_.words(relation.value);
  return {reinterpret_cast<const EventPair*>(words.data()), words.size() / 2};
}

std::span<const EventPair> EventTable::images(EventRelationId relation, EventId from) const {
  const auto all = pairs(relation);
  const auto by_from = [](const EventPair& a, const EventPair& b) { return a.from < b.from; };
  const auto [first, last] =
      std::equal_range(all.begin(), all.end(), EventPair{from, EventId{0}}, by_from);
  return {first, last};
}

EventRelationId EventTable::inverse(EventRelationId relation) {
  std::vector<EventPair> turned;
  for (const EventPair& pair : pairs(relation)) turned.push_back({pair.to, pair.from});
  return make_relation(std::move(turned));
}

}  // namespace perentie::semantics

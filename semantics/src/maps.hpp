// Maps as values (CSPM reference 3.7): hash-consed balanced trees.
//
// A map is empty, or a node with an entry, a smaller and a greater map. Every node has a higher
// priority, a hash of its key, than those below it (a treap; Seidel and Aragon, 1996): the shape
// depends on the keys alone, so equal maps are the same node, and an update makes O(log n) new
// ones.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "perentie/semantics/value.hpp"

namespace perentie::semantics {

using MapEntry = std::pair<ValueId, ValueId>;

/// In ascending order of keys.
std::vector<MapEntry> map_entries(const ValueStore& values, ValueId map);
std::optional<ValueId> map_find(const ValueStore& values, ValueId map, ValueId key);
/// The map with an entry added or replaced.
ValueId map_insert(ValueStore& values, ValueId map, const MapEntry& entry);
/// The map without a key.
ValueId map_erase(ValueStore& values, ValueId map, ValueId key);
/// Of entries with the same key the last counts.
ValueId make_map(ValueStore& values, const std::vector<MapEntry>& entries);

}  // namespace perentie::semantics

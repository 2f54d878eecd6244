// Recursion is as deep as the tree, which is expected to be O(log n).
#include "maps.hpp"

#include "perentie/base/hash.hpp"

namespace perentie::semantics {
namespace {

struct Node {
  MapEntry entry;
  ValueId smaller, greater;
};

bool is_empty(const ValueStore& values, ValueId map) { return map == values.empty_map(); }

Node node_of(const ValueStore& values, ValueId map) {
  return {{ValueId{values.word(map, 0)}, ValueId{values.word(map, 1)}},
          ValueId{values.word(map, 2)},
          ValueId{values.word(map, 3)}};
}

ValueId make(ValueStore& values, const Node& node) {
  return values.make_map_node(node.entry.first, node.entry.second, node.smaller, node.greater);
}

// Whether the key `a` stands above the key `b`. Ids are unique, so no two keys are level.
bool is_above(ValueId a, ValueId b) {
  const auto priority = [](ValueId key) { return base::hash_mix(0, key.bits); };
  return priority(a) != priority(b) ? priority(a) > priority(b) : a.bits > b.bits;
}

// The parts of a map with smaller and with greater keys; the key itself is in neither.
std::pair<ValueId, ValueId> split(ValueStore& values, ValueId map, ValueId key) {
  if (is_empty(values, map)) return {map, map};
  Node node = node_of(values, map);
  if (node.entry.first == key) return {node.smaller, node.greater};
  if (values.compare(key, node.entry.first) < 0) {
    const auto [smaller, greater] = split(values, node.smaller, key);
    node.smaller = greater;
    return {smaller, make(values, node)};
  }
  const auto [smaller, greater] = split(values, node.greater, key);
  node.greater = smaller;
  return {make(values, node), greater};
}

// All keys of `smaller` are below those of `greater`.
ValueId join(ValueStore& values, ValueId smaller, ValueId greater) {
  if (is_empty(values, smaller)) return greater;
  if (is_empty(values, greater)) return smaller;
  Node left = node_of(values, smaller);
  Node right = node_of(values, greater);
  if (is_above(left.entry.first, right.entry.first)) {
    left.greater = join(values, left.greater, greater);
    return make(values, left);
  }
  right.smaller = join(values, smaller, right.smaller);
  return make(values, right);
}

}  // namespace

std::vector<MapEntry> map_entries(const ValueStore& values, ValueId map) {
  std::vector<MapEntry> entries;
  std::vector<Node> path;  // nodes whose smaller keys are being listed
  for (;;) {
    for (; !is_empty(values, map); map = path.back().smaller) path.push_back(node_of(values, map));
    if (path.empty()) return entries;
    entries.push_back(path.back().entry);
    map = path.back().greater;
    path.pop_back();
  }
}

std::optional<ValueId> map_find(const ValueStore& values, ValueId map, ValueId key) {
  while (!is_empty(values, map)) {
    const Node node = node_of(values, map);
    if (node.entry.first == key) return node.entry.second;
    map = values.compare(key, node.entry.first) < 0 ? node.smaller : node.greater;
  }
  return std::nullopt;
}

ValueId map_insert(ValueStore& values, ValueId map, const MapEntry& entry) {
  if (is_empty(values, map)) return make(values, {entry, map, map});
  Node node = node_of(values, map);
  if (node.entry.first == entry.first) {
    node.entry = entry;
  } else if (is_above(entry.first, node.entry.first)) {
    const auto [smaller, greater] = split(values, map, entry.first);
    node = {entry, smaller, greater};
  } else if (values.compare(entry.first, node.entry.first) < 0) {
    node.smaller = map_insert(values, node.smaller, entry);
  } else {
    node.greater = map_insert(values, node.greater, entry);
  }
  return make(values, node);
}

ValueId map_erase(ValueStore& values, ValueId map, ValueId key) {
  if (!map_find(values, map, key)) return map;
  const auto [smaller, greater] = split(values, map, key);
  return join(values, smaller, greater);
}

ValueId make_map(ValueStore& values, const std::vector<MapEntry>& entries) {
  ValueId map = values.empty_map();
  for (const MapEntry& entry : entries) map = map_insert(values, map, entry);
  return map;
}

}  // namespace perentie::semantics

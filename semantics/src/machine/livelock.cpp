#include "machine/livelock.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>

#include "machine/event_bits.hpp"
#include "perentie/lts/strong_components.hpp"

namespace perentie::semantics {
namespace {

// The events of a leaf that are on a cycle of edges with some events.
EventBits on_cycles(const LeafGraph& leaf, const EventBits& events) {
  const auto for_each_edge = [&](auto use) {
    for (std::uint32_t s = 0; s < leaf.state_count(); ++s) {
      for (const lts::Edge& edge : leaf.edges(s)) {
        if (events.contains(edge.label) && !leaf.is_choice(s, edge)) use(s, edge);
      }
    }
  };
  std::vector<std::vector<std::uint32_t>> successors(leaf.state_count());
  for_each_edge(
      [&](std::uint32_t s, const lts::Edge& edge) { successors[s].push_back(edge.target.value); });
  const auto components = lts::strong_components(successors);
  std::vector<std::uint32_t> component_of(leaf.state_count());
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    for (const std::uint32_t s : components[c]) component_of[s] = c;
  }
  EventBits found;
  for_each_edge([&](std::uint32_t s, const lts::Edge& edge) {
    if (component_of[s] == component_of[edge.target.value]) found.add(edge.label);
  });
  return found;
}

}  // namespace

bool may_diverge(const std::vector<const LeafGraph*>& leaves, const RuleBuilder& builder,
                 const RuleBuilder::Rules& rules) {
  constexpr int max_rounds = 20;  // each looks at all leaves that take part
  std::vector<SyncRule> left;
  std::ranges::copy_if(rules, std::back_inserter(left),
                       [](const SyncRule& rule) { return rule.event == lts::tau; });
  for (int round = 0; round < max_rounds && !left.empty(); ++round) {
    std::map<std::uint32_t, EventBits> events;  // by leaf
    for (const SyncRule& rule : left) {
      for (const RulePart& part : builder.parts(rule)) events[part.leaf].add(part.event);
    }
    std::map<std::uint32_t, EventBits> cyclic;
    for (const auto& [leaf, of_rules] : events) {
      cyclic.emplace(leaf, on_cycles(*leaves[leaf], of_rules));
    }
    const std::size_t crossed_out = std::erase_if(left, [&](const SyncRule& rule) {
      return std::ranges::any_of(builder.parts(rule), [&](const RulePart& part) {
        return !cyclic.at(part.leaf).contains(part.event);
      });
    });
    if (crossed_out == 0) return true;
  }
  return !left.empty();
}

}  // namespace perentie::semantics

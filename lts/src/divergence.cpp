// A state diverges iff τ leads from it to a strongly connected component of the τ graph with an
// edge inside. Tarjan's algorithm numbers a component after all components that it leads to, so one
// pass in that order settles all.
#include "perentie/lts/divergence.hpp"

#include <algorithm>
#include <boost/graph/strong_components.hpp>
#include <cstdint>

#include "graph.hpp"

namespace perentie::lts {

namespace {

bool has_tau(const Lts& lts) {
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (!lts.edges(State{s}, tau).empty()) return true;
  }
  return false;
}

}  // namespace

std::vector<bool> divergent_states(const Lts& lts) {
  std::vector<bool> divergent(lts.state_count(), false);
  if (!has_tau(lts)) return divergent;

  std::vector<std::uint32_t> component(lts.state_count());
  const auto component_map =
      boost::make_iterator_property_map(component.begin(), TauGraphIndexMap{});
  const std::uint32_t count = boost::strong_components(TauGraph{&lts}, component_map);

  std::vector<std::uint32_t> states(lts.state_count());
  for (std::uint32_t s = 0; s < states.size(); ++s) states[s] = s;
  std::stable_sort(states.begin(), states.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return component[a] < component[b]; });
  std::vector<bool> component_diverges(count, false);
  for (const std::uint32_t s : states) {
    for (const Edge& edge : lts.edges(State{s}, tau)) {
      const std::uint32_t target = component[edge.target.value];
      if (target == component[s] || component_diverges[target]) {
        component_diverges[component[s]] = true;
      }
    }
  }
  for (std::uint32_t s = 0; s < states.size(); ++s) divergent[s] = component_diverges[component[s]];
  return divergent;
}

}  // namespace perentie::lts

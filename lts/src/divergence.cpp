// A state diverges iff τ leads from it to a strongly connected component of the τ graph with an
// edge inside. A component comes after all components that it leads to, so one pass in that order
// settles all.
#include "perentie/lts/divergence.hpp"

#include <cstdint>

#include "tau_components.hpp"

namespace perentie::lts {

std::vector<bool> divergent_states(const Lts& lts) {
  std::vector<bool> divergent(lts.state_count(), false);
  if (!has_tau(lts)) return divergent;

  const TauComponents components = tau_components(lts);
  std::vector<bool> component_diverges(components.count(), false);
  for (const std::uint32_t s : components.states) {
    const std::uint32_t component = components.of[s];
    for (const Edge& edge : lts.edges(State{s}, tau)) {
      const std::uint32_t target = components.of[edge.target.value];
      if (target == component || component_diverges[target]) component_diverges[component] = true;
    }
  }
  for (std::uint32_t s = 0; s < divergent.size(); ++s) {
    divergent[s] = component_diverges[components.of[s]];
  }
  return divergent;
}

}  // namespace perentie::lts

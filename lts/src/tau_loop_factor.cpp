#include "discovery.hpp"
#include "perentie/lts/compressions.hpp"
#include "tau_components.hpp"

namespace perentie::lts {

Quotient tau_loop_factor(const Lts& lts) {
  const TauComponents components = tau_components(lts);
  return quotient_by(
      lts, components.count(), [&](State s) { return components.of[s.value]; },
      [&](State found, auto add) {
        for (const std::uint32_t s : components.members(components.of[found.value])) {
          for (const Edge& edge : lts.edges(State{s})) add(edge.label, edge.target);
        }
      });
}

}  // namespace perentie::lts

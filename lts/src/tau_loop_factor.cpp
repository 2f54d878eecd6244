// Tarjan's algorithm, from Boost.Graph, numbers a component after all components that it leads to.
#include <algorithm>
#include <boost/graph/strong_components.hpp>
#include <numeric>

#include "discovery.hpp"
#include "graph.hpp"
#include "perentie/lts/compressions.hpp"
#include "tau_components.hpp"

namespace perentie::lts {

TauComponents tau_components(const Lts& lts) {
  TauComponents components;
  components.of.resize(lts.state_count());
  const auto map = boost::make_iterator_property_map(components.of.begin(), TauGraphIndexMap{});
  components.count = boost::strong_components(TauGraph{&lts}, map);
  return components;
}

Quotient tau_loop_factor(const Lts& lts) {
  const TauComponents components = tau_components(lts);
  std::vector<std::uint32_t> begin(components.count + std::size_t{1}, 0);
  for (const std::uint32_t c : components.of) ++begin[c + std::size_t{1}];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<State> members(lts.state_count());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t s = 0; s < members.size(); ++s) members[next[components.of[s]]++] = State{s};

  return quotient_by(
      lts, components.count, [&](State s) { return components.of[s.value]; },
      [&](State found, auto add) {
        const std::uint32_t component = components.of[found.value];
        for (std::uint32_t m = begin[component]; m < begin[component + std::size_t{1}]; ++m) {
          for (const Edge& edge : lts.edges(members[m])) add(edge.label, edge.target);
        }
      });
}

}  // namespace perentie::lts

// Tarjan's algorithm, from Boost.Graph: it numbers a component after those that it leads to.
#include "perentie/lts/strong_components.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>

namespace perentie::lts {

std::vector<std::vector<std::uint32_t>> strong_components(
    const std::vector<std::vector<std::uint32_t>>& successors) {
  boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS> graph(successors.size());
  for (std::uint32_t v = 0; v < successors.size(); ++v) {
    for (const std::uint32_t target : successors[v]) boost::add_edge(v, target, graph);
  }
  std::vector<std::uint32_t> component(successors.size());
  const auto count = boost::strong_components(
      graph,
      boost::make_iterator_property_map(component.begin(), boost::get(boost::vertex_index, graph)));
  std::vector<std::vector<std::uint32_t>> components(count);
  for (std::uint32_t v = 0; v < component.size(); ++v) components[component[v]].push_back(v);
  return components;
}

}  // namespace perentie::lts

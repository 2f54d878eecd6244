// Tarjan's algorithm, from Boost.Graph: it numbers a component after those that it leads to.
#include "perentie/lts/strong_components.hpp"

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/strong_components.hpp>
#include <utility>

namespace perentie::lts {

std::vector<std::vector<std::uint32_t>> strong_components(
    const std::vector<std::vector<std::uint32_t>>& successors) {
  using Graph = boost::compressed_sparse_row_graph<boost::directedS>;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::uint32_t v = 0; v < successors.size(); ++v) {
    for (const std::uint32_t target : successors[v]) edges.emplace_back(v, target);
  }
  const Graph graph(boost::edges_are_sorted, edges.begin(), edges.end(), successors.size());
  std::vector<std::uint32_t> component(successors.size());
  const auto count = boost::strong_components(
      graph,
      boost::make_iterator_property_map(component.begin(), boost::get(boost::vertex_index, graph)));
  std::vector<std::vector<std::uint32_t>> components(count);
  for (std::uint32_t v = 0; v < component.size(); ++v) components[component[v]].push_back(v);
  return components;
}

}  // namespace perentie::lts

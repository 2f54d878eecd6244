// The τ edges of an Lts as a Boost.Graph graph, without a copy.
//
// τ is label 0, so the τ edges of a state are the beginning of its row and the view costs nothing.
// Models VertexListGraph and IncidenceGraph; vertices are state numbers. Included only by the .cpp
// files that run a Boost algorithm behind a plain function.
#pragma once

#include <boost/graph/graph_traits.hpp>
#include <boost/graph/properties.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/property_map.hpp>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

struct TauEdge {
  std::uint32_t source = 0;
  const Edge* edge = nullptr;

  friend bool operator==(const TauEdge&, const TauEdge&) = default;
};

class TauEdgeIterator : public boost::iterator_facade<TauEdgeIterator, TauEdge,
                                                      boost::random_access_traversal_tag, TauEdge> {
 public:
  TauEdgeIterator() = default;
  explicit TauEdgeIterator(TauEdge at) : at_(at) {}

 private:
  friend class boost::iterator_core_access;

  TauEdge dereference() const { return at_; }
  bool equal(const TauEdgeIterator& other) const { return at_.edge == other.at_.edge; }
  void increment() { ++at_.edge; }
  void decrement() { --at_.edge; }
  void advance(std::ptrdiff_t count) { at_.edge += count; }
  std::ptrdiff_t distance_to(const TauEdgeIterator& other) const {
    return other.at_.edge - at_.edge;
  }

  TauEdge at_;
};

/// Keeps a pointer: the Lts must outlive the view. The member types are those that
/// boost::graph_traits asks for.
struct TauGraph {
  using vertex_descriptor = std::uint32_t;
  using edge_descriptor = TauEdge;
  using vertex_iterator = boost::counting_iterator<std::uint32_t>;
  using out_edge_iterator = TauEdgeIterator;
  using vertices_size_type = std::uint32_t;
  using degree_size_type = std::size_t;
  using directed_category = boost::directed_tag;
  using edge_parallel_category = boost::disallow_parallel_edge_tag;
  struct traversal_category : boost::incidence_graph_tag, boost::vertex_list_graph_tag {};

  static std::uint32_t null_vertex() { return State{}.value; }

  const Lts* lts = nullptr;
};

inline std::uint32_t num_vertices(const TauGraph& graph) {
  return static_cast<std::uint32_t>(graph.lts->state_count());
}

inline std::pair<TauGraph::vertex_iterator, TauGraph::vertex_iterator> vertices(
    const TauGraph& graph) {
  return {TauGraph::vertex_iterator(0), TauGraph::vertex_iterator(num_vertices(graph))};
}

inline std::size_t out_degree(std::uint32_t vertex, const TauGraph& graph) {
  return graph.lts->edges(State{vertex}, tau).size();
}

inline std::pair<TauEdgeIterator, TauEdgeIterator> out_edges(std::uint32_t vertex,
                                                             const TauGraph& graph) {
  const auto edges = graph.lts->edges(State{vertex}, tau);
  return {TauEdgeIterator({vertex, edges.data()}),
          TauEdgeIterator({vertex, edges.data() + edges.size()})};
}

inline std::uint32_t source(const TauEdge& edge, const TauGraph&) { return edge.source; }
inline std::uint32_t target(const TauEdge& edge, const TauGraph&) {
  return edge.edge->target.value;
}

using TauGraphIndexMap = boost::typed_identity_property_map<std::uint32_t>;
inline TauGraphIndexMap get(boost::vertex_index_t, const TauGraph&) { return {}; }
inline std::uint32_t get(boost::vertex_index_t, const TauGraph&, std::uint32_t vertex) {
  return vertex;
}

}  // namespace perentie::lts

template <>
struct boost::property_map<perentie::lts::TauGraph, boost::vertex_index_t> {
  using type = perentie::lts::TauGraphIndexMap;
  using const_type = type;
};

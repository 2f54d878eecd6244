// Tarjan's algorithm, from Boost.Graph, numbers a component after all components that it leads to.
#include <algorithm>
#include <boost/graph/strong_components.hpp>
#include <numeric>

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

  std::vector<State> number(components.count);
  std::vector<std::uint32_t> found;  // by new number, its component
  const auto visit = [&](State s) {
    State& known = number[components.of[s.value]];
    if (known.is_none()) {
      known = State{static_cast<std::uint32_t>(found.size())};
      found.push_back(components.of[s.value]);
    }
    return known;
  };
  visit(lts.initial());
  LtsRowBuilder rows;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::uint32_t m = begin[found[i]]; m < begin[found[i] + std::size_t{1}]; ++m) {
      for (const Edge& edge : lts.edges(members[m])) rows.add_edge(edge.label, visit(edge.target));
    }
    rows.end_row();
  }
  std::vector<State> block_of(lts.state_count());
  for (std::uint32_t s = 0; s < block_of.size(); ++s) block_of[s] = number[components.of[s]];
  return {std::move(rows).finish(State{0}, found.size(), lts.shared_label_names()),
          std::move(block_of)};
}

}  // namespace perentie::lts

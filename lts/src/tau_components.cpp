// Tarjan's algorithm, from Boost.Graph, numbers a component after all components that it leads to.
#include "tau_components.hpp"

#include <boost/graph/strong_components.hpp>
#include <numeric>

#include "graph.hpp"

namespace perentie::lts {

TauComponents tau_components(const Lts& lts) {
  TauComponents result;
  result.of.resize(lts.state_count());
  const auto map = boost::make_iterator_property_map(result.of.begin(), TauGraphIndexMap{});
  const std::size_t count = boost::strong_components(TauGraph{&lts}, map);

  result.begin.resize(count + 1, 0);
  for (const std::uint32_t c : result.of) ++result.begin[c + std::size_t{1}];
  std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
  result.states.resize(lts.state_count());
  std::vector<std::uint32_t> next(result.begin.begin(), result.begin.end() - 1);
  for (std::uint32_t s = 0; s < result.of.size(); ++s) result.states[next[result.of[s]]++] = s;
  return result;
}

}  // namespace perentie::lts

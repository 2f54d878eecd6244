#include "machine/leaf.hpp"

#include <unordered_map>

#include "perentie/lts/memory.hpp"

namespace perentie::semantics {

LeafResult explore_leaf(StepRules& rules, ProcId initial, std::uint64_t max_states,
                        const base::Budget& budget) {
  constexpr std::size_t states_between_looks = 256;
  LeafGraph graph;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;  // of terms
  const auto number = [&](ProcId term) {
    const auto next = static_cast<std::uint32_t>(graph.states.size());
    const auto [place, is_new] = numbers.emplace(term.value, next);
    if (is_new) graph.states.push_back(term);
    return lts::State{place->second};
  };
  number(initial);
  StepRules::Steps steps;
  std::vector<lts::Edge> row;
  for (std::size_t s = 0; s < graph.states.size(); ++s) {
    if (graph.states.size() > max_states) return {std::nullopt, LeafFailure::too_many_states};
    if (s % states_between_looks == 0) {
      const std::uint64_t bytes = graph.rows.peak_bytes(0) + lts::peak_bytes(graph.states, 0);
      if (budget.check_time() || budget.check_memory(bytes)) return {};
    }
    steps.clear();
    row.clear();
    if (!rules.successors(graph.states[s], steps)) return {};
    for (const StepRules::Step& step : steps) row.push_back({step.label, number(step.target)});
    graph.rows.add(row);
  }
  return {std::move(graph)};
}

std::vector<lts::Label> LeafGraph::labels() const {
  std::vector<bool> occurs;
  for (std::uint32_t s = 0; s < state_count(); ++s) {
    for (const lts::Edge& edge : edges(s)) {
      if (edge.label.value >= occurs.size()) occurs.resize(edge.label.value + 1);
      occurs[edge.label.value] = true;
    }
  }
  std::vector<lts::Label> found;
  for (std::uint32_t i = 0; i < occurs.size(); ++i) {
    if (occurs[i]) found.push_back(lts::Label{i});
  }
  return found;
}

}  // namespace perentie::semantics

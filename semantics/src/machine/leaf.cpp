#include "machine/leaf.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "perentie/lts/bisimulation.hpp"
#include "perentie/lts/generalised_lts.hpp"
#include "perentie/lts/memory.hpp"
#include "perentie/lts/weak_bisimulation.hpp"

namespace perentie::semantics {

LeafResult explore_leaf(StepRules& rules, ProcId initial, std::uint64_t max_states,
                        const base::Budget& budget) {
  constexpr std::size_t states_between_looks = 256;
  LeafGraph graph;
  const auto number = [&](ProcId term) {
    const auto next = static_cast<std::uint32_t>(graph.states.size());
    const auto [place, is_new] = graph.numbers.emplace(term.value, next);
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

namespace {

struct GraphState {
  const CompressedProcess* graph = nullptr;  // none: the term is no state of a generalised LTS
  lts::State state = {};
};

GraphState graph_state(ProcId term, const ProcStore& processes, CompressionRules compressions) {
  const bool is_inner = processes.kind(term) == ProcKind::compressed_state;
  const ProcId whole = is_inner ? processes.operand(term, 0) : term;
  if (processes.kind(whole) != ProcKind::compression) return {};
  const auto preserved =
      is_inner ? static_cast<Preserved>(processes.word(term, 1)) : compressions.preserved;
  const auto* graph = compressions.compressor.compressed(whole, preserved);
  if (graph == nullptr || !graph->is_generalised) return {};
  return {graph, is_inner ? lts::State{processes.word(term, 2)} : graph->lts.initial()};
}

}  // namespace

bool is_generalised(ProcId term, const ProcStore& processes, CompressionRules compressions) {
  return graph_state(term, processes, compressions).graph != nullptr;
}

void find_generalised(LeafGraph& leaf, const ProcStore& processes, CompressionRules compressions) {
  for (std::uint32_t s = 0; s < leaf.state_count(); ++s) {
    const auto [graph, state] = graph_state(leaf.states[s], processes, compressions);
    if (graph == nullptr || graph->lts.is_stable(state)) continue;
    if (!lts::only_chooses_acceptances(graph->lts, state)) continue;
    leaf.generalised.resize(leaf.state_count());
    leaf.generalised[s] = true;
  }
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

std::uint64_t LeafGraph::edge_count() const {
  std::uint64_t count = 0;
  for (std::uint32_t s = 0; s < state_count(); ++s) count += edges(s).size();
  return count;
}

namespace {

std::optional<lts::Quotient> quotient_of(const lts::Lts& lts, LeafCompression compression,
                                         const base::Limits& limits) {
  if (compression == LeafCompression::sbisim) return lts::strong_bisimulation(lts);
  auto result = lts::weak_bisimulation(lts, limits);
  if (auto* quotient = std::get_if<lts::Quotient>(&result)) return std::move(*quotient);
  return std::nullopt;
}

}  // namespace

LeafGraph compress_leaf(LeafGraph leaf, LeafCompression compression, const base::Limits& limits) {
  // The names of labels do not matter to bisimulation.
  const auto labels = leaf.labels();
  const std::size_t label_count = labels.empty() ? 2 : std::max(labels.back().value + 1, 2U);
  auto names = std::make_shared<lts::LabelNames>(label_count);
  (*names)[lts::tau.value] = lts::tau_name;
  (*names)[lts::tick.value] = lts::tick_name;
  lts::LtsRowBuilder builder;
  for (std::uint32_t s = 0; s < leaf.state_count(); ++s) {
    for (const lts::Edge& edge : leaf.edges(s)) builder.add_edge(edge.label, edge.target);
    builder.end_row();
  }
  const auto quotient =
      quotient_of(std::move(builder).finish(lts::State{0}, leaf.state_count(), std::move(names)),
                  compression, limits);
  if (!quotient || quotient->lts.state_count() == leaf.state_count()) return leaf;
  LeafGraph smaller;
  smaller.states.resize(quotient->lts.state_count());
  for (std::uint32_t s = leaf.state_count(); s-- > 0;) {
    const lts::State block = quotient->block_of[s];
    if (block) smaller.states[block.value] = leaf.states[s];  // in the end the first one
  }
  for (const auto& [term, state] : leaf.numbers) {
    const lts::State block = quotient->block_of[state];
    if (block) smaller.numbers.emplace(term, block.value);
  }
  for (std::uint32_t s = 0; s < smaller.state_count(); ++s) {
    smaller.rows.add(quotient->lts.edges(lts::State{s}));
  }
  for (std::uint32_t s = 0; s < leaf.generalised.size(); ++s) {
    const lts::State block = quotient->block_of[s];
    if (!leaf.generalised[s] || !block) continue;
    if (!lts::only_chooses_acceptances(quotient->lts, block)) continue;
    smaller.generalised.resize(smaller.state_count());
    smaller.generalised[block.value] = true;
  }
  return smaller;
}

}  // namespace perentie::semantics

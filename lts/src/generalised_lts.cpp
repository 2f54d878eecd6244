#include "perentie/lts/generalised_lts.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "perentie/base/check.hpp"

namespace perentie::lts {
namespace {

/// Whether the edges of a state alone say what its labels say.
bool is_plain(const GeneralisedLts& generalised, State state) {
  const auto acceptances = generalised.acceptances.of(state);
  if (generalised.divergent[state.value] || acceptances.size() != 1) return false;
  const auto accepted = generalised.acceptances.labels(acceptances[0]);
  const auto edges = generalised.lts.edges(state);
  return std::ranges::all_of(
      edges, [&](const Edge& edge) { return std::ranges::binary_search(accepted, edge.label); });
}

}  // namespace

Lts plain_lts(const GeneralisedLts& generalised) {
  const Lts& lts = generalised.lts;
  const auto state_count = static_cast<std::uint32_t>(lts.state_count());
  std::map<std::vector<Edge>, State> stable_states;
  std::vector<const std::vector<Edge>*> stable_rows;
  LtsRowBuilder builder;
  std::vector<Edge> row;
  for (std::uint32_t s = 0; s < state_count; ++s) {
    const auto edges = lts.edges(State{s});
    for (const Edge& edge : edges) builder.add_edge(edge.label, edge.target);
    if (!is_plain(generalised, State{s})) {
      const auto acceptances = generalised.acceptances.of(State{s});
      PERENTIE_CHECK(generalised.divergent[s] || !acceptances.empty(),
                     "a state neither diverges nor accepts anything");
      if (generalised.divergent[s]) builder.add_edge(tau, State{s});
      for (const AcceptanceId id : acceptances) {
        const auto accepted = generalised.acceptances.labels(id);
        row.clear();
        std::ranges::copy_if(edges, std::back_inserter(row), [&](const Edge& edge) {
          return std::ranges::binary_search(accepted, edge.label);
        });
        const State next{state_count + static_cast<std::uint32_t>(stable_rows.size())};
        const auto [known, is_new] = stable_states.emplace(row, next);
        if (is_new) stable_rows.push_back(&known->first);
        builder.add_edge(tau, known->second);
      }
    }
    builder.end_row();
  }
  for (const std::vector<Edge>* edges : stable_rows) {
    for (const Edge& edge : *edges) builder.add_edge(edge.label, edge.target);
    builder.end_row();
  }
  return std::move(builder).finish(lts.initial(), state_count + stable_rows.size(),
                                   lts.shared_label_names());
}

bool only_chooses_acceptances(const Lts& lts, State state) {
  const auto edges = lts.edges(state);
  return std::ranges::all_of(lts.edges(state, tau), [&](const Edge& edge) {
    return edge.target == state ||
           (lts.is_stable(edge.target) && std::ranges::includes(edges, lts.edges(edge.target)));
  });
}

}  // namespace perentie::lts

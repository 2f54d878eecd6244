#include "perentie/lts/normalise.hpp"

#include <algorithm>

#include "perentie/lts/divergence.hpp"
#include "subsets.hpp"

namespace perentie::lts {

Normalisation normalise(const Lts& lts, const NormaliseOptions& options) {
  Subsets subsets(lts, options.limits);
  LtsRowBuilder rows;
  std::optional<AcceptanceBuilder> acceptances;
  if (options.acceptances) acceptances.emplace(lts);

  std::optional<base::LimitReached> limit;
  std::vector<Edge> row;
  for (std::uint32_t n = 0; n < subsets.size(); ++n) {
    row.clear();
    const std::span<const Edge> visible = subsets.visible_edges(State{n});
    const std::uint64_t other_bytes =
        rows.peak_bytes(visible.size()) + (acceptances ? acceptances->peak_bytes() : 0);
    limit = subsets.successors(visible, other_bytes, row);
    if (limit) break;
    for (const Edge& edge : row) rows.add_edge(edge.label, edge.target);
    rows.end_row();
    if (acceptances) acceptances->add(subsets.members(State{n}));
  }

  const std::size_t expanded = rows.row_count();
  Runs<State> members = std::move(subsets).take_members();
  const std::vector<bool> diverges = divergent_states(lts);
  std::vector<bool> divergent(members.size());
  for (std::size_t n = 0; n < members.size(); ++n) {
    divergent[n] = std::ranges::any_of(members[n], [&](State s) { return diverges[s.value]; });
    if (acceptances && n >= expanded) acceptances->add({});
  }
  NormalLts normal{std::move(rows).finish(State{0}, members.size(), lts.shared_label_names()),
                   std::move(members), std::move(divergent), std::nullopt};
  if (acceptances) normal.acceptances = std::move(*acceptances).finish();
  return {std::move(normal), expanded, limit};
}

}  // namespace perentie::lts

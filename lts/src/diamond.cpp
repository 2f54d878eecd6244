#include <algorithm>

#include "discovery.hpp"
#include "perentie/lts/compressions.hpp"
#include "perentie/lts/divergence.hpp"
#include "perentie/lts/memory.hpp"
#include "perentie/lts/watch.hpp"
#include "tau_closure.hpp"

namespace perentie::lts {

namespace {

/// Removes from `targets` those that τ leads to from another of them. τ has no cycles but loops.
void keep_first(const Lts& lts, TauClosure& closure, std::vector<State>& targets) {
  if (targets.size() < 2) return;
  std::vector<State> behind;
  for (const State target : targets) {
    for (const Edge& edge : lts.edges(target, tau)) {
      if (edge.target != target) behind.push_back(edge.target);
    }
  }
  std::ranges::sort(behind);
  behind.erase(std::unique(behind.begin(), behind.end()), behind.end());
  closure.close(behind);
  std::erase_if(targets, [&](State target) { return closure.has(target); });
}

}  // namespace

GeneralisedResult diamond(const Lts& original, const base::Limits& limits) {
  const Quotient factored = tau_loop_factor(original);
  const Lts& lts = factored.lts;
  const std::vector<bool> diverges = divergent_states(lts);
  Watch watch(limits);
  TauClosure closure(lts);
  AcceptanceBuilder acceptances(lts);
  LtsRowBuilder rows;
  std::vector<bool> divergent;
  Discovery kept(lts.state_count());
  const auto visit = [&](State s) { return kept.find(s.value, s); };

  std::vector<State> reached;
  std::vector<Edge> visible;
  std::vector<State> targets;
  visit(lts.initial());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (watch.due()) {
      if (const auto limit = watch.look()) return *limit;
      const std::uint64_t bytes = rows.peak_bytes(visible.size()) + acceptances.peak_bytes();
      if (const auto limit = watch.budget().check_memory(bytes)) return *limit;
    }
    reached.assign(1, kept[i]);
    closure.close(reached);
    visible.clear();
    for (const State s : reached) {
      for (const Edge& edge : lts.edges(s)) {
        if (edge.label != tau) visible.push_back(edge);
      }
    }
    acceptances.add(reached);
    divergent.push_back(diverges[kept[i].value]);
    std::ranges::sort(visible);
    visible.erase(std::unique(visible.begin(), visible.end()), visible.end());
    for (auto edge = visible.begin(); edge != visible.end();) {
      const Label label = edge->label;
      targets.clear();
      for (; edge != visible.end() && edge->label == label; ++edge) targets.push_back(edge->target);
      keep_first(lts, closure, targets);
      for (const State target : targets) rows.add_edge(label, visit(target));
    }
    rows.end_row();
  }
  return GeneralisedLts{std::move(rows).finish(State{0}, kept.size(), lts.shared_label_names()),
                        std::move(divergent), std::move(acceptances).finish()};
}

}  // namespace perentie::lts

#include "perentie/test/refinement_oracle.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace perentie::test {

using Kind = NaiveRefutation::Kind;

bool any_diverges(const lts::Lts& lts, StateSet set) {
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (contains(set, s) && diverges(lts, s)) return true;
  }
  return false;
}

std::optional<Kind> naive_violation(const lts::Lts& specification, StateSet after,
                                    const lts::Lts& implementation, std::uint32_t state,
                                    Semantics semantics) {
  const LabelSet offered = initials(implementation, state);
  for (const lts::Label label : offered) {
    if (label != lts::tau && step(specification, after, label) == 0) return Kind::event;
  }
  if (semantics == Semantics::traces) return std::nullopt;
  if (is_stable(implementation, state)) {
    const std::set<LabelSet> allowed = minimal_acceptances(specification, after);
    const bool accepted = std::any_of(allowed.begin(), allowed.end(), [&](const LabelSet& least) {
      return std::includes(offered.begin(), offered.end(), least.begin(), least.end());
    });
    if (!accepted) return Kind::acceptance;
  }
  if (semantics == Semantics::failures_divergences && diverges(implementation, state)) {
    return Kind::divergence;
  }
  return std::nullopt;
}

std::optional<NaiveRefutation> naive_refutation(const lts::Lts& specification,
                                                const lts::Lts& implementation,
                                                Semantics semantics) {
  struct Pair {
    Word trace;
    StateSet specification;
    StateSet implementation;
  };
  std::vector<Pair> pairs{{{}, after(specification, {}), after(implementation, {})}};
  std::set<std::pair<StateSet, StateSet>> seen;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pair pair = pairs[i];
    if (!seen.emplace(pair.specification, pair.implementation).second) continue;
    if (semantics == Semantics::failures_divergences &&
        any_diverges(specification, pair.specification)) {
      continue;
    }
    for (std::uint32_t s = 0; s < implementation.state_count(); ++s) {
      if (!contains(pair.implementation, s)) continue;
      const auto wrong =
          naive_violation(specification, pair.specification, implementation, s, semantics);
      if (wrong) return NaiveRefutation{*wrong, pair.trace};
    }
    for (std::uint32_t l = lts::tick.value; l < implementation.label_names().size(); ++l) {
      const lts::Label label{l};
      const StateSet next =
          tau_closure(implementation, step(implementation, pair.implementation, label));
      if (next == 0) continue;
      Word longer = pair.trace;
      longer.push_back(label);
      pairs.push_back({std::move(longer),
                       tau_closure(specification, step(specification, pair.specification, label)),
                       next});
    }
  }
  return std::nullopt;
}

NaiveCounts naive_counts(const lts::Lts& specification, const lts::Lts& implementation,
                         Semantics semantics) {
  using Pair = std::pair<StateSet, std::uint32_t>;
  NaiveCounts counts;
  std::set<Pair> seen;
  std::set<Pair> level{{after(specification, {}), implementation.initial().value}};
  while (!level.empty()) {
    std::set<Pair> next_level;
    seen.insert(level.begin(), level.end());
    for (const auto& [node, state] : level) {
      const auto edges = implementation.edges(lts::State{state});
      ++counts.states;
      counts.transitions += edges.size();
      if (semantics == Semantics::failures_divergences && any_diverges(specification, node)) {
        continue;
      }
      if (naive_violation(specification, node, implementation, state, semantics)) {
        counts.holds = false;
        continue;
      }
      for (const lts::Edge& edge : edges) {
        const StateSet next =
            edge.label == lts::tau
                ? node
                : tau_closure(specification, step(specification, node, edge.label));
        if (!seen.contains({next, edge.target.value})) next_level.insert({next, edge.target.value});
      }
    }
    if (!counts.holds) return counts;
    ++counts.plys;
    level = std::move(next_level);
  }
  return counts;
}

}  // namespace perentie::test

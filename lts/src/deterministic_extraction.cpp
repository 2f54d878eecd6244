#include "perentie/lts/deterministic_extraction.hpp"

#include <vector>

#include "discovery.hpp"

namespace perentie::lts {

namespace {

/// By state: the stable state that its first τ lead to, or `divergent` if they never end.
std::vector<State> ends_of_tau(const Lts& lts, State divergent) {
  std::vector<State> ends(lts.state_count());
  std::vector<bool> is_passed(lts.state_count(), false);
  std::vector<State> path;
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    path.clear();
    State state{s};
    State end;
    while (!end) {
      if (ends[state.value]) {
        end = ends[state.value];
      } else if (is_passed[state.value]) {  // on this very path
        end = divergent;
      } else {
        is_passed[state.value] = true;
        path.push_back(state);
        if (lts.is_stable(state)) end = state;
        if (!end) state = lts.edges(state).front().target;
      }
    }
    for (const State passed : path) ends[passed.value] = end;
  }
  return ends;
}

}  // namespace

Lts deterministic_extraction(const Lts& lts) {
  const State divergent{static_cast<std::uint32_t>(lts.state_count())};
  const std::vector<State> ends = ends_of_tau(lts, divergent);
  const auto class_of = [&](State s) { return ends[s.value].value; };
  const auto add_edges = [&](State member, const auto& add) {
    const State state = ends[member.value];
    if (state == divergent) return add(tau, member);
    Label last = tau;
    for (const Edge& edge : lts.edges(state)) {
      if (edge.label != last) add(edge.label, edge.target);
      last = edge.label;
    }
  };
  return quotient_by(lts, lts.state_count() + 1, class_of, add_edges).lts;
}

}  // namespace perentie::lts

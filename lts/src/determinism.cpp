#include "perentie/lts/determinism.hpp"

#include <algorithm>
#include <span>

#include "perentie/lts/divergence.hpp"
#include "subsets.hpp"

namespace perentie::lts {

namespace {

/// The least label of `performed` that some stable state of `states` refuses. `performed` holds at
/// least the labels of these states.
std::optional<Label> least_refused(const Lts& lts, std::span<const State> states,
                                   std::span<const Label> performed) {
  std::size_t least = performed.size();
  for (const State state : states) {
    if (!lts.is_stable(state)) continue;
    const std::span<const Edge> offered = lts.edges(state);
    auto offer = offered.begin();
    for (std::size_t i = 0; i < least; ++i) {
      while (offer != offered.end() && offer->label < performed[i]) ++offer;
      if (offer == offered.end() || offer->label != performed[i]) least = i;
    }
  }
  if (least == performed.size()) return std::nullopt;
  return performed[least];
}

Nondeterminism refusal_witness(const Lts& lts, std::vector<Label> trace, Label event) {
  const auto performs = [&](State s) { return !lts.edges(s, event).empty(); };
  const auto refuses = [&](State s) { return lts.is_stable(s) && !performs(s); };
  Path refusing = shortest_path(lts, refuses, trace).value();
  Path performing = shortest_path(lts, performs, trace).value();
  performing.push_back(lts.edges(end_of(lts, performing), event).front());
  return {std::move(trace), event, std::move(refusing), std::move(performing)};
}

Nondeterminism divergence_witness(const Lts& lts, std::vector<Label> trace,
                                  const std::vector<bool>& divergent) {
  const auto diverges = [&](State s) { return bool{divergent[s.value]}; };
  Path path = shortest_path(lts, diverges, trace).value();
  return {std::move(trace), std::nullopt, std::move(path), {}};
}

/// How each node of the subset construction was found first.
class Discoveries {
 public:
  void note(State parent, std::span<const Edge> edges) {
    for (const Edge& edge : edges) {
      if (edge.target.value == found_.size()) found_.push_back({parent, edge.label});
    }
  }
  std::vector<Label> trace_to(State node) const {
    std::vector<Label> trace;
    for (; node != State{0}; node = found_[node.value].parent) {
      trace.push_back(found_[node.value].label);
    }
    std::ranges::reverse(trace);
    return trace;
  }
  std::uint64_t peak_bytes(std::size_t more) const { return lts::peak_bytes(found_, more); }

 private:
  struct Discovery {
    State parent;
    Label label;
  };
  std::vector<Discovery> found_ = std::vector<Discovery>(1);  // node 0 needs none
};

}  // namespace

DeterminismVerdict check_determinism(const Lts& lts, DeterminismModel model,
                                     const base::Limits& limits) {
  std::vector<bool> divergent;
  if (model == DeterminismModel::failures_divergences) divergent = divergent_states(lts);

  Subsets subsets(lts, limits);
  Discoveries discoveries;
  std::vector<Edge> row;
  for (std::uint32_t n = 0; n < subsets.size(); ++n) {
    const State node{n};
    const std::span<const Edge> visible = subsets.visible_edges(node);
    const std::span<const State> members = subsets.members(node);
    if (const auto event = least_refused(lts, members, labels_on(visible))) {
      return refusal_witness(lts, discoveries.trace_to(node), *event);
    }
    if (!divergent.empty() &&
        std::ranges::any_of(members, [&](State s) { return divergent[s.value]; })) {
      return divergence_witness(lts, discoveries.trace_to(node), divergent);
    }
    row.clear();
    if (const auto limit =
            subsets.successors(visible, discoveries.peak_bytes(visible.size()), row)) {
      return *limit;
    }
    discoveries.note(node, row);
  }
  return Deterministic{};
}

}  // namespace perentie::lts

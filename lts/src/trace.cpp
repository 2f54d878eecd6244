#include "perentie/lts/trace.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>

#include "perentie/base/hash.hpp"
#include "perentie/base/id.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/lts/lts_system.hpp"

namespace perentie::lts {

namespace {

/// An Lts that performs no trace but one: a state knows how much of the trace has been performed.
class AlongTrace {
 public:
  struct State {
    lts::State state;
    std::size_t done = 0;
    friend bool operator==(const State&, const State&) = default;
  };

  AlongTrace(const Lts& lts, std::span<const Label> trace) : lts_(&lts), trace_(trace) {}

  State initial() const { return {lts_->initial(), 0}; }
  bool successors(const State& s, std::vector<Transition<State>>& out) const {
    for (const Edge& edge : lts_->edges(s.state, tau)) out.push_back({tau, {edge.target, s.done}});
    if (s.done == trace_.size()) return true;
    for (const Edge& edge : lts_->edges(s.state, trace_[s.done])) {
      out.push_back({edge.label, {edge.target, s.done + 1}});
    }
    return true;
  }
  std::uint64_t state_hash(const State& s) const { return base::hash_mix(s.done, s.state.value); }
  std::shared_ptr<const LabelNames> label_names() const { return lts_->shared_label_names(); }

 private:
  const Lts* lts_;
  std::span<const Label> trace_;
};

lts::State lts_state(lts::State s) { return s; }
lts::State lts_state(const AlongTrace::State& s) { return s.state; }

/// Breadth-first search with one parent a state.
template <TransitionSystem System, class Goal>
std::optional<Path> search(System system, Goal goal) {
  using S = typename System::State;
  struct Step {
    std::size_t parent = 0;
    Edge edge;
  };
  VisitedStates<System> visited(system);
  std::vector<Step> steps;  // how each visited state was found
  std::vector<Transition<S>> successors;

  visited.add(system.initial());
  steps.push_back({});
  for (std::size_t next = 0; next < visited.size(); ++next) {
    if (goal(visited[next])) {
      Path path;
      for (std::size_t at = next; at != 0; at = steps[at].parent) path.push_back(steps[at].edge);
      std::reverse(path.begin(), path.end());
      return path;
    }
    successors.clear();
    system.successors(visited[next], successors);
    for (Transition<S>& t : successors) {
      const Edge edge{t.label, lts_state(t.target)};
      visited.add(std::move(t.target));
      if (visited.size() > steps.size()) steps.push_back({next, edge});
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Path> shortest_path(const Lts& lts, const std::function<bool(State)>& goal) {
  return search(LtsSystem(lts), goal);
}

std::optional<Path> shortest_path(const Lts& lts, const std::function<bool(State)>& goal,
                                  std::span<const Label> trace) {
  return search(AlongTrace(lts, trace), [&](const AlongTrace::State& s) {
    return s.done == trace.size() && goal(s.state);
  });
}

std::vector<Label> labels_of(const Path& path) {
  std::vector<Label> labels;
  for (const Edge& edge : path) labels.push_back(edge.label);
  return labels;
}

std::vector<Label> trace_of(const Path& path) {
  std::vector<Label> labels = labels_of(path);
  std::erase(labels, tau);
  return labels;
}

State end_of(const Lts& lts, const Path& path) {
  return path.empty() ? lts.initial() : path.back().target;
}

}  // namespace perentie::lts

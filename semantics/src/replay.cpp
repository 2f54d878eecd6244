#include "replay.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "perentie/lts/watch.hpp"

namespace perentie::semantics {
namespace {

// A counterexample is found again much sooner than this, or it is not worth the memory.
constexpr std::size_t max_nodes = 5'000'000;

}  // namespace

std::vector<Step> NamedTerms::steps(ProcId state) {
  std::vector<Step> steps;
  if (!terms_.successors(state, steps)) steps.clear();
  return steps;
}

const std::string& NamedTerms::name(lts::Label label) {
  // Names are made when events are first used: the list grows.
  if (!names_ || label.value >= names_->size()) names_ = terms_.label_names();
  return (*names_)[label.value];
}

std::optional<std::vector<lts::Label>> NamedTerms::offers(ProcId state) {
  std::vector<lts::Label> labels;
  for (const Step& step : steps(state)) {
    if (step.label == lts::tau) return std::nullopt;
    labels.push_back(step.label);
  }
  std::ranges::sort(labels);
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

std::optional<Run> find_run(NamedTerms& system, const RunSearch& search) {
  struct Node {
    std::size_t place;
    ProcId state;
    std::size_t from;
    lts::Label label;
  };
  std::vector<Node> nodes;
  std::set<std::pair<std::size_t, std::uint32_t>> seen;
  const auto add = [&](Node node) {
    if (seen.emplace(node.place, node.state.value).second) nodes.push_back(node);
  };
  lts::Watch watch(search.limits);
  add({0, system.terms().initial(), 0, {}});
  for (std::size_t n = 0; n < nodes.size() && n < max_nodes; ++n) {
    if (watch.due() && watch.look()) return std::nullopt;
    const Node node = nodes[n];
    if (node.place == search.trace.size() && search.ends_well(node.state)) {
      Run run;
      run.states.push_back(node.state);
      for (std::size_t i = n; i != 0; i = nodes[i].from) {
        run.labels.push_back(nodes[i].label);
        run.states.push_back(nodes[nodes[i].from].state);
      }
      std::ranges::reverse(run.labels);
      std::ranges::reverse(run.states);
      return run;
    }
    for (const Step& step : system.steps(node.state)) {
      if (search.skips_tau && step.label == lts::tau) {
        add({node.place, step.target, n, step.label});
      } else if (node.place < search.trace.size() &&
                 system.name(step.label) == search.trace[node.place]) {
        add({node.place + 1, step.target, n, step.label});
      }
    }
  }
  return std::nullopt;
}

std::optional<TauLoop> find_tau_loop(NamedTerms& system, ProcId start, const base::Limits& limits) {
  struct Frame {
    ProcId state;
    std::vector<ProcId> targets;  // by τ
    std::size_t next = 0;
  };
  constexpr std::size_t done = static_cast<std::size_t>(-1);
  std::vector<Frame> path;
  std::unordered_map<std::uint32_t, std::size_t> place;  // in the path, or done
  lts::Watch watch(limits);
  const auto enter = [&](ProcId state) {
    place[state.value] = path.size();
    path.push_back({state, {}});
    for (const Step& step : system.steps(state)) {
      if (step.label == lts::tau) path.back().targets.push_back(step.target);
    }
  };
  enter(start);
  while (!path.empty()) {
    if (place.size() > max_nodes || (watch.due() && watch.look())) return std::nullopt;
    Frame& frame = path.back();
    if (frame.next == frame.targets.size()) {
      place[frame.state.value] = done;
      path.pop_back();
      continue;
    }
    const ProcId target = frame.targets[frame.next++];
    const auto known = place.find(target.value);
    if (known == place.end()) {
      enter(target);
    } else if (known->second != done) {
      TauLoop loop;
      for (const Frame& passed : path) loop.run.states.push_back(passed.state);
      loop.run.states.push_back(target);
      loop.run.labels.assign(path.size(), lts::tau);
      loop.loop_start = known->second;
      return loop;
    }
  }
  return std::nullopt;
}

}  // namespace perentie::semantics

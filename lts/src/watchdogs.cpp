#include "perentie/lts/watchdogs.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "hitting_sets.hpp"
#include "perentie/lts/compressions.hpp"

namespace perentie::lts {

namespace {

constexpr std::uint64_t max_hitting_sets = 100'000;

/// Adds what all watchdogs have. The nodes keep their numbers; other states come after them.
class WatchdogBuilder {
 public:
  WatchdogBuilder(const Lts& nodes, std::span<const Label> events, Label bark)
      : nodes_(nodes),
        events_(events.begin(), events.end()),
        bark_(bark),
        builder_(nodes.shared_label_names()) {
    builder_.add_states(static_cast<std::uint32_t>(nodes.state_count()));
    std::ranges::sort(events_);
    events_.erase(std::unique(events_.begin(), events_.end()), events_.end());
  }

  /// What the node allows, and the events that make the watchdog bark.
  void follow(State node) {
    for (const Edge& edge : nodes_.edges(node)) add_step(node, edge);
    for (const Label event : events_) {
      if (nodes_.edges(node, event).empty()) builder_.add_edge(node, event, barking());
    }
  }

  /// A state behind τ that offers only some of what the node allows.
  void offer_only(State node, std::span<const Label> offered) {
    const State state = builder_.add_state();
    builder_.add_edge(node, tau, state);
    for (const Label label : offered) add_step(state, nodes_.edges(node, label).front());
  }

  void never_wait(State node) { builder_.add_edge(node, tau, node); }

  std::uint64_t state_count() const { return builder_.state_count(); }
  Lts finish() && { return std::move(builder_).finish(nodes_.initial()); }

 private:
  void add_step(State from, const Edge& edge) {
    builder_.add_edge(from, edge.label, edge.label == tick ? stopped() : edge.target);
  }
  State stopped() {
    if (!stopped_) stopped_ = builder_.add_state();
    return stopped_;
  }
  State barking() {
    if (!barking_) {
      barking_ = builder_.add_state();
      builder_.add_edge(barking_, bark_, stopped());
    }
    return barking_;
  }

  const Lts& nodes_;
  std::vector<Label> events_;
  Label bark_;
  LtsBuilder builder_;
  State stopped_;
  State barking_;
};

}  // namespace

WatchdogResult trace_watchdog(const Lts& specification, std::span<const Label> events, Label bark,
                              const base::Limits& limits) {
  const GeneralisedResult normalised = normal(specification, limits);
  if (const auto* limit = std::get_if<base::LimitReached>(&normalised)) return *limit;
  // Nodes that differ in acceptances alone are one here.
  const Lts nodes = strong_bisimulation(std::get<GeneralisedLts>(normalised).lts).lts;
  WatchdogBuilder watchdog(nodes, events, bark);
  for (std::uint32_t n = 0; n < nodes.state_count(); ++n) watchdog.follow(State{n});
  return std::move(watchdog).finish();
}

WatchdogResult failure_watchdog(const Lts& specification, std::span<const Label> events, Label bark,
                                const base::Limits& limits) {
  const base::Budget budget(limits);
  const GeneralisedResult normalised = normal(specification, limits);
  if (const auto* limit = std::get_if<base::LimitReached>(&normalised)) return *limit;
  const auto& nodes = std::get<GeneralisedLts>(normalised);
  WatchdogBuilder watchdog(nodes.lts, events, bark);
  const std::uint64_t most = nodes.lts.state_count() + max_hitting_sets;
  base::Limits rest = budget.rest();
  rest.max_states = std::min(rest.max_states.value_or(most), most);
  const base::Budget states(rest);
  HittingSets hitting_sets(rest);
  for (std::uint32_t n = 0; n < nodes.lts.state_count(); ++n) {
    const State node{n};
    watchdog.follow(node);
    std::vector<std::span<const Label>> acceptances;
    bool may_refuse_all = false;
    for (const AcceptanceId id : nodes.acceptances.of(node)) {
      acceptances.push_back(nodes.acceptances.labels(id));
      may_refuse_all = may_refuse_all || acceptances.back().empty();
    }
    if (may_refuse_all) {
      watchdog.never_wait(node);
      continue;
    }
    if (const auto limit = hitting_sets.find(acceptances)) return *limit;
    for (const std::vector<Label>& set : hitting_sets.found()) watchdog.offer_only(node, set);
    if (const auto limit = states.check_states(watchdog.state_count())) return *limit;
  }
  return std::move(watchdog).finish();
}

}  // namespace perentie::lts

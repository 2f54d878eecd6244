#include "perentie/semantics/process_graph.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "perentie/lts/count.hpp"
#include "perentie/lts/watch.hpp"
#include "perentie/semantics/process_system.hpp"

namespace perentie::semantics {
namespace {

// The minimal acceptances of a state of a generalised system, each with a stable state that offers
// it. `goes_on` is asked before each that is looked at.
template <class System, class GoesOn>
std::map<std::vector<lts::Label>, typename System::State> minimal_acceptances(
    const System& system, const typename System::State& state, GoesOn goes_on) {
  std::map<std::vector<lts::Label>, typename System::State> all;
  system.for_each_stable(state, [&](const auto& stable, const std::vector<lts::Label>& offered) {
    all.emplace(offered, stable);
    return goes_on();
  });
  auto minimal = all;
  std::erase_if(minimal, [&](const auto& entry) {
    return std::ranges::any_of(all, [&](const auto& other) {
      return other.first.size() < entry.first.size() && goes_on() &&
             std::ranges::includes(entry.first, other.first);
    });
  });
  return minimal;
}

// What a generalised system explores as a graph whose edges say everything: τ leads from a state to
// stable states that offer its minimal acceptances, one for each set of edges. The new states go
// behind the explored ones. Nothing is changed if a limit is reached.
template <class System>
std::optional<base::LimitReached> add_stable_states(
    const System& system, const base::Limits& limits,
    lts::Exploration<typename System::State>& found) {
  const std::uint64_t max_states = limits.max_states.value_or(lts::State::none_value);
  lts::Watch watch(limits);
  std::optional<base::LimitReached> limit;
  std::map<std::vector<lts::Edge>, lts::State> numbers;  // by edges
  std::vector<const std::vector<lts::Edge>*> rows;
  auto states = found.states;
  lts::LtsRowBuilder builder;
  const auto goes_on = [&] {
    if (!limit && watch.due()) limit = watch.look();
    if (!limit) limit = watch.budget().check_memory(builder.peak_bytes(0));
    return !limit;
  };
  for (std::uint32_t s = 0; s < found.states.size() && goes_on(); ++s) {
    const auto edges = found.lts.edges(lts::State{s});
    for (const lts::Edge& edge : edges) builder.add_edge(edge.label, edge.target);
    if (system.is_generalised(found.states[s])) {
      for (const auto& [offered, stable] : minimal_acceptances(system, found.states[s], goes_on)) {
        std::vector<lts::Edge> row;
        std::ranges::copy_if(edges, std::back_inserter(row), [&](const lts::Edge& edge) {
          return std::ranges::binary_search(offered, edge.label);
        });
        const lts::State next{static_cast<std::uint32_t>(states.size())};
        const auto [known, is_new] = numbers.emplace(std::move(row), next);
        builder.add_edge(lts::tau, known->second);
        if (!is_new) continue;
        if (states.size() >= max_states)
          return base::LimitReached{base::LimitKind::states, max_states};
        states.push_back(stable);
        rows.push_back(&known->first);
      }
    }
    builder.end_row();
  }
  if (limit) return limit;
  for (const std::vector<lts::Edge>* row : rows) builder.add_row(*row);
  found.lts =
      std::move(builder).finish(found.lts.initial(), states.size(), found.lts.shared_label_names());
  found.expanded = states.size();
  found.states = std::move(states);
  return std::nullopt;
}

// The terms are asked for when the search is over: what they are made from is kept.
template <class System>
std::function<ProcId(lts::State)> terms_of(System& system,
                                           std::vector<typename System::State> states) {
  const auto kept = std::make_shared<const System>(std::move(system));
  return [kept, states = std::move(states)](lts::State s) { return kept->term(states[s.value]); };
}

}  // namespace

ProcessSize count_process(Script& script, ProcId process, const lts::ExploreOptions& options,
                          base::Diagnostics& diagnostics) {
  auto result = with_process_system(
      script, process, options, diagnostics, [](auto& system, const lts::ExploreOptions& bounds) {
        const lts::Count found = lts::count(system, bounds);
        return ProcessSize{found.states, found.transitions, system.structure(), found.failed,
                           found.limit ? found.limit : system.limit()};
      });
  report_growth(script, result.limit, diagnostics);
  return result;
}

ProcessExploration explore_process(Script& script, ProcId process,
                                   const lts::ExploreOptions& options,
                                   base::Diagnostics& diagnostics) {
  auto result = with_process_system(
      script, process, options, diagnostics, [](auto& system, const lts::ExploreOptions& bounds) {
        const base::Budget budget(bounds.limits);
        auto found = lts::explore(system, bounds);
        std::optional<base::LimitReached> limit = found.limit;
        if constexpr (lts::GeneralisedSystem<std::decay_t<decltype(system)>>) {
          if (found.complete() && system.structure().is_generalised) {
            limit = add_stable_states(system, budget.rest(), found);
          }
        }
        ProcessExploration graph{.lts = std::move(found.lts),
                                 .term = {},
                                 .structure = system.structure(),
                                 .complete = found.complete() && !limit,
                                 .failed = found.failed,
                                 .limit = limit ? limit : system.limit()};
        graph.term = terms_of(system, std::move(found.states));
        return graph;
      });
  report_growth(script, result.limit, diagnostics);
  return result;
}

}  // namespace perentie::semantics

#include "perentie/semantics/process_graph.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "perentie/lts/count.hpp"
#include "perentie/semantics/process_system.hpp"

namespace perentie::semantics {
namespace {

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
        auto found = lts::explore(system, bounds);
        ProcessExploration graph{.lts = std::move(found.lts),
                                 .term = {},
                                 .structure = system.structure(),
                                 .complete = found.complete(),
                                 .failed = found.failed,
                                 .limit = found.limit ? found.limit : system.limit()};
        graph.term = terms_of(system, std::move(found.states));
        return graph;
      });
  report_growth(script, result.limit, diagnostics);
  return result;
}

}  // namespace perentie::semantics

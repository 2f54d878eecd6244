#include "perentie/semantics/process_system.hpp"

#include <memory>

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

ProcessExploration explore_process(Script& script, ProcId process,
                                   const lts::ExploreOptions& options,
                                   base::Diagnostics& diagnostics) {
  return with_process_system(
      script, process, options, diagnostics, [](auto& system, const lts::ExploreOptions& bounds) {
        auto found = lts::explore(system, bounds);
        ProcessExploration result{.lts = std::move(found.lts),
                                  .term = {},
                                  .structure = system.structure(),
                                  .complete = found.complete(),
                                  .failed = found.failed,
                                  .limit = found.limit ? found.limit : system.limit()};
        result.term = terms_of(system, std::move(found.states));
        return result;
      });
}

}  // namespace perentie::semantics

#include "machine_support.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "perentie/lts/explore.hpp"
#include "perentie/semantics/process_system.hpp"

namespace perentie::semantics {
namespace {

template <class System>
std::optional<Reached> reached(System& system, std::uint64_t max_states) {
  const auto exploration = lts::explore(system, {.limits = {.max_states = max_states}});
  if (!exploration.complete()) return std::nullopt;
  Reached found;
  std::vector<lts::Transition<typename System::State>> steps;
  for (const auto& state : exploration.states) {
    const ProcId from = system.term(state);
    found.states.push_back(from);
    steps.clear();
    system.successors(state, steps);
    for (const auto& step : steps) {
      found.transitions.push_back({from, step.label, system.term(step.target)});
    }
  }
  std::sort(found.states.begin(), found.states.end());
  std::sort(found.transitions.begin(), found.transitions.end());
  return found;
}

}  // namespace

BothWays explore_both_ways(TestScript& test, const std::string& process, std::size_t min_leaves,
                           std::uint64_t max_states) {
  BothWays result;
  base::Diagnostics diagnostics;
  Script& script = test.script();
  const auto term = script.process(process, diagnostics, process);
  if (!term) return result;
  MachineCompilation compilation =
      script.machine(*term, {.max_leaf_states = max_states, .min_leaves = min_leaves});
  if (compilation.machine) {
    const auto machine = std::make_shared<const CompiledMachine>(std::move(*compilation.machine));
    result.machine = with_width(*machine, [&](auto width) {
      MachineProcess<width()> system(script, machine);
      return reached(system, max_states);
    });
  }
  TermSystem system = script.terms(*term, diagnostics);
  result.steps = reached(system, max_states);
  return result;
}

::testing::AssertionResult same_reached(const Reached& steps, const Reached& machine) {
  if (steps.states != machine.states) {
    return ::testing::AssertionFailure() << "the step rules give " << steps.states.size()
                                         << " states, the machine " << machine.states.size();
  }
  if (steps.transitions != machine.transitions) {
    return ::testing::AssertionFailure()
           << "the step rules give " << steps.transitions.size() << " transitions, the machine "
           << machine.transitions.size();
  }
  return ::testing::AssertionSuccess();
}

}  // namespace perentie::semantics

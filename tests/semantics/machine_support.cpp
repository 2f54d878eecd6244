#include "machine_support.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "perentie/lts/explore.hpp"
#include "perentie/semantics/lazy_machine.hpp"
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

::testing::AssertionResult is_run(Script& script, ProcId process,
                                  const lts::Counterexample<ProcId>& run) {
  base::Diagnostics unheard;
  TermSystem terms = script.terms(process, unheard);
  if (run.states.size() != run.trace.size() + 1 || run.states[0] != terms.initial()) {
    return ::testing::AssertionFailure() << "it does not begin with the process";
  }
  std::vector<lts::Transition<ProcId>> steps;
  for (std::size_t i = 0; i < run.trace.size(); ++i) {
    steps.clear();
    terms.successors(run.states[i], steps);
    const bool goes_on = std::ranges::any_of(steps, [&](const auto& step) {
      return step.label == run.trace[i] && step.target == run.states[i + 1];
    });
    if (!goes_on) return ::testing::AssertionFailure() << "step " << i << " is none";
  }
  if (run.kind != lts::Counterexample<ProcId>::Kind::acceptance) {
    return ::testing::AssertionSuccess();
  }
  steps.clear();
  terms.successors(run.states.back(), steps);
  std::set<lts::Label> offered;
  for (const auto& step : steps) offered.insert(step.label);
  if (!std::ranges::equal(offered, run.offered)) {
    return ::testing::AssertionFailure() << "its last state offers something else";
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult lazy_machine_is_exact(TestScript& test, const std::string& process,
                                                 std::uint64_t max_states) {
  base::Diagnostics unheard;
  Script& script = test.script();
  const auto term = script.process(process, unheard, process);
  if (!term) return ::testing::AssertionSuccess();
  const lts::ExploreOptions options{.limits = {.max_states = max_states}};
  LazyMachine machine = script.lazy_machine(*term, unheard);
  const auto found = lts::explore(machine, options);
  TermSystem terms = script.terms(*term, unheard);
  const auto expected = lts::explore(terms, options);
  if (found.states.size() != expected.states.size() || found.expanded != expected.expanded ||
      found.transitions_fired != expected.transitions_fired) {
    return ::testing::AssertionFailure()
           << "the step rules give " << expected.states.size() << " states and "
           << expected.transitions_fired << " transitions, the machine " << found.states.size()
           << " and " << found.transitions_fired;
  }
  std::vector<lts::Transition<LazyMachine::State>> of_machine;
  std::vector<lts::Transition<ProcId>> of_rules;
  for (std::size_t s = 0; s < found.states.size(); ++s) {
    if (machine.term(found.states[s]) != expected.states[s]) {
      return ::testing::AssertionFailure()
             << "state " << s << " is " << script.show(machine.term(found.states[s])) << ", not "
             << script.show(expected.states[s]);
    }
    if (s >= found.expanded) continue;
    of_machine.clear();
    of_rules.clear();
    machine.successors(found.states[s], of_machine);
    terms.successors(expected.states[s], of_rules);
    const bool same = std::equal(of_machine.begin(), of_machine.end(), of_rules.begin(),
                                 of_rules.end(), [&](const auto& m, const auto& r) {
                                   return m.label == r.label && machine.term(m.target) == r.target;
                                 });
    if (!same) {
      return ::testing::AssertionFailure()
             << "the transitions of " << script.show(expected.states[s]) << " differ";
    }
  }
  return ::testing::AssertionSuccess();
}

}  // namespace perentie::semantics

// with_process_system: a process as the transition system that computes it fastest.
//
// A compiled machine is faster than a lazy one once it is there, but its leaves may be larger than
// the whole process. So small leaves are tried first, then the lazy machine up to some number of
// states, then larger leaves, and so on. Which system answers depends on sizes alone, not on time;
// states and transitions are those of the step rules in all.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "perentie/base/limits.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/lts/refine.hpp"
#include "perentie/semantics/lazy_machine.hpp"
#include "perentie/semantics/machine.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::semantics {

/// A compiled machine that knows its terms, with the members that `LazyMachine` has.
template <std::size_t words>
class MachineProcess : public MachineSystem<words> {
 public:
  using State = typename MachineSystem<words>::State;

  MachineProcess(Script& script, std::shared_ptr<const CompiledMachine> machine)
      : MachineSystem<words>(*machine), script_(&script), machine_(std::move(machine)) {}

  ProcId term(const State& state) const { return script_->term(*machine_, state); }
  std::optional<base::LimitReached> limit() const { return std::nullopt; }
  MachineStructure structure() const {
    return {.is_compiled = true,
            .is_generalised = !machine_->first_choice.empty(),
            .leaf_sizes = machine_->leaf_sizes,
            .leaf_kinds = machine_->leaf_kinds,
            .rules = machine_->rules.size(),
            .words = machine_->width()};
  }

  /// A run of the step rules that the machine takes for this one. States of compressed leaves stand
  /// for several terms, so their terms alone are not always a run. Where leaves lack τ that the
  /// step rules have, they are all there is to say. A stable state beyond the trace is one that the
  /// last one may be; the τ by which the step rules come to it are added to the trace.
  std::vector<ProcId> terms_of_run(std::span<const State> states,
                                   std::vector<lts::Label>& trace) const {
    if (machine_->is_weak) {
      std::vector<ProcId> terms;
      for (std::size_t i = 0; i <= trace.size(); ++i) terms.push_back(term(states[i]));
      return terms;
    }
    base::Diagnostics unheard;  // the machine has computed these steps before
    TermSystem terms = script_->terms(machine_->root, unheard);
    std::vector<ProcId> run{terms.initial()};
    std::vector<lts::Transition<ProcId>> steps;
    for (std::size_t i = 0; i < trace.size(); ++i) {
      steps.clear();
      terms.successors(run.back(), steps);
      const auto step = std::find_if(steps.begin(), steps.end(), [&](const auto& s) {
        return s.label == trace[i] && (s.label == lts::tick || is_state(s.target, states[i + 1]));
      });
      PERENTIE_CHECK(step != steps.end(), "a machine does what the step rules do not");
      run.push_back(step->target);
    }
    const bool chooses = states.size() > trace.size() + 1;
    while (chooses && !is_state(run.back(), states.back())) {
      steps.clear();
      terms.successors(run.back(), steps);
      const auto choice = std::find_if(steps.begin(), steps.end(), [&](const auto& s) {
        return s.label == lts::tau && is_choice(run.back(), s.target, states.back());
      });
      PERENTIE_CHECK(choice != steps.end(), "a machine refuses what the step rules do not");
      run.push_back(choice->target);
      trace.push_back(lts::tau);
    }
    return run;
  }

 private:
  bool is_state(ProcId term, const State& state) const {
    const auto words_of_term = script_->state(*machine_, term);
    return words_of_term && std::equal(words_of_term->begin(), words_of_term->end(), state.begin());
  }

  // Whether leaves that differ between two terms are those of a stable state in the second.
  bool is_choice(ProcId from, ProcId to, const State& stable) const {
    const auto before = script_->state(*machine_, from);
    const auto after = script_->state(*machine_, to);
    if (!before || !after || *before == *after) return false;
    return std::ranges::all_of(machine_->leaves, [&](const CompiledMachine::Leaf& leaf) {
      const std::size_t row = machine_row(leaf, *after);
      return row == machine_row(leaf, *before) || row == machine_row(leaf, stable);
    });
  }

  Script* script_;
  std::shared_ptr<const CompiledMachine> machine_;
};

/// Leaves of so many states are tried, then the lazy machine up to so many states of the whole.
struct ProcessTrial {
  std::uint64_t leaf_states;
  std::uint64_t states;
};
inline constexpr ProcessTrial process_trials[] = {
    {20'000, 50'000},
    {200'000, 1'000'000},
    {1'000'000, 50'000'000},
};

/// Calls `use(system, options)` and returns its result, which is of one type for all systems and
/// has a member `limit`, the budget that ran out. It may be called again with another system if
/// that is the number of states. `system` is a `LazyMachine` or a `MachineProcess`.
template <class Use>
auto with_process_system(Script& script, ProcId process, const lts::ExploreOptions& options,
                         base::Diagnostics& diagnostics, Use use,
                         std::span<const ProcessTrial> trials = process_trials) {
  constexpr std::uint64_t any = std::numeric_limits<std::uint64_t>::max();
  const base::Budget budget(options.limits);
  const auto rest = [&](std::uint64_t max_states) {
    lts::ExploreOptions left = options;
    left.limits = budget.rest();
    if (max_states != any) {
      left.limits.max_states = std::min(left.limits.max_states.value_or(max_states), max_states);
    }
    return left;
  };
  const auto use_lazy = [&](std::uint64_t max_states) {
    LazyMachine system = script.lazy_machine(process, diagnostics);
    return use(system, rest(max_states));
  };
  for (const ProcessTrial& trial : trials) {
    MachineCompilation compilation =
        script.machine(process, {.limits = rest(any).limits,
                                 .max_leaf_states = trial.leaf_states,
                                 .leaf_compression = script.leaf_compression(),
                                 .generalises = true});
    if (compilation.machine) {
      const auto machine = std::make_shared<const CompiledMachine>(std::move(*compilation.machine));
      return with_width(*machine, [&](auto width) {
        MachineProcess<width()> system(script, machine);
        return use(system, rest(any));
      });
    }
    if (!compilation.has_large_leaves) break;
    auto result = use_lazy(trial.states);
    const bool is_cut = result.limit && result.limit->kind == base::LimitKind::states &&
                        options.limits.max_states.value_or(any) > trial.states;
    if (!is_cut) return result;
  }
  return use_lazy(any);
}

/// Says which definition may be the reason that a process has no end; `limit` is the budget that
/// ran out, if one did.
void report_growth(const Script& script, const std::optional<base::LimitReached>& limit,
                   base::Diagnostics& diagnostics);

/// `lts::refine` on the fastest system, with terms in the place of its states.
template <class Specification>
lts::RefineResult<ProcId> refine_process(Script& script, ProcId process,
                                         const Specification& specification,
                                         lts::SemanticModel model,
                                         const lts::ExploreOptions& options,
                                         base::Diagnostics& diagnostics) {
  auto result = with_process_system(
      script, process, options, diagnostics, [&](auto& system, const lts::ExploreOptions& bounds) {
        auto found = lts::refine(specification, system, model, bounds);
        lts::RefineResult<ProcId> answer{.counts = found.counts,
                                         .counterexample = {},
                                         .limit = found.limit ? found.limit : system.limit(),
                                         .failed = found.failed};
        if (found.counterexample) {
          auto& from = *found.counterexample;
          auto& to = answer.counterexample.emplace(
              lts::Counterexample<ProcId>{static_cast<lts::Counterexample<ProcId>::Kind>(from.kind),
                                          std::move(from.trace),
                                          {},
                                          from.event,
                                          std::move(from.offered),
                                          from.node});
          if constexpr (requires { system.terms_of_run(from.states, to.trace); }) {
            to.states = system.terms_of_run(from.states, to.trace);
          } else {
            for (const auto& state : from.states) to.states.push_back(system.term(state));
          }
        }
        return answer;
      });
  report_growth(script, result.limit, diagnostics);
  return result;
}

}  // namespace perentie::semantics

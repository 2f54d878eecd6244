// The components of a process term, and what each of them does in a transition of the whole.
//
// An operator that has running operands is seen as a machine with components (FDR's debugger does
// the same, CSPM reference 8.7). The step rules say which transitions the whole and each component
// have; a transition is divided by finding component transitions that the operator makes it of.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "perentie/semantics/script.hpp"
#include "perentie/semantics/step.hpp"

namespace perentie::semantics {

class Components {
 public:
  Components(const EventTable& events, const ProcStore& processes, StepRules& rules)
      : events_(events), processes_(processes), rules_(rules) {}

  /// The running operands of a state, as states. Empty: it has none, or they cannot be computed.
  std::vector<ProcId> of(ProcId state);
  /// The component transitions that make up a transition of the whole, by component. Nothing: the
  /// operator does not stay in place.
  std::optional<std::vector<TransitionShare>> shares(ProcId from, lts::Label label, ProcId to);
  /// The components that must perform together an event that component `ready` offers. Without
  /// `ready`: the event is outside its alphabet, it can never perform it.
  std::vector<std::size_t> partners(ProcId state, std::size_t ready, lts::Label event) const;

 private:
  using Steps = StepRules::Steps;

  RunningOperands places(ProcId term) const;
  bool belongs_to_same_operator(ProcId from, ProcId to, const RunningOperands& place) const;
  bool becomes(ProcId term, lts::Label inner, lts::Label outer) const;
  std::optional<TransitionShare> share(ProcId from, std::size_t component, const Steps& steps,
                                       lts::Label label, std::optional<ProcId> target) const;
  std::optional<std::vector<TransitionShare>> linked(ProcId from, std::span<const Steps> steps,
                                                     std::span<const ProcId> targets) const;

  const EventTable& events_;
  const ProcStore& processes_;
  StepRules& rules_;
};

}  // namespace perentie::semantics

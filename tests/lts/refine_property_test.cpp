// Refinement on random graphs against the definition, for verdict, counterexample and counts.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "perentie/lts/lts_system.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/lts/refine.hpp"
#include "perentie/test/gen_lts.hpp"
#include "perentie/test/refinement_oracle.hpp"

namespace perentie::lts {
namespace {

using test::arbitrary_lts;
using test::NaiveRefutation;
using test::Semantics;

constexpr Semantics all_semantics[] = {Semantics::traces, Semantics::failures,
                                       Semantics::failures_divergences};

SemanticModel model_of(Semantics semantics) {
  switch (semantics) {
    case Semantics::traces:
      return SemanticModel::traces;
    case Semantics::failures:
      return SemanticModel::failures;
    case Semantics::failures_divergences:
      break;
  }
  return SemanticModel::failures_divergences;
}

using Result = RefineResult<State>;

Result refinement(const Lts& specification, const Lts& implementation, Semantics semantics) {
  const Normalisation normalised = normalise(specification, {.acceptances = true});
  LtsSystem system(implementation);
  return refine(NormalSpecification(normalised.normal), system, model_of(semantics));
}

/// A pair of graphs that often refine each other: the second may be the first without some edges.
std::pair<Lts, Lts> arbitrary_pair() {
  const Lts first = *arbitrary_lts({.max_states = 5});
  if (*rc::gen::arbitrary<bool>()) return {first, *arbitrary_lts({.max_states = 5})};
  LtsBuilder builder(first.shared_label_names());
  builder.add_states(static_cast<std::uint32_t>(first.state_count()));
  const auto dropped = *rc::gen::inRange<std::uint32_t>(0, 8);
  std::uint32_t number = 0;
  for (std::uint32_t s = 0; s < first.state_count(); ++s) {
    for (const Edge& edge : first.edges(State{s})) {
      if (number++ != dropped) builder.add_edge(State{s}, edge.label, edge.target);
    }
  }
  return {first, std::move(builder).finish(first.initial())};
}

/// What is wrong with a counterexample: it must be a path of the implementation to a state that the
/// specification does not allow there.
std::string wrong_with(const Counterexample<State>& found, const Lts& specification,
                       const Lts& implementation, Semantics semantics) {
  using Kind = Counterexample<State>::Kind;
  if (found.states.size() != found.trace.size() + 1) return "states do not fit the trace";
  if (found.states.front() != implementation.initial()) return "it does not begin at the beginning";
  test::Word visible;
  for (std::size_t i = 0; i < found.trace.size(); ++i) {
    const auto steps = implementation.edges(found.states[i], found.trace[i]);
    if (std::none_of(steps.begin(), steps.end(),
                     [&](const Edge& edge) { return edge.target == found.states[i + 1]; })) {
      return "the implementation cannot do it";
    }
    if (found.trace[i] != tau) visible.push_back(found.trace[i]);
  }
  const test::StateSet after = test::after(specification, visible);
  const std::uint32_t last = found.states.back().value;
  if (after == 0) return "the specification does not have the trace";
  const auto wrong = test::naive_violation(specification, after, implementation, last, semantics);
  if (!wrong) return "the specification allows it";
  switch (found.kind) {
    case Kind::event:
      if (implementation.edges(State{last}, found.event).empty()) return "the event is not offered";
      if (test::step(specification, after, found.event) != 0) return "the event is allowed";
      return *wrong == NaiveRefutation::Kind::event ? "" : "not an event";
    case Kind::acceptance: {
      const test::LabelSet initials = test::initials(implementation, last);
      if (!std::equal(initials.begin(), initials.end(), found.offered.begin(),
                      found.offered.end())) {
        return "it offers something else";
      }
      return *wrong == NaiveRefutation::Kind::acceptance ? "" : "not an acceptance";
    }
    case Kind::divergence:
      break;
  }
  return *wrong == NaiveRefutation::Kind::divergence ? "" : "not a divergence";
}

RC_GTEST_PROP(RefinePropertyTest, VerdictAndCountsAreThoseOfTheDefinition, ()) {
  const auto [specification, implementation] = arbitrary_pair();
  for (const Semantics semantics : all_semantics) {
    const Result result = refinement(specification, implementation, semantics);
    RC_ASSERT(result.complete());
    const bool holds = !result.counterexample;
    RC_CLASSIFY(holds);
    RC_ASSERT(holds == !test::naive_refutation(specification, implementation, semantics));
    const auto counts = test::naive_counts(specification, implementation, semantics);
    RC_ASSERT(holds == counts.holds);
    RC_ASSERT(result.counts.states == counts.states);
    RC_ASSERT(result.counts.transitions == counts.transitions);
    RC_ASSERT(result.counts.plys == counts.plys);
  }
}

RC_GTEST_PROP(RefinePropertyTest, ACounterexampleIsAShortestBehaviourThatTheSpecificationLacks,
              ()) {
  const auto [specification, implementation] = arbitrary_pair();
  for (const Semantics semantics : all_semantics) {
    const Result result = refinement(specification, implementation, semantics);
    if (!result.counterexample) continue;
    RC_ASSERT(wrong_with(*result.counterexample, specification, implementation, semantics) == "");
    // A pair that violates is found in the level whose number is the length of its trace.
    const auto counts = test::naive_counts(specification, implementation, semantics);
    RC_ASSERT(result.counterexample->trace.size() == counts.plys);
  }
}

RC_GTEST_PROP(RefinePropertyTest, EveryProcessRefinesItself, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 8});
  for (const Semantics semantics : all_semantics) {
    RC_ASSERT(!refinement(lts, lts, semantics).counterexample);
  }
}

RC_GTEST_PROP(RefinePropertyTest, FailuresRefinementIsTransitiveAndImpliesTraceRefinement, ()) {
  const auto [a, b] = arbitrary_pair();
  const Lts c = *arbitrary_lts({.max_states = 4});
  for (const Semantics semantics : all_semantics) {
    const bool ab = !refinement(a, b, semantics).counterexample;
    const bool bc = !refinement(b, c, semantics).counterexample;
    if (ab && bc) RC_ASSERT(!refinement(a, c, semantics).counterexample);
  }
  if (!refinement(a, b, Semantics::failures).counterexample) {
    RC_ASSERT(!refinement(a, b, Semantics::traces).counterexample);
  }
}

RC_GTEST_PROP(RefinePropertyTest, DeadlockAndDivergenceFreedomAreWhatTheySay, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 8});
  bool deadlocks = false;
  bool diverges = false;
  test::StateSet reached = 0;
  for (const auto& [trace, states] : test::traces_and_states(lts, 8)) reached |= states;
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (!test::contains(reached, s)) continue;
    deadlocks = deadlocks || lts.edges(State{s}).empty();
    diverges = diverges || test::diverges(lts, s);
  }
  LtsSystem system(lts);
  const auto fails = [&](const auto& specification, SemanticModel model) {
    return refine(specification, system, model).counterexample.has_value();
  };
  RC_ASSERT(fails(DeadlockFreedom{}, SemanticModel::failures) == deadlocks);
  RC_ASSERT(fails(DeadlockFreedom{}, SemanticModel::failures_divergences) ==
            (deadlocks || diverges));
  RC_ASSERT(fails(DivergenceFreedom{}, SemanticModel::failures_divergences) == diverges);
}

}  // namespace
}  // namespace perentie::lts

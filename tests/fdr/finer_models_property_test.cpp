// Revivals and refusal testing by definition, on the processes of random scripts; and that the
// finer model never holds where the coarser one fails.
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "gen_script.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/semantics/check.hpp"
#include "perentie/test/refinement_oracle.hpp"

namespace perentie::test {
namespace {

using lts::Lts;
using lts::State;

StateSet stable_within(const Lts& lts, StateSet states, const LabelSet& offer) {
  StateSet found = 0;
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (!contains(states, s) || !is_stable(lts, s)) continue;
    const LabelSet own = initials(lts, s);
    if (std::includes(offer.begin(), offer.end(), own.begin(), own.end())) {
      found |= StateSet{1} << s;
    }
  }
  return found;
}

bool has_revivals(const Lts& lts, StateSet within, const LabelSet& offer) {
  LabelSet revived;
  bool offers_nothing = false;
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (!contains(within, s)) continue;
    const LabelSet own = initials(lts, s);
    offers_nothing = offers_nothing || own.empty();
    revived.insert(own.begin(), own.end());
  }
  return offer.empty() ? offers_nothing : revived == offer;
}

enum class Finer { revivals, refusal_testing };

// Through pairs of what the specification may be and what the implementation is. In refusal testing
// the event of a stable state is taken by those states alone that refuse as much.
bool refines(const Lts& specification, const Lts& implementation, Finer model, bool strict) {
  std::set<std::pair<StateSet, std::uint32_t>> seen;
  std::vector<std::pair<StateSet, std::uint32_t>> stack;
  const auto add = [&](StateSet set, std::uint32_t state) {
    if (seen.emplace(set, state).second) stack.emplace_back(set, state);
  };
  add(tau_closure(specification, StateSet{1} << specification.initial().value),
      implementation.initial().value);
  while (!stack.empty()) {
    const auto [set, state] = stack.back();
    stack.pop_back();
    if (strict && any_diverges(specification, set)) continue;
    if (strict && diverges(implementation, state)) return false;
    StateSet takers = set;
    if (is_stable(implementation, state)) {
      const LabelSet offer = initials(implementation, state);
      const StateSet within = stable_within(specification, set, offer);
      if (model == Finer::revivals) {
        if (!has_revivals(specification, within, offer)) return false;
      } else {
        if (within == 0) return false;
        takers = within;
      }
    }
    for (const lts::Edge& edge : implementation.edges(State{state})) {
      if (edge.label == lts::tau) {
        add(set, edge.target.value);
        continue;
      }
      const StateSet next = tau_closure(specification, step(specification, takers, edge.label));
      if (next == 0) return false;
      add(next, edge.target.value);
    }
  }
  return true;
}

struct Pair {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  std::unique_ptr<semantics::Script> script;
  std::vector<semantics::ScriptAssertion> assertions;  // in T, F, V, R, FD, VD, RD

  explicit Pair(const GenTerm& specification, const GenTerm& implementation,
                std::vector<GenTerm> definitions) {
    GenScript made{std::move(definitions), {}};
    for (const char* model : {"T", "F", "V", "R", "FD", "VD", "RD"}) {
      made.assertions.push_back(
          {std::string("% [") + model + "= %", {specification, implementation}});
    }
    script = semantics::Script::load(*sources.add("pair.csp", to_text(made)), sources, diagnostics);
    if (script) assertions = semantics::assertions_of(script->tree());
  }

  bool holds(std::size_t i) {
    const auto result = semantics::check(*script, assertions[i], {}, diagnostics);
    RC_ASSERT(result.outcome == semantics::CheckResult::Outcome::holds ||
              result.outcome == semantics::CheckResult::Outcome::fails);
    RC_ASSERT(result.witness.has_value() ==
              (result.outcome == semantics::CheckResult::Outcome::fails));
    return result.outcome == semantics::CheckResult::Outcome::holds;
  }

  std::optional<Lts> graph(parser::ExprId process) {
    const auto term = script->process(process, {}, diagnostics);
    RC_ASSERT(term.has_value());
    semantics::TermSystem terms = script->terms(*term, diagnostics);
    auto found = lts::explore(terms, {.limits = {.max_states = 64}});
    return found.complete() ? std::optional(std::move(found.lts)) : std::nullopt;
  }
};

// Pairs that may refine each other in one model and not in the next.
std::vector<std::pair<GenTerm, GenTerm>> candidates(const GenTerm& p, const GenTerm& q) {
  const GenTerm both{"% [] %", {p, q}};
  const GenTerm either{"% |~| %", {p, q}};
  const auto or_stop = [](const GenTerm& term) { return GenTerm{"% |~| STOP", {term}}; };
  const auto hiding_choice = [](const GenTerm& first, const GenTerm& second) {
    return GenTerm{"(a -> %) |~| ((a -> %) [] b -> STOP)", {first, second}};
  };
  return {{q, p},
          {either, p},
          {or_stop(both), or_stop(either)},
          {or_stop(either), or_stop(both)},
          {or_stop(both), either},
          {hiding_choice(p, q), hiding_choice(q, p)}};
}

RC_GTEST_PROP(FinerModelsTest, AreAsDefinedAndFinerThanFailures, ()) {
  const GenScript script = *gen_script();
  const GenTerm& p = script.assertions.front().operands.back();
  const GenTerm& q = script.assertions.back().operands.front();
  const auto [specification, implementation] = *rc::gen::elementOf(candidates(p, q));
  Pair pair(specification, implementation, script.definitions);
  RC_ASSERT(pair.script != nullptr);
  const auto& claim = std::get<parser::RefinementAssertion>(pair.assertions[0].assertion.claim);
  std::optional<Lts> left;
  std::optional<Lts> right;
  for (int i = 0; i < 2; ++i) {  // the second time both have all labels
    left = pair.graph(claim.specification);
    right = pair.graph(claim.implementation);
    RC_PRE(left.has_value() && right.has_value());
  }
  std::vector<bool> holds;
  for (std::size_t i = 0; i < pair.assertions.size(); ++i) holds.push_back(pair.holds(i));
  RC_ASSERT(holds[2] == refines(*left, *right, Finer::revivals, false));
  RC_ASSERT(holds[3] == refines(*left, *right, Finer::refusal_testing, false));
  RC_ASSERT(holds[5] == refines(*left, *right, Finer::revivals, true));
  RC_ASSERT(holds[6] == refines(*left, *right, Finer::refusal_testing, true));
  RC_ASSERT(!holds[3] || holds[2]);
  RC_ASSERT(!holds[2] || holds[1]);
  RC_ASSERT(!holds[6] || holds[5]);
  RC_ASSERT(!holds[5] || holds[4]);
  RC_CLASSIFY(holds[1] && !holds[2], "F but not V");
  RC_CLASSIFY(holds[2] && !holds[3], "V but not R");
  RC_CLASSIFY(holds[6], "RD");
}

}  // namespace
}  // namespace perentie::test

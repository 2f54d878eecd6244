// Watchdogs beside random implementations, in parallel as the reference defines it, against the
// definition of refinement: what the watchdogs are for (CSPM reference 4.6.2, 4.6.3).
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <variant>
#include <vector>

#include "perentie/lts/watchdogs.hpp"
#include "perentie/test/gen_lts.hpp"
#include "perentie/test/lts_oracles.hpp"
#include "perentie/test/refinement_oracle.hpp"

namespace perentie::lts {
namespace {

using test::arbitrary_lts;
using test::Semantics;

const test::LtsShape endless{.max_states = 5, .events = {"a", "b", "bark"}, .tick_weight = 0};
const Label bark{4};
const std::vector<Label> events{Label{2}, Label{3}};

/// Without the edges of `bark`.
Lts some_process() {
  const Lts lts = *arbitrary_lts(endless);
  LtsBuilder builder(lts.shared_label_names());
  builder.add_states(static_cast<std::uint32_t>(lts.state_count()));
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const Edge& edge : lts.edges(State{s})) {
      if (edge.label != bark) builder.add_edge(State{s}, edge.label, edge.target);
    }
  }
  return std::move(builder).finish(lts.initial());
}

/// What the two do together, synchronised on `events`: by pair, whether it is reached, deadlocks,
/// or barks.
struct Together {
  bool deadlocks = false;
  bool barks = false;
};

Together together(const Lts& watchdog, const Lts& implementation) {
  Together result;
  const auto count = static_cast<std::uint32_t>(implementation.state_count());
  std::vector<bool> seen(watchdog.state_count() * count, false);
  std::vector<std::uint32_t> stack;
  const auto visit = [&](State w, State i) {
    const std::uint32_t pair = w.value * count + i.value;
    if (!seen[pair]) stack.push_back(pair);
    seen[pair] = true;
  };
  visit(watchdog.initial(), implementation.initial());
  while (!stack.empty()) {
    const State w{stack.back() / count};
    const State i{stack.back() % count};
    stack.pop_back();
    bool moves = false;
    for (const Edge& edge : implementation.edges(i, tau)) {
      visit(w, edge.target);
      moves = true;
    }
    for (const Edge& step : watchdog.edges(w)) {
      if (step.label == tau || step.label == bark) {
        result.barks = result.barks || step.label == bark;
        visit(step.target, i);
        moves = true;
        continue;
      }
      for (const Edge& edge : implementation.edges(i, step.label)) {
        visit(step.target, edge.target);
        moves = true;
      }
    }
    result.deadlocks = result.deadlocks || !moves;
  }
  return result;
}

bool has_divergence(const Lts& lts) {
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (test::diverges(lts, s)) return true;
  }
  return false;
}

RC_GTEST_PROP(WatchdogPropertyTest, TheTraceWatchdogBarksAtWhatIsNoTrace, ()) {
  const Lts specification = some_process();
  const Lts implementation = some_process();
  const auto watchdog = std::get<Lts>(trace_watchdog(specification, events, bark));
  const bool holds = !test::naive_refutation(specification, implementation, Semantics::traces);
  RC_CLASSIFY(holds, "refines");
  RC_ASSERT(together(watchdog, implementation).barks == !holds);
}

RC_GTEST_PROP(WatchdogPropertyTest, TheFailureWatchdogDeadlocksAtWhatIsNoFailure, ()) {
  const Lts specification = some_process();
  const bool is_itself = *rc::gen::inRange(0, 3) == 0;
  const Lts implementation = is_itself ? specification : some_process();
  RC_PRE(!has_divergence(implementation));
  const auto watchdog = std::get<Lts>(failure_watchdog(specification, events, bark));
  const bool holds = !test::naive_refutation(specification, implementation, Semantics::failures);
  RC_CLASSIFY(holds, "refines");
  RC_ASSERT(together(watchdog, implementation).deadlocks == !holds);
}

}  // namespace
}  // namespace perentie::lts

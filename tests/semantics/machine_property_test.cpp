// Random processes as machines and by the step rules: the same states, edges and behaviour.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "gen_process.hpp"
#include "machine_support.hpp"
#include "perentie/lts/bisimulation.hpp"
#include "perentie/lts/divergence.hpp"
#include "perentie/semantics/compression.hpp"
#include "perentie/semantics/process_graph.hpp"

namespace perentie::semantics {
namespace {

RC_GTEST_PROP(MachinePropertyTest, MachinesHaveTheLtsOfTheStepRules, ()) {
  const std::string definitions = test::some_definitions();
  const std::string process = test::some_process(3);
  RC_LOG() << definitions << process;
  TestScript script(definitions);
  RC_ASSERT(script.loaded());
  const BothWays found = explore_both_ways(script, process, 1, 1'000);
  RC_ASSERT(script.messages() == "");
  if (!found.steps) RC_DISCARD("too large");
  RC_CLASSIFY(found.machine.has_value(), "machine");
  if (!found.machine) return;
  RC_ASSERT(same_reached(*found.steps, *found.machine));
}

RC_GTEST_PROP(MachinePropertyTest, CompressedLeavesKeepBehaviour, ()) {
  const std::string definitions = test::some_definitions();
  const std::string process = test::some_process(2);
  RC_LOG() << definitions << process;
  TestScript script(definitions);
  RC_ASSERT(script.loaded());
  // Otherwise there may be generalised leaves, which keep no more than failures and divergences.
  script.script().set_preserved(Preserved::bisimilarity);
  base::Diagnostics diagnostics;
  const auto term = script.script().process(process, diagnostics);
  RC_ASSERT(term);
  const lts::ExploreOptions options{.limits = {.max_states = 1'000}};
  const auto small = explore_process(script.script(), *term, options, diagnostics);
  const auto exact = script.explore(process, options.limits);
  if (!exact || !small.complete) RC_DISCARD("too large");
  RC_CLASSIFY(small.structure.is_compiled, "machine");
  RC_ASSERT(small.lts.state_count() <= exact->state_count());
  RC_ASSERT(
      isomorphic(lts::strong_bisimulation(small.lts).lts, lts::strong_bisimulation(*exact).lts));
}

RC_GTEST_PROP(MachinePropertyTest, WhatMayNotDivergeDoesNot, ()) {
  const std::string definitions = test::some_definitions();
  std::string process = test::some_process(2);
  if (test::pick(2) == 0) process += " \\ {" + test::some_event() + ", " + test::some_event() + "}";
  RC_LOG() << definitions << process;
  TestScript script(definitions);
  RC_ASSERT(script.loaded());
  const base::Limits limits{.max_states = 1'000};
  const auto exact = script.explore(process, limits);
  if (!exact) RC_DISCARD("too large");
  base::Diagnostics diagnostics;
  const auto term = script.script().process(process, diagnostics);
  RC_ASSERT(term);
  const bool generalises = test::pick(2) == 0;
  const auto compilation = script.script().machine(
      *term,
      {.max_leaf_states = 1'000,
       .min_leaves = 1,
       .leaf_compression = test::pick(2) == 0 ? LeafCompression::none : LeafCompression::wbisim,
       .generalises = generalises});
  if (!compilation.machine) return;
  const bool diverges = std::ranges::any_of(lts::divergent_states(*exact), std::identity());
  RC_CLASSIFY(diverges, "diverges");
  RC_CLASSIFY(!compilation.machine->may_diverge, "cannot diverge");
  RC_CLASSIFY(!compilation.machine->may_diverge && lts::has_tau(*exact), "cannot diverge, has tau");
  RC_ASSERT(compilation.machine->may_diverge || !diverges);
}

// Parallels anywhere: under operators that switch, after prefixes, under names.
RC_GTEST_PROP(MachinePropertyTest, LazyMachinesAreExact, ()) {
  std::string definitions = test::header;
  for (int i = 0; i < 3; ++i) {
    const std::string parallel =
        test::some_sequential(1, false) + " ||| " + test::some_sequential(1, false);
    definitions += "P" + std::to_string(i) + " = ";
    definitions += test::pick(3) == 0 ? "(" + parallel + ") ; " + test::some_event() + " -> P" +
                                            std::to_string(test::pick(3))
                                      : test::some_sequential(2, true);
    definitions += "\n";
  }
  const std::string process = test::some_process(3);
  RC_LOG() << definitions << process;
  TestScript script(definitions);
  RC_ASSERT(script.loaded());
  RC_ASSERT(lazy_machine_is_exact(script, process, 1'000));
}

}  // namespace
}  // namespace perentie::semantics

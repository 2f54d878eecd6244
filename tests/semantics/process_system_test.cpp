// Which system computes a process, and that its answers do not depend on it.
#include "perentie/semantics/process_graph.hpp"
#include "perentie/semantics/process_system.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "perentie/lts/count.hpp"
#include "perentie/lts/specifications.hpp"
#include "perentie/test/paths.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

const char* const definitions = R"(
channel a, b
channel n : {0..99}
COUNT(x) = x < 100 & a -> COUNT(x + 1)
LONG(x) = x < 100 & n.x -> LONG(x + 1)
TWICE = a -> a -> STOP
LOOP = a -> b -> LOOP
BAD = a -> (if head(<>) then LOOP else STOP)
)";

struct Used {
  std::vector<std::string> systems;  // in the order in which they were tried
  lts::Count count;
};

Used use(const std::string& process, const base::Limits& limits, std::vector<ProcessTrial> trials,
         std::string* messages = nullptr) {
  TestScript script(definitions);
  base::Diagnostics diagnostics;
  const auto term = script.script().process(process, diagnostics);
  Used used;
  used.count = with_process_system(
      script.script(), *term, {.limits = limits}, diagnostics,
      [&](auto& system, const lts::ExploreOptions& options) {
        const bool is_lazy = std::is_same_v<std::decay_t<decltype(system)>, LazyMachine>;
        used.systems.emplace_back(is_lazy ? "lazy" : "machine");
        return lts::count(system, options);
      },
      trials);
  if (messages != nullptr) *messages = base::render_all(diagnostics, script.sources());
  return used;
}

using Systems = std::vector<std::string>;

TEST(ProcessSystemTest, SmallLeavesMakeAMachine) {
  const Used used = use("COUNT(0) ||| LONG(0)", {}, {{1'000, 10}});
  EXPECT_EQ(used.systems, Systems({"machine"}));
  EXPECT_EQ(used.count.states, 101U * 101U);
}

TEST(ProcessSystemTest, WhatIsNoParallelIsLazy) {
  EXPECT_EQ(use("COUNT(0)", {}, {{1'000, 10}}).systems, Systems({"lazy"}));
}

// The leaves have 101 and 3 states, the whole has 3.
TEST(ProcessSystemTest, LeavesThatAreLargerThanTheWholeAreNotExplored) {
  const Used used = use("COUNT(0) [|{a}|] TWICE", {}, {{20, 10}, {1'000, 1'000}});
  EXPECT_EQ(used.systems, Systems({"lazy"}));
  EXPECT_EQ(used.count.states, 3U);
}

TEST(ProcessSystemTest, LargerLeavesAreTriedWhenTheWholeIsLargeToo) {
  const Used used = use("COUNT(0) ||| LONG(0)", {}, {{20, 50}, {100, 500}, {1'000, 5'000}});
  EXPECT_EQ(used.systems, Systems({"lazy", "lazy", "machine"}));
  EXPECT_EQ(used.count.states, 101U * 101U);
  EXPECT_FALSE(used.count.limit);
}

TEST(ProcessSystemTest, AfterTheLastTrialTheLazyMachineHasNoBound) {
  const Used used = use("COUNT(0) ||| LONG(0)", {}, {{20, 50}});
  EXPECT_EQ(used.systems, Systems({"lazy", "lazy"}));
  EXPECT_EQ(used.count.states, 101U * 101U);
}

TEST(ProcessSystemTest, TheBoundOnStatesIsTheCallersOwnInEverySystem) {
  for (const std::vector<ProcessTrial>& trials :
       {std::vector<ProcessTrial>{{1'000, 10}}, {{20, 50}}, {{20, 500}}}) {
    const Used used = use("COUNT(0) ||| LONG(0)", {.max_states = 200}, trials);
    EXPECT_EQ(used.count.states, 200U);
    ASSERT_TRUE(used.count.limit);
    EXPECT_EQ(used.count.limit->limit, 200U);
  }
}

TEST(ProcessSystemTest, AFailingProcessIsReportedOnce) {
  std::string messages;
  const Used used = use("BAD ||| LONG(0)", {}, {{20, 5'000}, {1'000, 5'000}}, &messages);
  EXPECT_TRUE(used.count.failed);
  EXPECT_EQ(used.systems, Systems({"lazy"}));
  EXPECT_EQ(messages.find("error"), messages.rfind("error")) << messages;
}

TEST(ProcessSystemTest, TermsAreThoseOfTheStepRules) {
  const auto script = TestScript::of_file(test::corpus() / "philosophers/philosophers.csp");
  base::Diagnostics diagnostics;
  script->script().set_leaf_compression(LeafCompression::none);
  const auto term = script->script().process("WITH_BUTLER(3) \\ {|sits|}", diagnostics);
  const auto found = explore_process(script->script(), *term, {}, diagnostics);
  ASSERT_TRUE(found.complete);
  TermSystem terms = script->script().terms(*term, diagnostics);
  const auto expected = lts::explore(terms);
  ASSERT_EQ(found.lts.state_count(), expected.states.size());
  std::set<ProcId> from_machine;
  for (std::uint32_t s = 0; s < found.lts.state_count(); ++s) {
    from_machine.insert(found.term(lts::State{s}));
  }
  EXPECT_EQ(from_machine, std::set<ProcId>(expected.states.begin(), expected.states.end()));
}

// FDR's counts, and the length of a shortest counterexample.
TEST(ProcessSystemTest, RefinementCountsWhatTheStepRulesCount) {
  const auto script = TestScript::of_file(test::corpus() / "philosophers/philosophers.csp");
  base::Diagnostics diagnostics;
  script->script().set_leaf_compression(LeafCompression::none);
  for (const char* name : {"SYSTEM(3)", "SYSTEM(4)", "WITH_BUTLER(4)", "MEALS(3)"}) {
    SCOPED_TRACE(name);
    const auto term = script->script().process(name, diagnostics);
    const lts::SemanticModel model = lts::SemanticModel::failures_divergences;
    const auto found =
        refine_process(script->script(), *term, lts::DeadlockFreedom{}, model, {}, diagnostics);
    TermSystem terms = script->script().terms(*term, diagnostics);
    const auto expected = lts::refine(lts::DeadlockFreedom{}, terms, model);
    EXPECT_EQ(found.counts.states, expected.counts.states);
    EXPECT_EQ(found.counts.transitions, expected.counts.transitions);
    EXPECT_EQ(found.counts.plys, expected.counts.plys);
    ASSERT_EQ(found.counterexample.has_value(), expected.counterexample.has_value());
    if (!found.counterexample) continue;
    EXPECT_EQ(found.counterexample->trace.size(), expected.counterexample->trace.size());
    // The states are terms that lead one to the next.
    std::vector<lts::Transition<ProcId>> steps;
    const auto& states = found.counterexample->states;
    for (std::size_t i = 0; i + 1 < states.size(); ++i) {
      steps.clear();
      terms.successors(states[i], steps);
      EXPECT_TRUE(std::any_of(steps.begin(), steps.end(), [&](const auto& step) {
        return step.label == found.counterexample->trace[i] && step.target == states[i + 1];
      }));
    }
  }
}

}  // namespace
}  // namespace perentie::semantics

// Leaves compressed by strong bisimulation: figures that FDR was seen to give, behaviour, and runs.
#include <gtest/gtest.h>

#include <string>

#include "machine_support.hpp"
#include "perentie/lts/bisimulation.hpp"
#include "perentie/lts/specifications.hpp"
#include "perentie/semantics/process_graph.hpp"
#include "perentie/semantics/process_system.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

MachineStructure structure_of(TestScript& script, const std::string& process,
                              std::uint64_t max_leaf_states) {
  base::Diagnostics diagnostics;
  const auto term = script.script().process(process, diagnostics);
  const auto compilation = script.script().machine(
      *term, {.max_leaf_states = max_leaf_states, .leaf_compression = LeafCompression::sbisim});
  EXPECT_TRUE(compilation.machine);
  MachineStructure structure;
  if (compilation.machine) structure.leaf_sizes = compilation.machine->leaf_sizes;
  return structure;
}

// CSPM reference 10.1 V2, of a model with the same shape: n variables of three values, whose values
// cannot be seen, beside a process that uses one of them.
TEST(LeafCompressionTest, MemoryHasTheFiguresOfFdr) {
  TestScript script(R"(
channel get, set : {1..6}.{0..2}
channel terminate
update(<x>^s, i, v) = if i == 1 then <v>^s else <x>^update(s, i - 1, v)
MEMORY(n, vs) = ([] i : {1..n} @ get.i.0 -> MEMORY(n, vs))
             [] ([] i : {1..n} @ set.i?v -> MEMORY(n, update(vs, i, v)))
             [] terminate -> SKIP
USER(n) = (([] i : {1..n} @ get.i?v -> SKIP) [] ([] i : {1..n} @ set.i.1 -> SKIP)) ; terminate -> SKIP
zeros(n) = <0 | _ <- <1..n>>
SYSTEM(n) = (USER(n) [|{|get, set, terminate|}|] MEMORY(n, zeros(n))) \ {|get, set, terminate|}
)");
  ASSERT_TRUE(script.loaded()) << script.messages();
  std::uint64_t power = 1;
  for (std::uint64_t n = 1; n <= 6; ++n) {
    SCOPED_TRACE(n);
    power *= 3;
    const std::string process = "SYSTEM(" + std::to_string(n) + ")";
    const auto leaves = structure_of(script, process, 1'000).leaf_sizes;
    ASSERT_EQ(leaves.size(), 2U);
    EXPECT_EQ(leaves[0].explored_states, 4U);
    EXPECT_EQ(leaves[0].explored_edges, 4 * n + 2);
    EXPECT_EQ(leaves[1].explored_states, power + 2);
    EXPECT_EQ(leaves[1].explored_edges, power * (4 * n + 1) + 1);
    EXPECT_EQ(leaves[1].states, 3U);
    base::Diagnostics diagnostics;
    const auto term = script.script().process(process, diagnostics);
    const auto whole = explore_process(script.script(), *term, {}, diagnostics);
    EXPECT_TRUE(whole.structure.is_compiled);
    EXPECT_EQ(whole.lts.state_count(), 4U);
    EXPECT_EQ(whole.lts.edge_count(), 3U);
  }
}

const char* const definitions = R"(
channel a, b, c
P = a -> a -> P
Q = a -> Q [] b -> (a -> Q [] b -> SKIP) [] c -> (a -> a -> Q [] a -> Q)
R = a -> b -> STOP |~| a -> b -> (STOP [] STOP)
COUNT(n) = if n == 0 then STOP else (a -> COUNT(n - 1) [] b -> COUNT(n - 1))
)";

// The graphs of a process with compressed leaves and without are bisimilar.
TEST(LeafCompressionTest, BehaviourIsThatOfTheStepRules) {
  for (const char* process :
       {"P ||| Q", "P [|{a}|] Q", "(P ||| Q) \\ {a}", "(R ||| R)[[a <- c]]", "R [|{a, b}|] R",
        "COUNT(6) ||| P", "COUNT(4) [|{b}|] COUNT(5)", "Q [{a, b} || {a, c}] P", "P [a <-> b] Q"}) {
    SCOPED_TRACE(process);
    TestScript script(definitions);
    ASSERT_TRUE(script.loaded()) << script.messages();
    base::Diagnostics diagnostics;
    const auto term = script.script().process(process, diagnostics);
    const auto small = explore_process(script.script(), *term, {}, diagnostics);
    EXPECT_TRUE(small.structure.is_compiled);
    const auto exact = script.explore(process);
    ASSERT_TRUE(exact);
    EXPECT_LE(small.lts.state_count(), exact->state_count());
    EXPECT_TRUE(
        isomorphic(lts::strong_bisimulation(small.lts).lts, lts::strong_bisimulation(*exact).lts));
  }
}

TEST(LeafCompressionTest, NoneLeavesTheStatesOfTheStepRules) {
  TestScript script(definitions);
  script.script().set_leaf_compression(LeafCompression::none);
  base::Diagnostics diagnostics;
  const auto term = script.script().process("P ||| Q", diagnostics);
  const auto found = explore_process(script.script(), *term, {}, diagnostics);
  EXPECT_EQ(found.lts.state_count(), script.explore("P ||| Q")->state_count());
}

// The terms of compressed states are no run by themselves: after three a, P is to be `a -> P`.
TEST(LeafCompressionTest, CounterexamplesAreRunsOfTheStepRules) {
  for (const char* process : {"P [|{a}|] COUNT(7)", "COUNT(5) ||| COUNT(2)",
                              "(Q [|{a}|] (a -> a -> a -> STOP)) \\ {b}", "(a -> SKIP) ||| SKIP"}) {
    SCOPED_TRACE(process);
    TestScript script(definitions);
    base::Diagnostics diagnostics;
    const auto term = script.script().process(process, diagnostics);
    const auto found = refine_process(script.script(), *term, lts::DeadlockFreedom{},
                                      lts::SemanticModel::failures, {}, diagnostics);
    ASSERT_TRUE(found.counterexample);
    EXPECT_TRUE(is_run(script.script(), *term, *found.counterexample));
    EXPECT_EQ(found.counterexample->kind, lts::Counterexample<ProcId>::Kind::acceptance);
    EXPECT_TRUE(found.counterexample->offered.empty());
  }
}

}  // namespace
}  // namespace perentie::semantics

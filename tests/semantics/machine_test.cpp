// Compiled machines: each operator that is compiled, what is left to the step rules, limits, and
// the processes of the corpus and of ../shared.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>

#include "machine_support.hpp"
#include "peer_rows.hpp"
#include "perentie/lts/count.hpp"
#include "perentie/test/paths.hpp"

namespace perentie::semantics {
namespace {

const char* const definitions = R"(
channel a, b, c, e
channel n, m : {0..2}
P = a -> b -> P
Q = a -> Q [] c -> SKIP
R = b -> R |~| a -> SKIP
N(x) = n.x -> m?y -> N(y) [] a -> SKIP
UNDONE(x) = a -> UNDONE(x + 1)
BROKEN = a -> P [] b -> (if head(<>) then P else Q)
ALPHABET(0) = {a, b}
ALPHABET(_) = {a, c}
)";

// A machine, of the given number of leaves, with the LTS of the step rules.
void expect_same(const std::string& process, std::size_t leaves) {
  SCOPED_TRACE(process);
  TestScript script(definitions);
  ASSERT_TRUE(script.loaded()) << script.messages();
  const auto found = explore_both_ways(script, process);
  ASSERT_TRUE(found.steps && found.machine) << script.messages();
  EXPECT_TRUE(same_reached(*found.steps, *found.machine));
  const auto term =
      script.script().process(process, const_cast<base::Diagnostics&>(script.diagnostics()));
  const auto compilation = script.script().machine(*term, {.min_leaves = 1});
  EXPECT_EQ(compilation.machine->leaves.size(), leaves);
}

TEST(MachineTest, OperatorsThatStayInPlaceBecomeRules) {
  expect_same("P ||| Q ||| R", 3);
  expect_same("(P [|{a}|] Q) [|{a, c}|] R", 3);
  expect_same("[|{a}|] i : {0..2} @ if i == 0 then P else Q", 3);
  expect_same("P [{a, b} || {a, c}] Q", 2);
  expect_same("|| i : {0..2} @ [ALPHABET(i)] Q", 3);
  expect_same("P [b <-> a] Q", 2);
  expect_same("N(0) [m <-> n] N(1)", 2);
  expect_same("(P ||| Q) \\ {a}", 2);
  expect_same("(P ||| Q) |\\ {a}", 2);
  expect_same("(P ||| Q)[[a <- b, a <- c]]", 2);
  expect_same("(P[[a <- c]] [|{c}|] Q) \\ {c}", 2);
  expect_same("N(0)[[n <- m, m <- n]] [|{|m|}|] N(1)", 2);
  expect_same("P \\ {a}", 1);
}

TEST(MachineTest, EverythingElseIsALeaf) {
  expect_same("(P ; Q) ||| R", 2);
  expect_same("(P [] Q) ||| (P /\\ R)", 2);
  expect_same("((P ||| Q) ; R) [|{a}|] P", 2);
  expect_same("((P ||| Q) [|{a}|> R) [|{a}|] P", 2);
  expect_same("(P |~| Q) ||| CHAOS({a}) ||| RUN({c})", 3);
}

TEST(MachineTest, HiddenAndRenamedEventsSynchroniseByWhatTheyBecame) {
  expect_same("(P \\ {a}) [|{a, b}|] Q", 2);
  expect_same("(P[[a <- c]]) [|{a, c}|] Q", 2);
  expect_same("((P [|{a}|] Q) \\ {a}) [|{b}|] (R[[a <- b]])", 3);
}

// SKIP ||| SKIP has two states: nothing terminates alone, and the whole stops as one state.
TEST(MachineTest, TerminationIsJoint) {
  expect_same("SKIP ||| SKIP", 2);
  expect_same("SKIP ||| STOP", 2);
  expect_same("(a -> SKIP) ||| SKIP", 2);
  expect_same("(a -> STOP [] SKIP) \\ {b}", 1);
  expect_same("(a -> STOP [] SKIP) ||| (b -> STOP [] SKIP)", 2);
  expect_same("SKIP [{a} || {b}] (b -> SKIP)", 2);
  expect_same("SKIP [a <-> b] SKIP", 2);
  expect_same("(Q ||| R) \\ {a, b, c}", 2);
}

// FDR counts what fires, so repetitions matter.
TEST(MachineTest, RepeatedTransitionsFireAsOften) {
  expect_same("(a -> P [] a -> P) ||| Q", 2);
  expect_same("(a -> P [] a -> P) [|{a}|] (a -> Q [] a -> Q)", 2);
  expect_same("(P ||| Q)[[a <- c, b <- c]]", 2);
  expect_same("(SKIP [] SKIP) ||| SKIP", 2);
  expect_same("(SKIP [] SKIP) \\ {a}", 1);
  expect_same("|| i : {0} @ [{a}] (SKIP [] SKIP)", 1);
}

TEST(MachineTest, ManyLeavesFillManyWords) {
  expect_same("[|{a}|] i : {1..70} @ (a -> STOP)", 70);
  expect_same("|| i : {1..100} @ [{a, b, c}] (a -> b -> c -> SKIP)", 100);
  TestScript script(definitions);
  base::Diagnostics unheard;
  const auto term = script.script().process("||| i : {1..100} @ (a -> b -> STOP)", unheard);
  const auto compilation = script.script().machine(*term, {});
  ASSERT_TRUE(compilation.machine);
  EXPECT_EQ(compilation.machine->width(), 4U);
}

std::optional<CompiledMachine> machine_of(const std::string& process, const MachineOptions& options,
                                          std::string* messages = nullptr) {
  TestScript script(definitions);
  base::Diagnostics diagnostics;
  const auto term = script.script().process(process, diagnostics);
  auto compilation = script.script().machine(*term, options);
  EXPECT_FALSE(compilation.limit);
  if (messages != nullptr) *messages = base::render_all(diagnostics, script.sources());
  return std::move(compilation.machine);
}

TEST(MachineTest, WhatIsNotWorthAMachineHasNone) {
  EXPECT_FALSE(machine_of("P", {.min_leaves = 1}));
  EXPECT_FALSE(machine_of("P \\ {a}", {}));
  EXPECT_TRUE(machine_of("P ||| P", {}));
}

// The whole may be finite, or free of the error, though a leaf is not.
TEST(MachineTest, ALeafThatDoesNotEndIsLeftToTheStepRulesWithTheWhole) {
  std::string messages;
  EXPECT_FALSE(machine_of("UNDONE(0) [|{a}|] (a -> a -> STOP)", {.max_leaf_states = 100}));
  EXPECT_FALSE(machine_of("BROKEN [|{b}|] P", {}, &messages));
  EXPECT_EQ(messages, "");
}

TEST(MachineTest, TooManyRulesAreNone) {
  const std::string all_to_one = "N(0)[[n.1 <- n.0, n.2 <- n.0, m.0 <- n.0, m.1 <- n.0]]";
  const std::string process = "[|{n.0}|] i : {1..12} @ " + all_to_one;
  EXPECT_FALSE(machine_of(process, {.max_rules = 10'000}));
}

TEST(MachineTest, TimeAndCancellationEndCompilation) {
  TestScript script(definitions);
  base::Diagnostics unheard;
  const auto term = script.script().process("UNDONE(0) ||| P", unheard);
  const std::atomic<bool> cancelled = true;
  const auto compilation = script.script().machine(*term, {.limits = {.cancelled = &cancelled}});
  EXPECT_FALSE(compilation.machine);
  ASSERT_TRUE(compilation.limit);
  EXPECT_EQ(compilation.limit->kind, base::LimitKind::cancelled);
}

// P without b comes to an end of a; the other P goes round with both hidden.
TEST(MachineTest, LeavesTellThatTheWholeDoesNotDiverge) {
  const auto may_diverge = [](const std::string& process) {
    TestScript script(definitions);
    base::Diagnostics unheard;
    const auto term = script.script().process(process, unheard);
    const auto compilation = script.script().machine(*term, {.min_leaves = 1});
    EXPECT_TRUE(compilation.machine) << process;
    return !compilation.machine || compilation.machine->may_diverge;
  };
  EXPECT_FALSE(may_diverge("P ||| Q"));
  EXPECT_FALSE(may_diverge("(P ||| P) \\ {a}"));
  EXPECT_TRUE(may_diverge("(P ||| P) \\ {a, b}"));
  EXPECT_TRUE(may_diverge("(P ||| DIV) \\ {a}"));
  EXPECT_TRUE(may_diverge("(R ||| P) \\ {b}")) << "R repeats τ and b";
  // Each side alone has a cycle of a and c, but together one of a only that the second ends.
  EXPECT_FALSE(may_diverge("(Q [|{a, c}|] (a -> a -> Q)) \\ {c}"));
  EXPECT_FALSE(may_diverge("((P [|{a, b}|] P) [|{a}|] a -> a -> STOP) \\ {a, b}"));
}

lts::Count count_of(TestScript& script, const std::string& process) {
  base::Diagnostics unheard;
  const auto term = script.script().process(process, unheard);
  const auto compilation = script.script().machine(*term, {});
  EXPECT_TRUE(compilation.machine) << process;
  if (!compilation.machine) return {};
  return with_system(*compilation.machine, [](auto system) { return lts::count(system); });
}

// Counted independently: the numbers of the transfer matrix of the ring, less the one state that
// cannot be reached (all hold the left fork after the meal).
TEST(MachineTest, PhilosophersHaveTheStatesOfTheTransferMatrix) {
  const auto script = TestScript::of_file(test::corpus() / "philosophers/philosophers.csp");
  ASSERT_TRUE(script->loaded()) << script->messages();
  std::uint64_t power = 36;
  for (int n = 3; n <= 7; ++n) {
    power *= 6;
    const std::uint64_t states = n % 2 == 0 ? power : power - 2;
    const std::string size = "(" + std::to_string(n) + ")";
    EXPECT_EQ(count_of(*script, "SYSTEM" + size).states, states) << n;
    EXPECT_EQ(count_of(*script, "MEALS" + size).states, states) << n;
    EXPECT_EQ(count_of(*script, "ALPHABETISED" + size).states, states) << n;
  }
  EXPECT_EQ(count_of(*script, "SYSTEM(7)").transitions, 1'726'256U);
}

TEST(MachineTest, PhilosophersAreThoseOfTheStepRules) {
  const auto script = TestScript::of_file(test::corpus() / "philosophers/philosophers.csp");
  for (const char* name : {"SYSTEM", "ALPHABETISED", "MEALS", "WITH_BUTLER", "ASYMMETRIC"}) {
    SCOPED_TRACE(name);
    const auto found = explore_both_ways(*script, std::string(name) + "(4)", 2);
    ASSERT_TRUE(found.steps && found.machine);
    EXPECT_TRUE(same_reached(*found.steps, *found.machine));
  }
}

// Every process without parameters of every script of the corpus.
TEST(MachineTest, ProcessesOfTheCorpusAreThoseOfTheStepRules) {
  std::size_t machines = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::corpus())) {
    if (entry.path().extension() != ".csp") continue;
    const auto script = TestScript::of_file(entry.path());
    if (!script->loaded()) continue;
    for (const std::string& name : script->script().process_names()) {
      const auto found = explore_both_ways(*script, name, 1);
      if (!found.machine || !found.steps) continue;
      SCOPED_TRACE(entry.path().string() + " " + name);
      EXPECT_TRUE(same_reached(*found.steps, *found.machine));
      ++machines;
    }
  }
  EXPECT_GE(machines, 1U);
}

TEST(MachineTest, ProcessesOfOthersAreThoseOfTheStepRules) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  std::size_t machines = 0;
  for_each_peer(data, [&](const PeerRow& row, TestScript& script) {
    const auto found = explore_both_ways(script, row.process, 1, 3'000);
    if (!found.machine || !found.steps) return;
    EXPECT_TRUE(same_reached(*found.steps, *found.machine));
    ++machines;
  });
  EXPECT_GE(machines, 20U);
}

}  // namespace
}  // namespace perentie::semantics

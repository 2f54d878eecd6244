// Lazy machines: each operator that switches formats, and the processes of the corpus and of
// ../shared, held to the step rules: the same states, transitions, order and repetitions.
#include "perentie/semantics/lazy_machine.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "machine_support.hpp"
#include "peer_rows.hpp"
#include "perentie/lts/count.hpp"
#include "perentie/test/paths.hpp"

namespace perentie::semantics {
namespace {

const char* const definitions = R"(
external prioritise, prioritisepo
transparent normal, chase, explicate
channel a, b, c, d, e
P = a -> b -> P
Q = a -> Q [] c -> SKIP
R = b -> SKIP |~| c -> SKIP
BOTH = P [|{a}|] Q
ENDS = (a -> SKIP) ||| (b -> SKIP)
NAME = ENDS
AGAIN = ENDS ; AGAIN
LATER = c -> ENDS
ROUND(n) = if n == 0 then STOP else (ENDS ; ROUND(n - 1))
TREE(n) = if n == 0 then SKIP else (a -> TREE(n - 1) ||| b -> SKIP)
TIMES = ENDS /\ (d -> TIMES)
BROKEN = (a -> STOP) ||| (b -> (if head(<>) then STOP else SKIP))
)";

void expect_same(const std::string& process, std::size_t least_formats = 1) {
  SCOPED_TRACE(process);
  TestScript script(definitions);
  ASSERT_TRUE(script.loaded()) << script.messages();
  EXPECT_TRUE(lazy_machine_is_exact(script, process));
  base::Diagnostics diagnostics;
  const auto term = script.script().process(process, diagnostics);
  ASSERT_TRUE(term) << base::render_all(diagnostics, script.sources());
  LazyMachine machine = script.script().lazy_machine(*term, diagnostics);
  EXPECT_TRUE(lts::count(machine).complete());
  EXPECT_GE(machine.structure().formats, least_formats);
}

TEST(LazyMachineTest, OperatorsThatStayInPlaceAreOneFormat) {
  expect_same("P ||| Q ||| R");
  expect_same("(P [|{a}|] Q) [|{a, c}|] R");
  expect_same("P [{a, b} || {a, c}] Q");
  expect_same("P [b <-> a] Q");
  expect_same("((P ||| Q) \\ {a})[[b <- c, b <- d]]");
  expect_same("(P ||| Q) |\\ {a}");
  expect_same("prioritise(P ||| Q, <{a}, {b, c}>)");
  expect_same("prioritisepo(P ||| Q, {a, b, c}, {(a, c), (b, c)}, {a})");
  expect_same("explicate(P ||| Q)");
  expect_same("normal(P ||| Q)", 0);
  expect_same("prioritise(normal(P ||| Q), <{a}, {b, c}>)");
}

TEST(LazyMachineTest, SequencesOfParallels) {
  expect_same("(P ||| Q) ; R");
  expect_same("ENDS ; (P ||| Q)", 2);
  expect_same("ENDS ; ENDS ; ENDS", 3);
  expect_same("(ENDS ; (ENDS [] a -> ENDS)) ||| P", 2);
  expect_same("(SKIP ||| SKIP) ; P");
  expect_same("((a -> SKIP) ||| SKIP) ; P");
  expect_same("((a -> SKIP) [|{a}|] (a -> SKIP)) ; b -> SKIP");
  expect_same("((a -> SKIP) ||| (SKIP [] SKIP)) ; b -> SKIP");
  expect_same("explicate((a -> SKIP) ||| SKIP) ; b -> SKIP");
  expect_same("normal((a -> SKIP) ||| SKIP) ; b -> SKIP", 0);
  expect_same("(((a -> SKIP) ||| SKIP) \\ {a}) ; b -> SKIP");
  expect_same("(((a -> SKIP) ||| SKIP) [> (b -> SKIP)) ; c -> SKIP");
}

TEST(LazyMachineTest, ChoicesBetweenParallels) {
  expect_same("(P ||| Q) [] R", 1);
  expect_same("(P ||| Q) [] BOTH [] (c -> ENDS)", 3);
  expect_same("((P ||| Q) \\ {a}) [] BOTH", 2);
  expect_same("(P ||| Q) |~| BOTH", 2);
  expect_same("(P ||| Q) [> BOTH", 2);
  expect_same("((P ||| Q) \\ {a}) [> BOTH", 2);
  expect_same("(P ||| Q) [+{a}+] (Q ||| R)", 2);
  expect_same("((P ||| Q) \\ {b}) [+{a}+] (a -> ENDS) [+{a}+] BOTH", 2);
}

TEST(LazyMachineTest, InterruptsOfParallels) {
  expect_same("(P ||| Q) /\\ R");
  expect_same("ENDS /\\ (d -> BOTH)", 2);
  expect_same("(ENDS [] d -> R) /\\ (e -> BOTH)", 2);
  expect_same("((P ||| Q) [|{c}|> BOTH)", 2);
  expect_same("(P ||| Q) /+{a}+\\ (a -> d -> BOTH)", 2);
  expect_same("(ENDS /+{a}+\\ ((R ||| a -> SKIP) \\ {b}))", 1);
}

TEST(LazyMachineTest, RecursionThroughParallels) {
  expect_same("AGAIN");
  expect_same("TIMES");
  expect_same("ROUND(5)", 5);
  expect_same("ROUND(3) ||| ROUND(2)", 4);
  expect_same("LATER ; LATER");
  expect_same("NAME ; NAME");
  expect_same("(c -> NAME) ; NAME");
  expect_same("(c -> NAME) ||| (c -> NAME)");
  expect_same("TREE(4)", 4);
  expect_same("TREE(3) ; TREE(2)", 4);
}

// What wide operands do is remembered from state to state.
TEST(LazyMachineTest, WideOperands) {
  TestScript script(R"(
channel n, m : {0..39}
channel e
IN(last) = n?x -> IN(x % 3) [] m.last -> IN(0) [] e -> SKIP
WIDE = (IN(0) [|{|n|}|] IN(1)) ||| IN(2)
)");
  ASSERT_TRUE(script.loaded()) << script.messages();
  EXPECT_TRUE(lazy_machine_is_exact(script, "WIDE [|{|n, m|}|] WIDE"));
  EXPECT_TRUE(lazy_machine_is_exact(script, "(WIDE ; WIDE) [|{|n|}|] (WIDE [] e -> WIDE)"));
  EXPECT_TRUE(lazy_machine_is_exact(script, "((WIDE \\ {|m|})[[n.0 <- n.1]]) /\\ WIDE"));
}

TEST(LazyMachineTest, WhatIsNoParallelIsOneLeaf) {
  expect_same("P", 0);
  expect_same("(P [] Q) ; R", 0);
  expect_same("chase(P ||| Q)", 0);
}

// Thousands of operators deep: the deepest are a leaf.
TEST(LazyMachineTest, DeepTermsEndInALeaf) {
  TestScript script("channel a\nDEEP(n) = if n == 0 then a -> STOP else (SKIP ||| DEEP(n - 1))\n");
  EXPECT_TRUE(lazy_machine_is_exact(script, "DEEP(400)"));
}

TEST(LazyMachineTest, AFailingLeafIsReportedAsTheStepRulesDo) {
  TestScript script(definitions);
  base::Diagnostics of_machine, of_rules;
  const auto term = script.script().process("BROKEN", of_machine);
  LazyMachine machine = script.script().lazy_machine(*term, of_machine);
  const auto found = lts::count(machine);
  TermSystem terms = script.script().terms(*term, of_rules);
  const auto expected = lts::count(terms);
  EXPECT_TRUE(found.failed);
  EXPECT_EQ(found.states, expected.states);
  EXPECT_EQ(base::render_all(of_machine, script.sources()),
            base::render_all(of_rules, script.sources()));
}

TEST(LazyMachineTest, ProcessesOfTheCorpusAreThoseOfTheStepRules) {
  std::size_t composite = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::corpus())) {
    if (entry.path().extension() != ".csp") continue;
    const auto script = TestScript::of_file(entry.path());
    if (!script->loaded()) continue;
    for (const std::string& name : script->script().process_names()) {
      SCOPED_TRACE(entry.path().string() + " " + name);
      EXPECT_TRUE(lazy_machine_is_exact(*script, name));
      ++composite;
    }
  }
  EXPECT_GE(composite, 20U);
}

TEST(LazyMachineTest, ProcessesOfOthersAreThoseOfTheStepRules) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  for_each_peer(data, [](const PeerRow& row, TestScript& script) {
    EXPECT_TRUE(lazy_machine_is_exact(script, row.process, 3'000));
  });
}

}  // namespace
}  // namespace perentie::semantics

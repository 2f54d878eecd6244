// Random processes as machines and by the step rules: the same states, edges and behaviour.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "machine_support.hpp"
#include "perentie/lts/bisimulation.hpp"
#include "perentie/semantics/process_system.hpp"

namespace perentie::semantics {
namespace {

int pick(int end) { return *rc::gen::inRange(0, end); }

std::string event() { return std::string(1, "abc"[pick(3)]); }

// Guarded: a name comes only after an event and where nothing stays on after it.
std::string sequential(int depth, bool may_recur) {
  if (depth == 0) {
    const int kind = pick(4);
    if (kind >= 2 && may_recur) return event() + " -> P" + std::to_string(pick(3));
    return kind % 2 == 0 ? "SKIP" : event() + " -> STOP";
  }
  const auto operand = [&](bool tail) {
    return "(" + sequential(depth - 1, may_recur && tail) + ")";
  };
  switch (pick(9)) {
    case 0:
    case 1:
      return event() + " -> " + operand(true);
    case 2:
      return operand(true) + " [] " + operand(true);
    case 3:
      return operand(true) + " |~| " + operand(true);
    case 4:
      return operand(true) + " [> " + operand(true);
    case 5:
      return operand(false) + " ; " + operand(true);
    case 6:
      return operand(false) + " /\\ " + operand(true);
    case 7:
      return operand(false) + " [|{" + event() + "}|> " + operand(true);
    default:
      return operand(false) + " ||| " + operand(false);
  }
}

std::string composed(int depth) {
  if (depth == 0) return "(" + sequential(2, true) + ")";
  const std::string p = composed(depth - 1);
  const std::string one = event(), two = event(), three = event();
  switch (pick(18)) {
    case 0:
    case 1:
      return "(" + p + " \\ {" + one + "})";
    case 2:
      return "(" + p + " |\\ {" + one + ", " + two + "})";
    case 3:
    case 4:
      return "(" + p + "[[" + one + " <- " + two + ", " + one + " <- " + three + "]])";
    case 5:
      return "(prioritise(" + p + ", <{" + one + "}, {" + two + "}>))";
    default:
      break;
  }
  const std::string q = composed(depth - 1);
  switch (pick(16)) {
    case 13:
      return "(" + p + " [> " + q + ")";
    case 14:
      return "(" + p + " [|{" + one + "}|> " + q + ")";
    case 15:
      return "(" + one + " -> " + p + " |~| " + q + ")";
    case 0:
    case 1:
      return "(" + p + " ||| " + q + ")";
    case 2:
    case 3:
      return "(" + p + " [|{" + one + ", " + two + "}|] " + q + ")";
    case 4:
    case 5:
      return "(" + p + " [{" + one + ", " + two + "} || {" + one + ", " + three + "}] " + q + ")";
    case 6:
      return "([|{" + one + "}|] i : {0..2} @ if i == 0 then " + p + " else if i == 1 then " + q +
             " else P0)";
    case 7:
      return "(" + p + " [" + one + " <-> " + two + "] " + q + ")";
    case 8:
      return "(" + p + " ; " + q + ")";
    case 9:
      return "(" + p + " [] " + q + ")";
    case 10:
      return "(" + p + " [+{" + one + "}+] " + q + ")";
    case 11:
      return "(" + p + " /+{" + one + "}+\\ " + q + ")";
    default:
      return "(" + p + " /\\ " + q + ")";
  }
}

RC_GTEST_PROP(MachinePropertyTest, MachinesHaveTheLtsOfTheStepRules, ()) {
  std::string definitions = "external prioritise\nchannel a, b, c\n";
  for (int i = 0; i < 3; ++i) {
    definitions += "P" + std::to_string(i) + " = " + sequential(2, true) + "\n";
  }
  const std::string process = composed(3);
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
  std::string definitions = "external prioritise\nchannel a, b, c\n";
  for (int i = 0; i < 3; ++i) {
    definitions += "P" + std::to_string(i) + " = " + sequential(2, true) + "\n";
  }
  const std::string process = composed(2);
  RC_LOG() << definitions << process;
  TestScript script(definitions);
  RC_ASSERT(script.loaded());
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

// Parallels anywhere: under operators that switch, after prefixes, under names.
RC_GTEST_PROP(MachinePropertyTest, LazyMachinesAreExact, ()) {
  std::string definitions = "external prioritise\nchannel a, b, c\n";
  for (int i = 0; i < 3; ++i) {
    const std::string parallel = sequential(1, false) + " ||| " + sequential(1, false);
    definitions += "P" + std::to_string(i) + " = ";
    definitions += pick(3) == 0
                       ? "(" + parallel + ") ; " + event() + " -> P" + std::to_string(pick(3))
                       : sequential(2, true);
    definitions += "\n";
  }
  const std::string process = composed(3);
  RC_LOG() << definitions << process;
  TestScript script(definitions);
  RC_ASSERT(script.loaded());
  RC_ASSERT(lazy_machine_is_exact(script, process, 1'000));
}

}  // namespace
}  // namespace perentie::semantics

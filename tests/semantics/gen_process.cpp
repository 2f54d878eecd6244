#include "gen_process.hpp"

#include <rapidcheck.h>

namespace perentie::semantics::test {

int pick(int end) { return *rc::gen::inRange(0, end); }

std::string some_event() { return std::string(1, "abc"[pick(3)]); }

// Guarded: a name comes only after an event and where nothing stays on after it.
std::string some_sequential(int depth, bool may_recur) {
  if (depth == 0) {
    const int kind = pick(4);
    if (kind >= 2 && may_recur) return some_event() + " -> P" + std::to_string(pick(3));
    return kind % 2 == 0 ? "SKIP" : some_event() + " -> STOP";
  }
  const auto operand = [&](bool tail) {
    return "(" + some_sequential(depth - 1, may_recur && tail) + ")";
  };
  switch (pick(9)) {
    case 0:
    case 1:
      return some_event() + " -> " + operand(true);
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
      return operand(false) + " [|{" + some_event() + "}|> " + operand(true);
    default:
      return operand(false) + " ||| " + operand(false);
  }
}

std::string some_compression() {
  const char* const names[] = {"sbisim",          "dbisim",  "wbisim",
                               "tau_loop_factor", "diamond", "normal"};
  return names[pick(6)];
}

std::string some_process(int depth) {
  if (depth == 0) return "(" + some_sequential(2, true) + ")";
  const std::string p = some_process(depth - 1);
  const std::string one = some_event(), two = some_event(), three = some_event();
  switch (pick(20)) {
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
    case 6:
    case 7:
      return "(" + some_compression() + "(" + p + "))";
    default:
      break;
  }
  const std::string q = some_process(depth - 1);
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

std::string some_definitions() {
  std::string definitions = header;
  for (int i = 0; i < 3; ++i) {
    definitions += "P" + std::to_string(i) + " = " + some_sequential(2, true) + "\n";
  }
  return definitions;
}

}  // namespace perentie::semantics::test

// Timed sections against hand-written untimed twins (CSPM reference 2.10.4, 2.10.11).
#include <gtest/gtest.h>

#include "script_support.hpp"

namespace perentie::semantics {
namespace {

// The process `T`, defined by `timed` in a section with unit times, against `U`, defined outside.
::testing::AssertionResult twins(const std::string& timed, const std::string& untimed,
                                 const std::string& section = "Timed") {
  return same_lts("T", "U",
                  "channel tock\nexternal prioritise\n" + section + " {\n" + timed + "\n}\n" +
                      untimed + "\nTSTOP = tock -> TSTOP\nTSKIP = tock -> TSKIP [] SKIP\n");
}

TEST(TimedTest, Constants) {
  EXPECT_TRUE(twins("T = STOP", "U = TSTOP"));
  EXPECT_TRUE(twins("T = SKIP", "U = TSKIP"));
  EXPECT_TRUE(has_lts("T", "0 tock 0; 0 tick 1", "channel tock\nTimed { T = SKIP }"));
}

TEST(TimedTest, PrefixWaitsForItsEventAndTakesItsTime) {
  EXPECT_TRUE(twins("T = a -> b -> T", R"(
U = a -> tock -> V [] tock -> U
V = b -> tock -> U [] tock -> V)"));
  EXPECT_TRUE(
      twins("T = a -> STOP", "U = a -> tock -> tock -> TSTOP [] tock -> U", "Timed(\\ x @ 2)"));
  EXPECT_TRUE(twins("T = a -> STOP", "U = a -> TSTOP [] tock -> U", "Timed(\\ x @ 0)"));
}

TEST(TimedTest, TheTimeIsOfTheEvent) {
  EXPECT_TRUE(twins("T = n?x -> STOP", R"(
U = n.0 -> TSTOP [] n.1 -> tock -> TSTOP [] tock -> U)",
                    "time(n.x) = x\nTimed(time)"));
  EXPECT_TRUE(twins("T = d?x!true -> n!x -> STOP", R"(
U = d.0.true -> tock -> V(0) [] d.1.true -> tock -> V(1) [] tock -> U
V(x) = n.x -> tock -> TSTOP [] tock -> V(x))"));
  EXPECT_EQ(codes_of_process("T", "channel tock\nTimed(\\ x @ 0 - 1) { T = a -> STOP }"), "E020");
}

TEST(TimedTest, WaitIsExactlySoManyTocks) {
  EXPECT_TRUE(twins("T = WAIT(0)", "U = TSKIP"));
  EXPECT_TRUE(twins("T = WAIT(2)", "U = tock -> tock -> TSKIP"));
  EXPECT_TRUE(twins("T = WAIT(1) ; a -> STOP", R"(
U = (tock -> TSKIP) ; V
V = a -> tock -> TSTOP [] tock -> V)"));
}

TEST(TimedTest, ChoicesAreNotResolvedByTime) {
  EXPECT_TRUE(twins("T = a -> STOP [] b -> STOP", R"(
U = A [+{tock}+] B
A = a -> tock -> TSTOP [] tock -> A
B = b -> tock -> TSTOP [] tock -> B)"));
  EXPECT_TRUE(twins("T = [] x : {a, b} @ x -> STOP", R"(
U = [+{tock}+] x : {a, b} @ A(x)
A(x) = x -> tock -> TSTOP [] tock -> A(x))"));
  EXPECT_TRUE(twins("T = a -> STOP |~| b -> STOP", R"(
U = A(a) |~| A(b)
A(x) = x -> tock -> TSTOP [] tock -> A(x))"));
  EXPECT_TRUE(twins("T = a -> STOP [> STOP", R"(
U = A(a) [> TSTOP
A(x) = x -> tock -> TSTOP [] tock -> A(x))"));
}

TEST(TimedTest, GuardsGiveTimedStop) {
  EXPECT_TRUE(twins("T = false & a -> STOP", "U = TSTOP"));
  EXPECT_TRUE(twins("T = true & STOP", "U = TSTOP"));
}

const char* const waiting = "\nA(x) = x -> tock -> TSTOP [] tock -> A(x)";

TEST(TimedTest, ParallelsSynchroniseOnTime) {
  EXPECT_TRUE(
      twins("T = a -> STOP ||| b -> STOP", std::string("U = A(a) [|{tock}|] A(b)") + waiting));
  EXPECT_TRUE(twins("T = a -> STOP [|{a}|] a -> STOP",
                    std::string("U = A(a) [|{a, tock}|] A(a)") + waiting));
  EXPECT_TRUE(twins("T = a -> STOP [{a} || {b}] b -> STOP",
                    std::string("U = A(a) [{a, tock} || {b, tock}] A(b)") + waiting));
  EXPECT_TRUE(twins("T = ||| x : {a, b} @ x -> STOP",
                    std::string("U = [|{tock}|] x : {a, b} @ A(x)") + waiting));
  EXPECT_TRUE(twins("T = [|{a}|] x : {a, b} @ x -> STOP",
                    std::string("U = [|{a, tock}|] x : {a, b} @ A(x)") + waiting));
  EXPECT_TRUE(twins("T = || x : {a, b} @ [{x}] x -> STOP",
                    std::string("U = || x : {a, b} @ [{x, tock}] A(x)") + waiting));
}

TEST(TimedTest, InterruptsSynchroniseOnTime) {
  EXPECT_TRUE(
      twins("T = a -> STOP /\\ b -> STOP", std::string("U = A(a) /+{tock}+\\ A(b)") + waiting));
  EXPECT_TRUE(twins("T = a -> STOP /+{a}+\\ a -> STOP",
                    std::string("U = A(a) /+{a, tock}+\\ A(a)") + waiting));
  EXPECT_TRUE(twins("T = a -> STOP [+{a}+] a -> STOP",
                    std::string("U = A(a) [+{a, tock}+] A(a)") + waiting));
}

TEST(TimedTest, OtherOperatorsStayAsTheyAre) {
  EXPECT_TRUE(twins("T = (a -> STOP) \\ {a}", std::string("U = A(a) \\ {a}") + waiting));
  EXPECT_TRUE(
      twins("T = (a -> STOP) |\\ {a, tock}", std::string("U = A(a) |\\ {a, tock}") + waiting));
  EXPECT_TRUE(twins("T = (a -> STOP)[[a <- b]]", std::string("U = A(a)[[a <- b]]") + waiting));
  EXPECT_TRUE(
      twins("T = (a -> STOP) [|{a}|> b -> STOP", std::string("U = A(a) [|{a}|> A(b)") + waiting));
}

TEST(TimedTest, EmptyReplicatedOperators) {  // CSPM reference 2.10.5
  EXPECT_TRUE(twins("T = [] x : {} @ x -> STOP", "U = TSTOP"));
  EXPECT_TRUE(twins("T = ||| x : {} @ x -> STOP", "U = TSTOP"));
  EXPECT_TRUE(twins("T = || x : {} @ [{x}] x -> STOP", "U = TSTOP"));
  EXPECT_TRUE(twins("T = [|{a}|] x : {} @ x -> STOP", "U = TSTOP"));
  EXPECT_TRUE(twins("T = [+{a}+] x : {} @ x -> STOP", "U = TSTOP"));
  EXPECT_TRUE(twins("T = ; x : <> @ x -> STOP", "U = TSKIP"));
  EXPECT_EQ(codes_of_process("T", "channel tock\nTimed { T = |~| x : {} @ x -> STOP }"), "E014");
}

TEST(TimedTest, TimedPriority) {
  EXPECT_TRUE(twins("T = timed_priority(a -> STOP [> STOP)",
                    std::string("U = prioritise(A(a) [> TSTOP, <{}, {tock}>)") + waiting));
  EXPECT_TRUE(twins("T = timed_priority((a -> WAIT(1)) \\ {a})",
                    "U = prioritise(V \\ {a}, <{}, {tock}>)\n"
                    "V = a -> tock -> tock -> TSKIP [] tock -> V"));
}

TEST(TimedTest, LetsAndNestedSections) {
  EXPECT_TRUE(twins("T = let P = a -> P within P", "U = a -> tock -> U [] tock -> U"));
  EXPECT_TRUE(twins("T = let\n Timed(\\ x @ 2) { P = a -> P }\nwithin P",
                    "U = a -> tock -> tock -> U [] tock -> U"));
  EXPECT_TRUE(
      has_lts("T", "0 a 0", "channel tock\nT = let P = a -> P within P\nTimed { S = STOP }"));
}

TEST(TimedTest, DeclarationsInsideAreSeenOutside) {
  EXPECT_TRUE(has_lts("T [] (go -> STOP)",
                      "0 go 1; 0 go 2; 0 tock 3; 1; 2 tock 4; 3 go 2; 3 tock 3;"
                      "4 tock 4",
                      "channel tock\nTimed {\nchannel go\nT = go -> STOP\n}"));
}

TEST(TimedTest, WhatASectionNeedsAndCannotHold) {
  EXPECT_EQ(codes_of_process("T", "Timed { T = STOP }"), "N014");
  EXPECT_EQ(codes_of_process("T", "channel tock : {0}\nTimed { T = STOP }"), "N014");
  EXPECT_EQ(codes_of_process("T", "channel tock\nTimed { T = STOP [a <-> b] STOP }"), "N014");
  EXPECT_EQ(codes_of_process("T", "channel tock\nTimed { T = n$x -> STOP }"), "N014");
  EXPECT_EQ(codes_of_process("T", "channel tock\nT = WAIT(1)"), "N001");
}

}  // namespace
}  // namespace perentie::semantics

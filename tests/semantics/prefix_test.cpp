// Prefixes with all kinds of fields, and replicated operators (CSPM reference 4.3, 4.4).
#include <gtest/gtest.h>

#include "script_support.hpp"

namespace perentie::semantics {
namespace {

// --- Fields (4.3); n : {0..1} and d : {0..1}.Bool -----------------------------------------------

TEST(PrefixTest, EventsOnTheirOwn) {
  EXPECT_TRUE(has_lts("a -> STOP", "0 a 1; 1"));
  EXPECT_TRUE(has_lts("n.1 -> STOP", "0 n.1 1; 1"));
  EXPECT_TRUE(has_lts("d.1.true -> STOP", "0 d.1.true 1; 1"));
  EXPECT_TRUE(has_lts("next(0) -> STOP", "0 n.1 1; 1", "next(x) = n.(x + 1)"));
  EXPECT_TRUE(has_lts("(if true then a else b) -> STOP", "0 a 1; 1"));
  EXPECT_TRUE(has_lts("f(b) -> STOP", "0 b 1; 1", "f(x) = x"));
}

TEST(PrefixTest, OutputFields) {
  EXPECT_TRUE(has_lts("n!1 -> STOP", "0 n.1 1; 1"));
  EXPECT_TRUE(has_lts("d!0!true -> STOP", "0 d.0.true 1; 1"));
  EXPECT_TRUE(has_lts("d.0!true -> STOP", "0 d.0.true 1; 1"));
  EXPECT_TRUE(has_lts("d!0.true -> STOP", "0 d.0.true 1; 1"));
}

TEST(PrefixTest, InputFields) {
  EXPECT_TRUE(has_lts("n?x -> STOP", "0 n.0 1; 0 n.1 1; 1"));
  EXPECT_TRUE(has_lts("n?x -> n!x -> STOP", "0 n.0 1; 0 n.1 2; 1 n.0 3; 2 n.1 3; 3"));
  EXPECT_TRUE(has_lts("n?_ -> STOP", "0 n.0 1; 0 n.1 1; 1"));
  EXPECT_TRUE(has_lts("n?x:{0} -> STOP", "0 n.0 1; 1"));
  EXPECT_TRUE(has_lts("n?0 -> STOP", "0 n.0 1; 1"));
  EXPECT_TRUE(has_lts("n?x:{} -> STOP", "0"));
}

TEST(PrefixTest, TheLastFieldTakesAllThatRemains) {
  EXPECT_TRUE(has_lts("d?x -> (if x == (0.true) then a -> STOP else STOP)",
                      "0 d.0.false 1; 0 d.0.true 2; 0 d.1.false 1; 0 d.1.true 1; 1; 2 a 1"));
  EXPECT_TRUE(
      has_lts("d?x!true -> n.x -> STOP", "0 d.0.true 1; 0 d.1.true 2; 1 n.0 3; 2 n.1 3; 3"));
  EXPECT_TRUE(has_lts("d?x.y -> STOP",
                      "0 d.0.false 1; 0 d.0.true 1; 0 d.1.false 1;"
                      "0 d.1.true 1; 1"));
  EXPECT_TRUE(same_lts("d?x.y -> n!x -> STOP", "d?x?y -> n!x -> STOP"));
  EXPECT_TRUE(has_lts("d?x:{0.true, 1.false} -> STOP", "0 d.0.true 1; 0 d.1.false 1; 1"));
}

TEST(PrefixTest, LaterFieldsSeeEarlierOnes) {
  EXPECT_TRUE(has_lts("d?x?y:{x == 0} -> STOP", "0 d.0.true 1; 0 d.1.false 1; 1"));
  EXPECT_TRUE(has_lts("d?x!(x == 1) -> STOP", "0 d.0.false 1; 0 d.1.true 1; 1"));
}

TEST(PrefixTest, FieldsMatchPatterns) {
  const char* definitions = R"(
datatype T = A.{0..1} | B | C.Bool
channel t : T
channel p : ({0..1}, Bool)
channel s : {<>, <0>, <0, 1>}
)";
  EXPECT_TRUE(
      has_lts("t?A.x -> n!x -> STOP", "0 t.A.0 1; 0 t.A.1 2; 1 n.0 3; 2 n.1 3; 3", definitions));
  EXPECT_TRUE(has_lts("t?B -> STOP", "0 t.B 1; 1", definitions));
  EXPECT_TRUE(has_lts("t.C?x -> STOP", "0 t.C.false 1; 0 t.C.true 1; 1", definitions));
  EXPECT_TRUE(has_lts("p?(x, true) -> n!x -> STOP",
                      "0 p.(0,true) 1; 0 p.(1,true) 2; 1 n.0 3; 2 n.1 3; 3", definitions));
  EXPECT_TRUE(has_lts("s?<x>^xs -> n!#xs -> STOP", "0 s.<0> 1; 0 s.<0,1> 2; 1 n.0 3; 2 n.1 3; 3",
                      definitions));
}

TEST(PrefixTest, NondeterministicInput) {
  EXPECT_TRUE(has_lts("n$x -> STOP", "0 tau 1; 0 tau 2; 1 n.0 3; 2 n.1 3; 3"));
  EXPECT_TRUE(has_lts("n$x:{1} -> STOP", "0 n.1 1; 1"));
  EXPECT_TRUE(has_lts("d$x?y -> STOP",
                      "0 tau 1; 0 tau 2; 1 d.0.false 3; 1 d.0.true 3;"
                      "2 d.1.false 3; 2 d.1.true 3; 3"));
  EXPECT_TRUE(same_lts("d$x?y -> STOP", "|~| x : {0..1} @ [] y : Bool @ d.x.y -> STOP"));
  EXPECT_EQ(codes_of_process("n$x:{} -> STOP"), "E014");
}

TEST(PrefixTest, ValuesOutsideTheDeclarationAreErrors) {
  EXPECT_EQ(codes_of_process("n.2 -> STOP"), "E007");
  EXPECT_EQ(codes_of_process("n!2 -> STOP"), "E007");
  EXPECT_EQ(codes_of_process("n?x:{0, 2} -> STOP"), "E007");
  EXPECT_EQ(codes_of_process("n -> STOP"), "T001");
  EXPECT_EQ(codes_of_process("d!0 -> STOP"), "T001");
}

TEST(PrefixTest, ChannelsThatCarryEvents) {
  EXPECT_TRUE(has_lts("q?x -> x -> STOP", "0 q.n.0 1; 0 q.n.1 2; 1 n.0 3; 2 n.1 3; 3",
                      "channel q : {| n |}"));
}

// --- Replicated operators (4.4) -----------------------------------------------------------------

TEST(ReplicatedTest, ExternalChoice) {
  EXPECT_TRUE(has_lts("[] x : {a, b} @ x -> STOP", "0 a 1; 0 b 1; 1"));
  EXPECT_TRUE(has_lts("[] x : {0..1}, y : {0..1}, x != y @ d.x.(y == 0) -> STOP",
                      "0 d.0.false 1; 0 d.1.true 1; 1"));
  EXPECT_TRUE(has_lts("[] x : {} @ x -> STOP", "0"));
}

TEST(ReplicatedTest, InternalChoiceIsOneLevel) {
  EXPECT_TRUE(has_lts("|~| x : {a, b, c} @ x -> STOP",
                      "0 tau 1; 0 tau 2; 0 tau 3; 1 a 4; 2 b 4; 3 c 4; 4"));
  EXPECT_TRUE(has_lts("|~| x : {a} @ x -> STOP", "0 tau 1; 1 a 2; 2"));
  EXPECT_EQ(codes_of_process("|~| x : {} @ x -> STOP"), "E014");
}

TEST(ReplicatedTest, SequenceRunsOverASequence) {
  EXPECT_TRUE(has_lts("; x : <a, b, a> @ x -> SKIP", "0 a 1; 1 b 2; 2 a 3; 3 tick 4; 4"));
  EXPECT_TRUE(has_lts("; x : <> @ STOP", "0 tick 1; 1"));
  EXPECT_TRUE(has_lts("; x : <a> @ x -> SKIP", "0 a 1; 1 tick 2; 2"));
}

TEST(ReplicatedTest, Interleaving) {
  EXPECT_TRUE(has_lts("||| x : {a, b} @ x -> STOP", "0 a 1; 0 b 2; 1 b 3; 2 a 3; 3"));
  // Two bindings that give the same process are two copies (4.4.2).
  EXPECT_TRUE(has_lts("||| x : {1, 2} @ a -> STOP", "0 a 1; 0 a 2; 1 a 3; 2 a 3; 3"));
  EXPECT_TRUE(has_lts("||| x : {} @ STOP", "0 tick 1; 1"));
  EXPECT_TRUE(has_lts("||| x : {a} @ x -> STOP", "0 a 1; 1"));
}

TEST(ReplicatedTest, GeneralisedParallel) {
  EXPECT_TRUE(
      has_lts("[| {a} |] x : {b, c} @ a -> x -> STOP", "0 a 1; 1 b 2; 1 c 3; 2 c 4; 3 b 4; 4"));
  // n-ary: an event of the interface needs all three.
  EXPECT_TRUE(has_lts("[| {a} |] x : {0..2} @ (if x < 2 then a -> STOP else STOP)", "0"));
  EXPECT_TRUE(has_lts("[| {a} |] x : {} @ STOP", "0 tick 1; 1"));
}

TEST(ReplicatedTest, AlphabetisedParallel) {
  const char* definitions = R"(
A(0) = {a, b}
A(1) = {b, c}
A(2) = {c, a}
P(0) = a -> b -> STOP
P(1) = b -> c -> STOP
P(2) = a -> c -> STOP
)";
  EXPECT_TRUE(has_lts("|| i : {0..2} @ [A(i)] P(i)", "0 a 1; 1 b 2; 2 c 3; 3", definitions));
  EXPECT_TRUE(has_lts("|| i : {} @ [{}] STOP", "0 tick 1; 1"));
  // One operand is held to its alphabet (4.4.5).
  EXPECT_TRUE(has_lts("|| i : {0} @ [{a}] a -> b -> STOP", "0 a 1; 1"));
  // What follows applies to the whole (11.1).
  EXPECT_TRUE(
      has_lts("|| i : {0} @ [{a}] a -> STOP ||| b -> STOP", "0 a 1; 0 b 2; 1 b 3; 2 a 3; 3"));
}

TEST(ReplicatedTest, LinkedParallel) {
  EXPECT_TRUE(has_lts("[a <-> b] x : <0, 1> @ (if x == 0 then a -> c -> STOP else b -> e -> STOP)",
                      "0 tau 1; 1 c 2; 1 e 3; 2 e 4; 3 c 4; 4"));
  // A chain of two buffers of one place each: what goes in comes out.
  EXPECT_TRUE(has_lts("[o <-> i] x : <0, 1> @ P", "0 i.0 1; 1 tau 2; 2 i.0 3; 2 o.0 0; 3 o.0 1",
                      "channel i, o : {0}\nP = i?x -> o!x -> P"));
  EXPECT_EQ(codes_of_process("[a <-> b] x : <> @ STOP"), "E014");
  EXPECT_EQ(codes_of_process("STOP [a <-> b, a <-> c] STOP"), "E015");
}

TEST(ReplicatedTest, SynchronisingChoice) {
  EXPECT_TRUE(has_lts("[+ {a} +] x : {b, c} @ a -> x -> STOP", "0 a 1; 1 b 2; 1 c 2; 2"));
  EXPECT_TRUE(has_lts("[+ {a} +] x : {} @ STOP", "0"));
}

TEST(ReplicatedTest, SetsOfProcessesHoldEachOnce) {
  EXPECT_TRUE(has_lts("||| x : {P, P} @ x", "0 a 1; 1", "P = a -> STOP"));
  EXPECT_TRUE(has_lts("[] x : {STOP, STOP, RUN({a})} @ x", "0 a 1; 1 a 1"));
}

}  // namespace
}  // namespace perentie::semantics

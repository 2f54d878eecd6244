// Dumps and the comparison of trees.
#include "perentie/parser/dump.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "parse_support.hpp"

namespace perentie::parser {
namespace {

TEST(DumpTest, OneNodeALineWithPositions) {
  EXPECT_EQ(parse_text("f(x, 0) =\n  g(x) + 1 -- é\n\xC3\xA9").dump().substr(0, 7), "script\n");
  EXPECT_EQ(parse_text("-- é\nf(x)() =\n  g(x) + \"é\"\n").dump(),
            "script\n"
            "  function f @2:1\n"
            "    clause (1)(0) @2:1\n"
            "      pattern name x @2:3\n"
            "      body: infix + @3:3\n"
            "        call @3:3\n"
            "          function: name g @3:3\n"
            "          name x @3:5\n"
            "        string \"é\" @3:10\n");
}

TEST(DumpTest, Assertions) {
  Parsed parsed = parse_text("");
  const base::FileId text =
      *parsed.sources.add("a", "not P :[has trace [T]]: <a> :[tau priority]: {}");
  const auto assertion = parse_assertion(text, parsed.tree, parsed.sources, parsed.diagnostics);
  EXPECT_EQ(dump_ast(parsed.tree, *assertion, parsed.sources),
            "not has trace [T]\n"
            "  name P @a:1:5\n"
            "  event: name a @a:1:26\n"
            "  tau priority: set @a:1:46\n");
}

TEST(SameTreeTest, IgnoresPlacesAndLayout) {
  const Parsed a = parse_text("P = a -> b -> STOP\n");
  const Parsed b = parse_text("-- another layout\n\nP =\n  a ->\n  (b -> (STOP))");
  EXPECT_TRUE(same_tree(a.tree, b.tree));
}

// Any two of these differ, each in one small thing.
TEST(SameTreeTest, SeesEveryDifference) {
  const std::vector<std::string> scripts = {"x = 1",
                                            "y = 1",
                                            "x = 2",
                                            "x = -1",
                                            "x = 1\ny = 1",
                                            "x = '1'",
                                            "x = \"1\"",
                                            "x = true",
                                            "x = false",
                                            "x = {1}",
                                            "x = <1>",
                                            "x = {|1|}",
                                            "x = {1..}",
                                            "x = {1..1}",
                                            "x = <1..>",
                                            "x = {1 | y <- S}",
                                            "x = {1 | y}",
                                            "x = (1, 1)",
                                            "x = f()",
                                            "x = f(1)",
                                            "x = f(1)(1)",
                                            "x = f(1, 1)",
                                            "f(1) = 1",
                                            "f(1)() = 1",
                                            "f()(1) = 1",
                                            "f(1, 1) = 1",
                                            "f(1)(1) = 1",
                                            "f(1) = 1\nf(1) = 1",
                                            "x = a -> P",
                                            "x = a?b -> P",
                                            "x = a!b -> P",
                                            "x = a$b -> P",
                                            "x = a?b:c -> P",
                                            "x = a.b -> P",
                                            "x = P [] Q",
                                            "x = P |~| Q",
                                            "x = P [|a|] Q",
                                            "x = P [|a|> Q",
                                            "x = P [a||a] Q",
                                            "x = P [+a+] Q",
                                            "x = P /+a+\\ Q",
                                            "x = P [a<->b] Q",
                                            "x = P [b<->a] Q",
                                            "x = P[[a<-b]]",
                                            "x = P[[b<-a]]",
                                            "x = [] y:S @ P",
                                            "x = ||| y:S @ P",
                                            "x = || y:S @ [a] P",
                                            "x = [|a|] y:S@P",
                                            "x = [a<->b] y:S@P",
                                            "x = let y = 1 within y",
                                            "x = if a then b else c",
                                            "x = \\ y @ y",
                                            "x = not y",
                                            "x = #y",
                                            "x = M::y",
                                            "x = y",
                                            "x = (| |)",
                                            "x = (| 1 => 2 |)",
                                            "x :: Int",
                                            "x, y :: Int",
                                            "x :: a",
                                            "x :: Eq a => a",
                                            "x :: Ord a => a",
                                            "x :: {a}",
                                            "x :: <a>",
                                            "x :: (a, a)",
                                            "x :: a.a",
                                            "x :: a => a",
                                            "x :: a =>* a",
                                            "x :: (a) -> a",
                                            "x :: () -> a",
                                            "x :: (| a => a |)",
                                            "channel x",
                                            "channel x, y",
                                            "channel x : a",
                                            "datatype x = y",
                                            "datatype x = y.a",
                                            "subtype x = y",
                                            "nametype x = y",
                                            "transparent x",
                                            "external x",
                                            "assert P [T= Q",
                                            "assert P [F= Q",
                                            "assert not P [T= Q",
                                            "assert P :[deadlock free]",
                                            "assert P :[deadlock free [F]]",
                                            "assert P :[deterministic]",
                                            "assert P :[has trace]: <a>",
                                            "assert P [T= Q :[tau priority]: a",
                                            "assert P [T= Q :[partial order reduce]",
                                            "assert P [T= Q :[partial order reduce [fast]]",
                                            "print 1",
                                            "print 1 ",
                                            "print  2",
                                            "module x\nexports\nendmodule",
                                            "module x(y)\nexports\nendmodule",
                                            "module x\ny = 1\nexports\nendmodule",
                                            "module x\nexports\ny = 1\nendmodule",
                                            "instance x = y",
                                            "instance x = y(1)",
                                            "Timed {\n}",
                                            "Timed (f) {\n}",
                                            "(x, y) = 1",
                                            "<x> = 1",
                                            "{x} = 1",
                                            "{} = 1",
                                            "x.y = 1",
                                            "x^<y> = 1",
                                            "x @@ y = 1",
                                            "f(_) = 1",
                                            "f(-1) = 1",
                                            "f(\"1\") = 1",
                                            "f('1') = 1",
                                            "f(true) = 1"};
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    const Parsed a = parse_text(scripts[i] + "\n");
    EXPECT_EQ(a.messages(), "") << scripts[i];
    for (std::size_t k = 0; k < scripts.size(); ++k) {
      // A blank at the end of a print line means nothing.
      if (scripts[i].starts_with("print 1") && scripts[k].starts_with("print 1")) continue;
      const Parsed b = parse_text(scripts[k] + "\n");
      EXPECT_EQ(same_tree(a.tree, b.tree), i == k) << scripts[i] << "\n" << scripts[k];
    }
  }
}

}  // namespace
}  // namespace perentie::parser

// Processes with their definitions, and how long lines are broken (FDR's own printer).
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "script_support.hpp"

namespace perentie::semantics {
namespace {

// What `perentie eval -p` prints.
std::string definitions_of(const std::string& process, const std::string& definitions) {
  TestScript script("channel a, b\nchannel c : {0..20}.Bool\n" + definitions);
  base::Diagnostics diagnostics;
  const auto term = script.script().process(process, diagnostics);
  if (!term) return base::render_all(diagnostics, script.sources());
  return script.script().definitions(*term, diagnostics).value_or("nothing");
}

TEST(ShowDefinitionsTest, ComeBeforeTheirUses) {
  EXPECT_EQ(definitions_of("P", "P = a -> Q\nQ = b -> P"), "Q = b -> P\n\nP = a -> Q\n\nP");
  EXPECT_EQ(definitions_of("P", "P = SKIP"), "SKIP = ✓ -> STOP\n\nP = SKIP\n\nP");
}

// CSPM reference 3.10.11: a line has at most 67 characters besides its indentation.
TEST(ShowDefinitionsTest, LongDefinitionsAreBrokenAfterTheirName) {
  const std::string name(20, 'P');
  EXPECT_EQ(definitions_of(name, name + " = a -> a -> a -> a -> a -> a -> a -> a -> STOP"),
            name + " = a -> a -> a -> a -> a -> a -> a -> a -> STOP\n\n" + name);
  EXPECT_EQ(definitions_of(name, name + " = a -> a -> a -> a -> a -> a -> a -> a -> a -> STOP"),
            name + " =\n    a -> a -> a -> a -> a -> a -> a -> a -> a -> STOP\n\n" + name);
}

TEST(ShowDefinitionsTest, ABrokenChoiceHasOneOperandALine) {
  EXPECT_EQ(definitions_of("P",
                           "P = c.10.true -> a -> b -> STOP [] c.11.true -> b -> STOP\n"
                           "  [] c.12.true -> (a -> STOP |~| b -> STOP)"),
            "P =\n"
            "    c.10.true -> a -> b -> STOP\n"
            "    [] c.11.true -> b -> STOP\n"
            "    [] c.12.true -> (a -> STOP |~| b -> STOP)\n"
            "\nP");
}

TEST(ShowDefinitionsTest, SetsFillTheirLines) {
  EXPECT_EQ(definitions_of("P", "P = STOP [| {c.x.true | x <- {0..20}} |] STOP"),
            "P =\n"
            "    STOP\n"
            "    [| {c.0.true, c.1.true, c.2.true, c.3.true, c.4.true, c.5.true,\n"
            "        c.6.true, c.7.true, c.8.true, c.9.true, c.10.true, c.11.true,\n"
            "        c.12.true, c.13.true, c.14.true, c.15.true, c.16.true, c.17.true,\n"
            "        c.18.true, c.19.true, c.20.true} |] STOP\n"
            "\nP");
}

// CSPM reference 3.10.6: a buffer is known by its name, if its arguments make sense.
TEST(ShowDefinitionsTest, BuffersAreDefinedByThemselves) {
  EXPECT_EQ(definitions_of("BUFFER(1, {(a, b)})", ""),
            "BUFFER(1, {(a, b)}) = BUFFER(1, {(a, b)})\n\nBUFFER(1, {(a, b)})");
  EXPECT_EQ(definitions_of("BUFFER(0, {(a, b)})", ""), "nothing");
  EXPECT_EQ(definitions_of("BUFFER(1, {(a, a)})", ""), "nothing");
}

}  // namespace
}  // namespace perentie::semantics

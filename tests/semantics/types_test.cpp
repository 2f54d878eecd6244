// Type inference: the types that the corpus says, printed as FDR does (CSPM reference 3.1.9), and
// what no script of the corpus can hold.
#include "perentie/semantics/types.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "perentie/test/corpus.hpp"
#include "perentie/test/paths.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

namespace fs = std::filesystem;

class TypedScript : public ::testing::TestWithParam<fs::path> {};

TEST_P(TypedScript, HasTheTypesThatItSays) {
  const auto script = TestScript::of_file(GetParam());
  ASSERT_TRUE(script->loaded()) << script->messages();
  const std::string text = base::read_file(GetParam().generic_string()).text.value_or("");
  const std::regex said(R"(^-- ([\w:]+) :: (.*)$)", std::regex::multiline);
  std::size_t count = 0;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), said); it != std::sregex_iterator();
       ++it, ++count) {
    const std::string name = (*it)[1];
    std::string type;
    for (const auto& definition : script->script().types()) {
      if (definition.name == name) type = definition.type;
    }
    EXPECT_EQ(type, (*it)[2]) << name;
  }
  EXPECT_GT(count, 0U);
}

INSTANTIATE_TEST_SUITE_P(Corpus, TypedScript,
                         ::testing::ValuesIn(test::scripts_in(test::corpus() / "types/pass")),
                         [](const auto& script) { return script.param.stem().string(); });

std::string type_of(const std::string& expression, const std::string& definitions = "") {
  TestScript script(definitions);
  if (!script.loaded()) return script.messages();
  base::Diagnostics diagnostics;
  const auto read = script.script().expression(expression, diagnostics);
  return read ? script.script().type_of(*read) : base::render_all(diagnostics, script.sources());
}

std::string codes_of(const std::string& definitions) { return TestScript(definitions).codes(); }

TEST(TypesTest, BuiltinsHaveTheirSignatures) {
  EXPECT_EQ(type_of("head"), "(<a>) -> a");
  EXPECT_EQ(type_of("member"), "Eq a => (a, {a}) -> Bool");
  EXPECT_EQ(type_of("mapUpdate"), "Set a => ((| a => b |), a, b) -> (| a => b |)");
  EXPECT_EQ(type_of("extensions"), "(Set a, Yieldable b) => (a => b) -> {a}");
  EXPECT_EQ(type_of("relational_image", "external relational_image"),
            "(Eq a, Set b) => ({(a, b)}) -> (a) -> {b}");
}

// Every built-in that can be used has a signature: without one it would agree with everything.
TEST(TypesTest, EveryBuiltinHasASignature) {
  for (const BuiltinInfo& builtin : builtin_table) {
    if (builtin.import == Import::timed) continue;
    const std::string name(builtin.name);
    const std::string import = builtin.import == Import::no            ? ""
                               : builtin.import == Import::transparent ? "transparent " + name
                                                                       : "external " + name;
    EXPECT_NE(type_of(name, import), "a") << name;
  }
  EXPECT_EQ(codes_of("channel tock\nTimed {\n  P = WAIT(true)\n  Q = timed_priority(1)\n}"),
            "T001 T001");
}

TEST(TypesTest, ExpressionsAreInferredInTheScopeOfTheScript) {
  EXPECT_EQ(type_of("\\ x @ f(x, <>)", "f(x, xs) = <x>^xs"), "(a) -> <a>");
  EXPECT_EQ(type_of("c.0", "channel c : {0..1}.Bool"), "Bool => Event");
  EXPECT_EQ(type_of("{| c |}", "channel c : {0..1}.Bool"), "{Event}");
}

TEST(TypesTest, AnErrorIsReportedOnceAndNotWhereItIsUsed) {
  EXPECT_EQ(codes_of("x = 1 + true\ny = x + 1\nz = <x, y, 'c'>"), "T001");
  EXPECT_EQ(codes_of("x = 1 + true\ny = 1 + true"), "T001 T001");
}

// `prime.x` and x are both events, if one is the value where the other could be.
TEST(TypesTest, ADotMayHoldWhatItIsEqualTo) {
  EXPECT_EQ(type_of("f", "channel a\nchannel prime : {a}\nf(b, x) = if b then prime.x else x"),
            "(Bool, Event) -> Event");
}

TEST(TypesTest, RecursionIsOfOneTypeInsideItsGroupAndPolymorphicOutside) {
  const std::string recursive = "f(x) = g(1)\ng(x) = if f(true) == f(x) then 1 else 2";
  EXPECT_EQ(codes_of(recursive), "T001");
  EXPECT_EQ(codes_of("f :: (a) -> Int\n" + recursive), "");
  EXPECT_EQ(codes_of("f(x) = x\ng = (f(1), f(true))"), "");
}

TEST(TypesTest, VariablesOfAnAnnotationReachIntoLets) {
  EXPECT_EQ(codes_of("f :: (a) -> a\nf(x) = let\n    g :: (a) -> a\n    g(y) = x\n  within g(x)"),
            "");
  EXPECT_EQ(codes_of("f(x) = let\n    g :: (a) -> a\n    g(y) = x\n  within g(x)"), "T004");
}

TEST(TypesTest, LongChainsAndManyDefinitionsTakeNoStack) {
  std::string chain = "P = STOP";
  for (int i = 0; i < 20'000; ++i) chain += " ; STOP";
  EXPECT_EQ(codes_of(chain), "");
  std::string dots = "f(x) = x";
  for (int i = 0; i < 3'000; ++i) dots += ".1";
  EXPECT_EQ(codes_of(dots), "");
}

TEST(TypesTest, TypesThatNestTooDeeplyAreReported) {
  std::string text = "x0 = <>\n";
  for (int i = 1; i <= 2'200; ++i) {
    text += "x" + std::to_string(i) + " = <x" + std::to_string(i - 1) + ">\n";
  }
  EXPECT_EQ(codes_of(text + "y = x2200 == x2200"), "T005");
}

TEST(TypesTest, TypesThatGrowBeyondMeasureAreReported) {
  std::string text = "f0(x) = (x, x)\n";
  for (int i = 1; i <= 40; ++i) {
    const std::string last = "f" + std::to_string(i - 1) + "(x)";
    text += "f" + std::to_string(i) + "(x) = (" + last + ", " + last + ")\n";
  }
  EXPECT_EQ(codes_of(text), "T005");
}

// 2^60 parts, of which 60 are different.
TEST(TypesTest, SharedPartsOfTypesAreSeenOnce) {
  std::string text = "x0 = 1\n";
  for (int i = 1; i <= 60; ++i) {
    const std::string last = "x" + std::to_string(i - 1);
    text += "x" + std::to_string(i) + " = (" + last + ", " + last + ")\n";
  }
  EXPECT_EQ(codes_of(text + "y = x60 == x60"), "");
  EXPECT_LT(type_of("x60", text).size(), 3'000U);
}

}  // namespace
}  // namespace perentie::semantics

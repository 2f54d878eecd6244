// The corpus of values: every constant `test..` of corpus/evaluate/pass is true, and every process
// `PROC..` is printed with its definitions as the golden file of its script says.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "perentie/semantics/builtins.hpp"
#include "perentie/test/corpus.hpp"
#include "perentie/test/golden.hpp"
#include "perentie/test/paths.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  return base::read_file(path.generic_string()).text.value_or("");
}

const fs::path folder = test::corpus() / "evaluate/pass";

class PassingScript : public ::testing::TestWithParam<fs::path> {};

TEST_P(PassingScript, HoldsItsTests) {
  const auto script = TestScript::of_file(GetParam());
  ASSERT_TRUE(script->loaded()) << script->messages();
  const std::string text = text_of(GetParam());
  const std::regex definition(R"(^(test\w*) =)", std::regex::multiline);
  std::size_t tests = 0;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), definition);
       it != std::sregex_iterator(); ++it, ++tests) {
    EXPECT_EQ(script->evaluate((*it)[1]), "true") << (*it)[1];
  }
  EXPECT_GT(tests, 0U);
  EXPECT_EQ(script->messages(), "");
}

TEST_P(PassingScript, PrintsItsProcessesAsItsGoldenFileSays) {
  const auto script = TestScript::of_file(GetParam());
  ASSERT_TRUE(script->loaded()) << script->messages();
  const std::string text = text_of(GetParam());
  const std::regex definition(R"(^(PROC\w*) =)", std::regex::multiline);
  std::string printed;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), definition);
       it != std::sregex_iterator(); ++it) {
    const auto definitions = script->definitions((*it)[1]);
    ASSERT_TRUE(definitions) << script->messages();
    printed += with_own_numbers(*definitions) + "\n\n\n";
  }
  if (printed.empty()) return;
  EXPECT_TRUE(test::matches_golden(GetParam().generic_string() + ".processes", printed));
}

INSTANTIATE_TEST_SUITE_P(Corpus, PassingScript, ::testing::ValuesIn(test::scripts_in(folder)),
                         [](const auto& script) { return script.param.stem().string(); });

TEST(EvaluationCorpusTest, UsesEveryBuiltin) {
  std::set<std::string> words;
  const std::regex word(R"([A-Za-z_]\w*)");
  for (const fs::path& file : test::scripts_in(folder)) {
    const std::string text = text_of(file);
    for (auto it = std::sregex_iterator(text.begin(), text.end(), word);
         it != std::sregex_iterator(); ++it) {
      words.insert(it->str());
    }
  }
  const char* const names[] = {
#define PERENTIE_BUILTIN(id, name, kind, import, arguments) name,
#include "perentie/semantics/builtins.def"
#undef PERENTIE_BUILTIN
  };
  for (const char* name : names) EXPECT_TRUE(words.contains(name)) << name;
}

}  // namespace
}  // namespace perentie::semantics

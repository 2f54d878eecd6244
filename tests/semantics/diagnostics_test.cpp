// The corpus of errors: each script is reported as its comments and its golden file say.
//
// Scripts in corpus/names/fail and corpus/types/fail cannot be loaded. Those in
// corpus/evaluate/fail can; every constant `fail..` of theirs is evaluated and every process
// `FAIL..` explored, and `GROWING..` explored as far as a limit, in the order of the file.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <string>

#include "perentie/parser/diagnostic_codes.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"
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

// A script with all that can go wrong in it gone wrong.
std::unique_ptr<TestScript> provoke(const fs::path& path) {
  auto script = TestScript::of_file(path);
  if (!script->loaded()) return script;
  const std::string text = text_of(path);
  const std::regex definition(R"(^\s*(fail\w*|FAIL\w*|GROWING\w*) = )", std::regex::multiline);
  for (auto it = std::sregex_iterator(text.begin(), text.end(), definition);
       it != std::sregex_iterator(); ++it) {
    const std::string name = (*it)[1];
    const std::size_t before = script->diagnostics().error_count();
    if (name.starts_with("GROWING")) {
      EXPECT_TRUE(script->reaches_limit(name, {.max_states = 5'000})) << name;
      continue;
    }
    if (name.starts_with("fail")) {
      EXPECT_EQ(script->evaluate(name), std::nullopt) << name;
    } else {
      EXPECT_FALSE(script->explore(name, {.max_states = 1000})) << name;
    }
    EXPECT_EQ(script->diagnostics().error_count(), before + 1) << name << '\n'
                                                               << script->messages();
  }
  return script;
}

// What comments of the form `-- expect without place: E001` ask for.
std::set<std::string> expected_without_place(const std::string& script) {
  const std::regex comment(R"(-- expect without place: (\w+))");
  std::set<std::string> codes;
  for (auto it = std::sregex_iterator(script.begin(), script.end(), comment);
       it != std::sregex_iterator(); ++it) {
    codes.insert((*it)[1]);
  }
  return codes;
}

std::string with_suffix(const fs::path& file, const std::string& suffix) {
  return file.generic_string() + suffix;
}

class FailingScript : public ::testing::TestWithParam<fs::path> {};

TEST_P(FailingScript, IsReportedWhereItSaysSo) {
  const auto script = provoke(GetParam());
  test::CodesByLine reported;
  std::set<std::string> without_place;
  for (const base::Diagnostic& d : script->diagnostics().all()) {
    if (!d.span) {
      without_place.insert(std::string(d.code->id));
      continue;
    }
    EXPECT_EQ(script->sources().path(script->sources().file_of(d.span->begin)),
              GetParam().generic_string());
    reported[script->sources().position(d.span->begin).line].insert(std::string(d.code->id));
  }
  EXPECT_FALSE(script->diagnostics().all().empty());
  EXPECT_EQ(without_place, expected_without_place(text_of(GetParam())));
  EXPECT_EQ(reported, test::expected_codes(text_of(GetParam()))) << script->messages();
}

TEST_P(FailingScript, IsReportedAsItsGoldenFileSays) {
  const auto script = provoke(GetParam());
  EXPECT_TRUE(test::matches_golden(with_suffix(GetParam(), ".diagnostics"), script->messages()));
}

TEST_P(FailingScript, IsLoadedOnlyIfItsErrorsAreThoseOfEvaluation) {
  const bool evaluated = GetParam().parent_path().parent_path().stem() == "evaluate";
  EXPECT_EQ(TestScript::of_file(GetParam())->loaded(), evaluated);
}

std::string test_name(const ::testing::TestParamInfo<fs::path>& info) {
  return info.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(Names, FailingScript,
                         ::testing::ValuesIn(test::scripts_in(test::corpus() / "names/fail")),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Types, FailingScript,
                         ::testing::ValuesIn(test::scripts_in(test::corpus() / "types/fail")),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Evaluate, FailingScript,
                         ::testing::ValuesIn(test::scripts_in(test::corpus() / "evaluate/fail")),
                         test_name);

TEST(DiagnosticCodesTest, EachIsProducedBySomeScriptOfTheCorpus) {
  std::set<std::string_view> produced;
  for (const char* folder : {"names/fail", "types/fail", "evaluate/fail"}) {
    for (const fs::path& file : test::scripts_in(test::corpus() / folder)) {
      const auto script = provoke(file);
      for (const base::Diagnostic& d : script->diagnostics().all()) produced.insert(d.code->id);
    }
  }
  for (const base::DiagnosticCode* code : codes::all) {
    // Their scripts are made by limits_test and types_test.
    if (code->id == codes::nested_too_deeply.id || code->id == codes::type_too_deep.id) continue;
    // The type checker excludes them; they guard the evaluator against its mistakes.
    if (code->id == codes::wrong_type.id || code->id == codes::not_an_event.id) continue;
    EXPECT_TRUE(produced.contains(code->id)) << code->id << ": " << code->title;
  }
}

TEST(DiagnosticCodesTest, AreDistinctAndSortedByPhase) {
  for (std::size_t i = 1; i < codes::all.size(); ++i) {
    if (codes::all[i - 1]->id[0] != codes::all[i]->id[0]) continue;
    EXPECT_LT(codes::all[i - 1]->id, codes::all[i]->id);
  }
}

}  // namespace
}  // namespace perentie::semantics

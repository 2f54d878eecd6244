// Models by others in ../shared/data: their normal forms, as an independent explorer on FDR's own
// front end found them, and the evaluator tests of that front end. Skipped where ../shared is
// absent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "peer_rows.hpp"
#include "perentie/test/corpus.hpp"
#include "perentie/test/paths.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

namespace fs = std::filesystem;

// --- Normal forms -------------------------------------------------------------------------------

// Larger processes are left to tools: all tests together are to take less than a minute.
constexpr std::size_t most_states = 700;

TEST(SharedModelsTest, NormalFormsAreThoseOfAnIndependentExplorer) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  std::size_t compared = 0;
  for_each_peer(data, [&](const PeerRow& row, TestScript& script) {
    if (row.states > most_states) return;
    // It has an event `i`, which the recording took for the τ of .aut files.
    if (row.file == "varanus/evaluation/wcst_10.csp") return;
    const auto lts = script.explore(row.process, {.max_states = 100'000});
    ASSERT_TRUE(lts) << script.messages();
    EXPECT_EQ(trace_form(*lts), row.traces);
    EXPECT_EQ(failure_form(*lts), row.failures);
    ++compared;
  });
  EXPECT_GE(compared, 100U);
}

// --- The evaluator tests of FDR's front end -----------------------------------------------------

// Files whose tests do not hold, and why. One that begins to hold is a failure here, too.
const std::map<std::string, std::string>& known_exceptions() {
  static const std::map<std::string, std::string> exceptions{
      {"union.csp", "unions of sets are one set, whichever way they were formed"},
  };
  return exceptions;
}

// A process must print as one of its recorded texts, of which some were cut off at the end.
std::string problem_of_process(TestScript& script, const fs::path& path, const std::string& name) {
  base::Diagnostics diagnostics;
  const auto process = script.script().process(name, diagnostics);
  const auto text =
      process ? script.script().definitions(*process, diagnostics) : std::optional<std::string>();
  if (!text) return name + " has no value\n";
  const std::string prefix = path.stem().string() + "-" + name + "-expected";
  std::string recorded;
  for (const auto& file : fs::directory_iterator(path.parent_path())) {
    if (!file.path().filename().string().starts_with(prefix)) continue;
    recorded = base::read_file(file.path().generic_string()).text.value_or("");
    while (!recorded.empty() && std::isspace(static_cast<unsigned char>(recorded.back())) != 0) {
      recorded.pop_back();
    }
    if (with_own_numbers(*text).starts_with(with_own_numbers(recorded))) return "";
  }
  return name + " prints\n" + *text + "\ninstead of\n" + recorded + "\n";
}

// What is wrong with the tests of a script; empty: nothing.
std::string problems(const fs::path& path, std::size_t& count) {
  const auto script = TestScript::of_file(path);
  if (!script->loaded()) return script->messages();
  script->script().set_limits({.timeout = std::chrono::seconds(10)});
  const std::string text = base::read_file(path.generic_string()).text.value_or("");
  std::string found;
  const std::regex test(R"((^|\n)(test\w*)\s*=)");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), test); it != std::sregex_iterator();
       ++it, ++count) {
    const std::string name = (*it)[2];
    const auto value = script->evaluate(name);
    if (value != "true") found += name + " is " + value.value_or("nothing") + "\n";
  }
  const std::regex process(R"((^|\n)(procTest\w*)\s*=)");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), process);
       it != std::sregex_iterator(); ++it, ++count) {
    found += problem_of_process(*script, path, (*it)[2]);
  }
  return found.empty() ? "" : found + script->messages();
}

TEST(SharedModelsTest, EvaluatesTheTestsOfTheFrontEnd) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  std::size_t count = 0;
  for (const fs::path& file : test::scripts_in(data / "libcspm-tests/evaluator/should_pass")) {
    SCOPED_TRACE(file.filename().string());
    const std::string found = problems(file, count);
    const auto exception = known_exceptions().find(file.filename().string());
    if (exception == known_exceptions().end()) {
      EXPECT_EQ(found, "");
    } else {
      EXPECT_NE(found, "") << "is no exception any more: " << exception->second;
    }
  }
  EXPECT_GE(count, 100U);
}

// Cases of CASES.txt whose names begin so.
std::vector<fs::path> cases_of(const fs::path& data, const std::string& prefix) {
  std::vector<fs::path> found;
  std::ifstream cases(data / "libcspm-tests/CASES.txt");
  for (std::string line; std::getline(cases, line);) {
    if (line.starts_with(prefix)) found.push_back(data / "libcspm-tests" / line);
  }
  return found;
}

// Each test of a failing script ends with an error.
TEST(SharedModelsTest, RefusesToEvaluateWhatTheFrontEndRefuses) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  std::size_t count = 0;
  const std::regex test(R"((^|\n)((?:test|procTest)\w*)\s*=)");
  for (const fs::path& file : cases_of(data, "evaluator/should_fail")) {
    SCOPED_TRACE(file.filename().string());
    const auto script = TestScript::of_file(file);
    ASSERT_TRUE(script->loaded()) << script->messages();
    const std::string text = base::read_file(file.generic_string()).text.value_or("");
    for (auto it = std::sregex_iterator(text.begin(), text.end(), test);
         it != std::sregex_iterator(); ++it, ++count) {
      const std::string name = (*it)[2];
      const bool has_value = name.starts_with("test") ? script->evaluate(name).has_value()
                                                      : script->definitions(name).has_value();
      EXPECT_FALSE(has_value) << name;
      EXPECT_TRUE(script->diagnostics().has_errors()) << name;
    }
  }
  EXPECT_GE(count, 10U);
}

TEST(SharedModelsTest, RefusesToLoadWhatTheFrontEndCannotTranslate) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  const auto files = cases_of(data, "desugar/should_fail");
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : files) EXPECT_FALSE(TestScript::of_file(file)->loaded()) << file;
}

// --- The type checker's tests of that front end -------------------------------------------------

TEST(SharedModelsTest, AcceptsAndRefusesWhatTheFrontEndDoes) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  std::ifstream cases(data / "libcspm-tests/CASES.txt");
  ASSERT_TRUE(cases);
  std::size_t accepted = 0;
  std::size_t refused = 0;
  for (std::string line; std::getline(cases, line);) {
    if (!line.starts_with("typechecker/")) continue;
    const auto script = TestScript::of_file(data / "libcspm-tests" / line);
    const bool is_accepted = line.find("should_pass") != std::string::npos;
    EXPECT_EQ(script->loaded(), is_accepted) << line << '\n' << script->messages();
    ++(is_accepted ? accepted : refused);
  }
  EXPECT_GE(accepted, 30U);
  EXPECT_GE(refused, 60U);
}

// Models whose type errors are real, by what is wrong with them.
const std::map<std::string, std::string>& ill_typed_models() {
  static const std::map<std::string, std::string> models{
      {"testharness.csp", "it asserts on processes without their arguments"},
      {"actionlib_test.csp", "its channels have a field that the client does not give"},
      {"DiningPhilosophers.csp", "its annotations name a set where a type is needed"},
  };
  return models;
}

// Every model is well-typed, or lacks names: it is a part of others, which include it.
TEST(SharedModelsTest, ModelsAreWellTyped) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  std::size_t well_typed = 0;
  for (const char* folder : {"varanus", "processj-shared", "circus2csp", "curiosity-nfm2020",
                             "tyger", "futex", "dcreager-csp-models", "prob2-groovy"}) {
    for (const auto& entry : fs::recursive_directory_iterator(data / folder)) {
      if (entry.path().extension() != ".csp") continue;
      const std::string name = entry.path().filename().string();
      const auto script = TestScript::of_file(entry.path());
      if (script->loaded()) ++well_typed;
      const bool is_ill_typed = script->codes().find('T') != std::string::npos;
      EXPECT_EQ(is_ill_typed, ill_typed_models().contains(name)) << script->messages();
    }
  }
  EXPECT_GE(well_typed, 60U);
}

}  // namespace
}  // namespace perentie::semantics

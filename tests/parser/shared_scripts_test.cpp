// Scripts by others, where they lie beside the checkout: they parse, or are named here with the
// reason why not; what parses also survives being printed.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "parse_support.hpp"
#include "perentie/test/paths.hpp"

namespace perentie::parser {
namespace {

namespace fs = std::filesystem;

/// What the reference's grammar rejects, by path below the data folder.
const std::map<std::string, std::string> rejected = {
    {"processj-shared/3-to-1.csp", "three assertions that claim nothing about their process"},
    {"tyger/Examples/ReadyTestingExample.csp", "uses operators that another file would define"},
    {"tyger/Examples/ReadyTestingExample_Compiled.csp", "includes a file that is not there"},
    {"tyger/Examples/CCSPhils.csp", "is CCS: its operators `|` and `|->` are not CSPM's"},
    {"cspmf-frontend-tests/CSPM-Frontend/test/cspm/prioProb.csp",
     "`c!if .. else 2 -> P` takes the arrow into the conditional"},
    {"cspmf-frontend-tests/CSPM-Frontend/test/cspm/phils.fix.csp", "a renaming without pairs"},
};

/// Clauses of one function in two files: printed into one they are one function.
const std::string split_clauses = "libcspm-tests/typechecker/should_fail/split_definitions.csp";

std::vector<fs::path> scripts_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".csp") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void expect_round_trip(const Parsed& parsed) {
  const std::string printed = parsed.printed();
  const Parsed again = parse_text(printed);
  ASSERT_EQ(again.diagnostics.error_count(), 0U) << again.messages();
  EXPECT_TRUE(same_tree(parsed.tree, again.tree));
  EXPECT_EQ(again.printed(), printed);
}

void expect_parses(const fs::path& file, const fs::path& data) {
  const std::string name = file.lexically_relative(data).generic_string();
  SCOPED_TRACE(name);
  const Parsed parsed = parse_file(file);
  const auto reason = rejected.find(name);
  if (reason != rejected.end()) {
    EXPECT_TRUE(parsed.diagnostics.has_errors()) << "it is listed as rejected: " << reason->second;
    return;
  }
  EXPECT_EQ(parsed.diagnostics.error_count(), 0U) << parsed.messages();
  if (!parsed.diagnostics.has_errors() && name != split_clauses) expect_round_trip(parsed);
}

class SharedFolder : public ::testing::TestWithParam<std::string> {};

TEST_P(SharedFolder, Parses) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  const std::vector<fs::path> files = scripts_below(data / GetParam());
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : files) expect_parses(file, data);
}

INSTANTIATE_TEST_SUITE_P(Models, SharedFolder,
                         ::testing::Values("varanus", "processj-shared", "circus2csp",
                                           "curiosity-nfm2020", "tyger", "futex",
                                           "dcreager-csp-models", "cspmf-frontend-tests",
                                           "prob2-groovy"),
                         [](const auto& folder) {
                           std::string name = folder.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

std::vector<std::string> libcspm_cases(const fs::path& data) {
  std::vector<std::string> cases;
  std::ifstream list(data / "libcspm-tests/CASES.txt");
  for (std::string line; std::getline(list, line);) {
    if (!line.empty() && line[0] != '#') cases.push_back(line);
  }
  return cases;
}

TEST(LibcspmCases, AreReadAsTheirFoldersSay) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  const std::vector<std::string> cases = libcspm_cases(data);
  EXPECT_GT(cases.size(), 100U);
  for (const std::string& name : cases) {
    SCOPED_TRACE(name);
    const fs::path file = data / "libcspm-tests" / name;
    if (name.starts_with("parser/should_fail")) {
      EXPECT_TRUE(parse_file(file).diagnostics.has_errors());
    } else {
      expect_parses(file, data);
    }
  }
}

TEST(LibcspmCases, EveryScriptThatParserShouldRefuseIsRefused) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  for (const fs::path& file : scripts_below(data / "libcspm-tests/parser/should_fail")) {
    EXPECT_TRUE(parse_file(file).diagnostics.has_errors()) << file;
  }
}

}  // namespace
}  // namespace perentie::parser

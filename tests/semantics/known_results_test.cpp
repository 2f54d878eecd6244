// What FDR was recorded to say of models by others in ../shared/data: outcomes, and visited states,
// transitions and plys where they are known. Skipped where ../shared is absent.
//
// docs/conformance.md lists the counts that differ and why; the list here is the same.
#include <gtest/gtest.h>

#include <cctype>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "perentie/semantics/check.hpp"
#include "perentie/test/paths.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

namespace fs = std::filesystem;

struct Row {
  std::string file, line, assertion, expected;
  std::string states, transitions, plys;
};

// Fields are separated by tabs; a field in quotes has its quotes doubled.
std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, '\t');) {
    if (field.size() >= 2 && field.front() == '"') {
      field = std::regex_replace(field.substr(1, field.size() - 2), std::regex("\"\""), "\"");
    }
    found.push_back(field);
  }
  found.resize(8);
  return found;
}

std::vector<Row> rows(const fs::path& table) {
  std::vector<Row> found;
  std::ifstream stream(table);
  std::string line;
  std::getline(stream, line);  // the heading
  while (std::getline(stream, line)) {
    const auto f = fields(line);
    found.push_back({f[1], f[2], f[3], f[4], f[5], f[6], f[7]});
  }
  return found;
}

std::string text_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// An assertion without blanks, to be compared.
std::string squeezed(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
  return text;
}

// The scripts of the rows, each loaded once. A row may add a definition to its file: `F + "D"`.
// Rows without a line are of assertions that the file does not have, or has as comments: they are
// added.
class Scripts {
 public:
  Scripts(fs::path data, const std::vector<Row>& all) : data_(std::move(data)) {
    for (const Row& row : all) {
      if (row.line.empty()) added_[row.file] += "assert " + row.assertion + "\n";
    }
  }

  /// Null: the version of the file that was recorded is not there.
  TestScript* get(const Row& row) {
    auto [at, inserted] = scripts_.try_emplace(row.file);
    if (!inserted) return at->second.get();
    std::smatch m;
    static const std::regex with_definition(R"re((\S+) \+ "(.*)")re");
    const bool is_extended = std::regex_match(row.file, m, with_definition);
    const fs::path path = data_ / (is_extended ? m[1].str() : row.file);
    if (!fs::exists(path)) return nullptr;
    const std::string definition = is_extended ? m[2].str() + "\n" : "";
    at->second = std::make_unique<TestScript>(text_of(path) + "\n" + definition + added_[row.file],
                                              path.generic_string());
    return at->second.get();
  }

 private:
  fs::path data_;
  std::map<std::string, std::string> added_;  // by file
  std::map<std::string, std::unique_ptr<TestScript>> scripts_;
};

const ScriptAssertion* find(const std::vector<ScriptAssertion>& assertions,
                            const TestScript& script, const Row& row) {
  for (const ScriptAssertion& assertion : assertions) {
    if (row.line.empty()) {
      if (squeezed(assertion.text) == squeezed(row.assertion)) return &assertion;
    } else if (std::to_string(script.sources().position(assertion.span.begin).line) == row.line) {
      return &assertion;
    }
  }
  return nullptr;
}

// Rows whose outcome is not the recorded one, and why (docs/conformance.md). One that begins to
// come out as recorded is a failure here, too.
bool is_known_to_differ(const Row& row) {
  // Comments of the file's author that belong to another version of it.
  static const std::set<std::string> of_another_version{"95",  "97",  "99", "126",
                                                        "127", "128", "130"};
  return row.file == "circus2csp/exs/limits/limits.modular.3-variables.csp" &&
         of_another_version.contains(row.line);
}

// Files that end in an assertion without a property, which is a syntax error.
bool is_known_not_to_load(const Row& row) { return row.file == "processj-shared/3-to-1.csp"; }

// In the first model FDR counts one ✓ more, and compresses operands that are left as they are here.
// Of the other model only the first process has equal counts.
bool is_known_to_count_more(const Row& row) {
  return row.file == "circus2csp/exs/limits/limits.csp" ||
         (row.file.find("gCSPm/tests/tc.csp") != std::string::npos &&
          row.assertion.rfind("CTOC(", 0) != 0);
}

// Larger checks are left to tools: all tests together are to take less than a minute. The models of
// one file grow from assertion to assertion, so the first that is too large ends the file.
constexpr std::uint64_t most_states = 1'500;
constexpr std::chrono::seconds longest{2};

TEST(KnownResultsTest, OutcomesAndCountsAreThoseOfFdr) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  const std::vector<Row> all = rows(data / "known-results.tsv");
  Scripts scripts(data, all);
  std::size_t compared = 0;
  std::size_t of_absent_versions = 0;
  std::set<std::string> too_large;  // files
  for (const Row& row : all) {
    SCOPED_TRACE(fmt::format("{}:{}: {}", row.file, row.line, row.assertion));
    if (too_large.contains(row.file)) continue;
    TestScript* const script = scripts.get(row);
    if (script == nullptr) {
      ++of_absent_versions;
      continue;
    }
    EXPECT_EQ(script->loaded(), !is_known_not_to_load(row)) << script->messages();
    if (!script->loaded()) continue;
    const auto assertions = assertions_of(script->script().tree());
    const ScriptAssertion* const assertion = find(assertions, *script, row);
    if (assertion == nullptr) {
      ADD_FAILURE() << "the script has no such assertion";
      continue;
    }
    base::Diagnostics diagnostics;
    const CheckResult result =
        check(script->script(), *assertion,
              {.limits = {.max_states = most_states, .timeout = longest}}, diagnostics);
    if (result.outcome == CheckResult::Outcome::inconclusive) {
      too_large.insert(row.file);
      continue;
    }
    EXPECT_NE(result.outcome, CheckResult::Outcome::error)
        << base::render_all(diagnostics, script->sources());
    const bool is_as_recorded =
        (result.outcome == CheckResult::Outcome::holds) == (row.expected == "holds");
    EXPECT_EQ(is_as_recorded, !is_known_to_differ(row));
    ++compared;
    const auto is_equal = [](const std::string& recorded, std::uint64_t found) {
      return recorded.empty() || recorded == std::to_string(found);
    };
    EXPECT_TRUE(is_equal(row.plys, result.counts.plys)) << result.counts.plys;
    const bool has_recorded_counts = is_equal(row.states, result.counts.states) &&
                                     is_equal(row.transitions, result.counts.transitions);
    EXPECT_EQ(has_recorded_counts, !is_known_to_count_more(row))
        << fmt::format("{}/{}, FDR {}/{}", result.counts.states, result.counts.transitions,
                       row.states, row.transitions);
  }
  std::cout << fmt::format("{} rows compared, {} of absent versions; {} files cut short\n",
                           compared, of_absent_versions, too_large.size());
  EXPECT_GE(compared, 60U);
}

}  // namespace
}  // namespace perentie::semantics

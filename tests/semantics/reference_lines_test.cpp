// Every line of the CSPM reference that states a behaviour of the front end has a test that bears
// its number, and every built-in has its tests.
//
// reference_lines.tsv lists the lines of sections 1 to 3 and 11, with the reason where nothing can
// be tested. A test bears a number by its name (`test2_3_4_rows`, `fail2_3_4`, `PROC3_8_2`) or by a
// comment that says `reference 2.3.4`, or several numbers with commas between them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "perentie/base/source.hpp"
#include "perentie/semantics/builtins.hpp"
#include "perentie/test/paths.hpp"

namespace perentie::semantics {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  return base::read_file(path.generic_string()).text.value_or("");
}

// By number of the line: why it has no test; empty for most.
std::map<std::string, std::string> lines_of_the_reference() {
  std::ifstream table("tests/semantics/reference_lines.tsv");
  std::map<std::string, std::string> lines;
  std::string row;
  std::getline(table, row);  // the heading
  while (std::getline(table, row)) {
    const std::size_t tab = std::min(row.find('\t'), row.size());
    lines.emplace(row.substr(0, tab), row.substr(std::min(tab + 1, row.size())));
  }
  return lines;
}

void add_numbers(const std::string& text, std::set<std::string>& numbers) {
  static const std::regex in_name(R"(\b(?:test|fail|FAIL|PROC)(\d+)_(\d+)(?:_(\d+))?(?![0-9]))");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), in_name);
       it != std::sregex_iterator(); ++it) {
    const std::string section = (*it)[1].str() + "." + (*it)[2].str();
    numbers.insert((*it)[3].matched ? section + "." + (*it)[3].str() : section);
  }
  static const std::regex in_comment(R"(reference \d+\.\d+(?:\.\d+)?(?:, \d+\.\d+(?:\.\d+)?)*)");
  static const std::regex number(R"(\d+\.\d+(?:\.\d+)?)");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), in_comment);
       it != std::sregex_iterator(); ++it) {
    const std::string list = (*it)[0];
    for (auto n = std::sregex_iterator(list.begin(), list.end(), number);
         n != std::sregex_iterator(); ++n) {
      numbers.insert(n->str());
    }
  }
}

// The numbers that tests and scripts of the corpus bear.
std::set<std::string> tested_numbers() {
  std::set<std::string> numbers;
  for (const fs::path& folder : {test::corpus(), fs::path("tests")}) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const fs::path extension = entry.path().extension();
      if (extension == ".csp" || extension == ".cpp") add_numbers(text_of(entry.path()), numbers);
    }
  }
  return numbers;
}

bool is_of_the_front_end(const std::string& number) {
  const std::string section = number.substr(0, number.find('.'));
  return section == "1" || section == "2" || section == "3" || section == "11";
}

TEST(ReferenceLinesTest, EachHasATestOrAReasonWhyNot) {
  const auto lines = lines_of_the_reference();
  EXPECT_GT(lines.size(), 150U);
  const std::set<std::string> tested = tested_numbers();
  for (const auto& [line, reason] : lines) {
    EXPECT_NE(tested.contains(line), !reason.empty()) << line << ' ' << reason;
  }
}

TEST(ReferenceLinesTest, TestsNameOnlyLinesAndSectionsThatExist) {
  const auto lines = lines_of_the_reference();
  for (const std::string& number : tested_numbers()) {
    if (!is_of_the_front_end(number)) continue;
    const auto next = lines.lower_bound(number);
    const bool is_section = next != lines.end() && next->first.starts_with(number + ".");
    EXPECT_TRUE(lines.contains(number) || is_section) << number;
  }
}

TEST(ReferenceLinesTest, EveryBuiltinHasItsTests) {
  const std::string values = text_of(test::corpus() / "evaluate/pass/builtins.csp");
  const std::string types = text_of(test::corpus() / "types/pass/builtins.csp");
  const std::string type_errors = text_of(test::corpus() / "types/fail/builtins.csp");
  for (const BuiltinInfo& builtin : builtin_table) {
    const std::string name(builtin.name);
    EXPECT_NE(values.find("\ntest_" + name + " = "), std::string::npos) << name;
    EXPECT_NE(types.find("\n-- the_" + name + " :: "), std::string::npos) << name;
    EXPECT_NE(type_errors.find("fail_" + name + " = "), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace perentie::semantics

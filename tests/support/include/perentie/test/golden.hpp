// Golden files: what a step printed when someone last looked at it and found it right.
//
// `EXPECT_TRUE(matches_golden("corpus/x.csp.ast", dump))` compares a text with a file. On a
// mismatch the difference is shown; to accept all new texts, run the tests with
// PERENTIE_UPDATE_GOLDEN=1 and review the change with `git diff`.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace perentie::test {

inline bool updating_golden_files() {
  const char* update = std::getenv("PERENTIE_UPDATE_GOLDEN");
  return update != nullptr && std::string_view(update) == "1";
}

inline std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  if (!text.empty() && text.back() != '\n') lines.back() += "  (no newline at the end)";
  return lines;
}

/// The lines in which the texts differ, between what is equal at their beginning and end.
inline std::string difference(const std::string& expected, const std::string& actual) {
  constexpr std::size_t context = 2;
  constexpr std::size_t most = 40;
  const std::vector<std::string> old_lines = split_lines(expected);
  const std::vector<std::string> new_lines = split_lines(actual);
  const std::size_t shorter = std::min(old_lines.size(), new_lines.size());
  std::size_t first = 0;
  while (first < shorter && old_lines[first] == new_lines[first]) ++first;
  std::size_t last = 0;
  while (last < shorter - first &&
         old_lines[old_lines.size() - 1 - last] == new_lines[new_lines.size() - 1 - last]) {
    ++last;
  }
  std::ostringstream out;
  const auto show = [&](const char* sign, const std::vector<std::string>& lines, std::size_t begin,
                        std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i - begin == most) {
        out << sign << "... and " << end - i << " more lines\n";
        break;
      }
      out << sign << lines[i] << '\n';
    }
  };
  out << "@@ line " << first + 1 << " @@\n";
  show("  ", old_lines, first - std::min(first, context), first);
  show("- ", old_lines, first, old_lines.size() - last);
  show("+ ", new_lines, first, new_lines.size() - last);
  show("  ", new_lines, new_lines.size() - last, new_lines.size() - last + std::min(last, context));
  return out.str();
}

inline ::testing::AssertionResult matches_golden(const std::filesystem::path& file,
                                                 const std::string& actual) {
  if (updating_golden_files()) {
    std::ofstream(file, std::ios::binary) << actual;
    return ::testing::AssertionSuccess();
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return ::testing::AssertionFailure()
           << "there is no golden file " << file
           << "; make it with PERENTIE_UPDATE_GOLDEN=1. It would hold:\n"
           << actual;
  }
  const std::string expected{std::istreambuf_iterator<char>(stream), {}};
  if (expected == actual) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "the text differs from " << file << " (- expected, + actual):\n"
         << difference(expected, actual)
         << "If the new text is right, accept it with PERENTIE_UPDATE_GOLDEN=1";
}

}  // namespace perentie::test

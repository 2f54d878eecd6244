// Scripts of the corpus and what they say of themselves.
//
// A comment `-- expect: P001 ..` in a failing script says which codes its line is to be reported
// with; alone on its line, it speaks of the next one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace perentie::test {

/// All `.csp` files of a folder, sorted; not those of its subfolders.
inline std::vector<std::filesystem::path> scripts_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".csp") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

using CodesByLine = std::map<std::size_t, std::set<std::string>>;

/// What the comments of a script ask for.
inline CodesByLine expected_codes(const std::string& script) {
  CodesByLine expected;
  std::istringstream lines(script);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::size_t at = line.find("expect: ");
    if (at == std::string::npos) continue;
    const bool alone = line.find_first_not_of(' ') == line.find("-- expect");
    std::istringstream codes(line.substr(at + 8));
    for (std::string code; codes >> code;) expected[number + (alone ? 1 : 0)].insert(code);
  }
  return expected;
}

}  // namespace perentie::test

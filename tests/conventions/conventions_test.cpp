// The rules of the house that no compiler checks, held on the repository's own files.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace perentie {
namespace {

namespace fs = std::filesystem;

struct File {
  std::string path;
  std::vector<std::string> lines;
};

bool ends_with(const std::string& text, std::string_view end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool begins_with(const std::string& text, std::string_view begin) {
  return text.compare(0, begin.size(), begin) == 0;
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::vector<std::string> lines;
  std::ifstream stream(path, std::ios::binary);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// Every file of the project but what is built and what Git keeps, in a stable order.
const std::vector<File>& files() {
  static const std::vector<File> all = [] {
    std::vector<File> found;
    for (auto it = fs::recursive_directory_iterator("."); it != fs::end(it); ++it) {
      const std::string name = it->path().filename().string();
      if (it->is_directory() && (name == ".git" || (name == "build" && it.depth() == 0))) {
        it.disable_recursion_pending();
      } else if (it->is_regular_file()) {
        found.push_back({it->path().lexically_normal().generic_string(), lines_of(it->path())});
      }
    }
    std::sort(found.begin(), found.end(),
              [](const File& a, const File& b) { return a.path < b.path; });
    return found;
  }();
  return all;
}

bool is_source(const std::string& path) {
  return ends_with(path, ".cpp") || ends_with(path, ".hpp");
}

std::string place(const File& file, std::size_t line) {
  return file.path + ":" + std::to_string(line + 1);
}

// Every line of a source that includes something, with what it includes.
template <typename Visit>
void for_each_include(Visit visit) {
  static const std::regex include(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  for (const File& file : files()) {
    if (!is_source(file.path)) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      std::smatch match;
      if (std::regex_search(file.lines[i], match, include)) visit(file, i, match[1].str());
    }
  }
}

TEST(ConventionsTest, TheFilesAreFound) {
  ASSERT_GT(files().size(), 100U) << "tests run in the project's root folder";
}

TEST(ConventionsTest, NoPathOfAParticularMachine) {
  // Spelt in two parts, or this file would break its own rule.
  const std::regex machine(std::string("(^|[^A-Za-z0-9_.])/(wo") + "rk|ho" + "me|ro" + "ot|Us" +
                           "ers)/[A-Za-z0-9]");
  for (const File& file : files()) {
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      EXPECT_FALSE(std::regex_search(file.lines[i].substr(0, 2000), machine))
          << place(file, i) << ": " << file.lines[i].substr(0, 200);
    }
  }
}

TEST(ConventionsTest, LibrariesStayBehindTheirDoors) {
  // What may be included only in files whose path begins so.
  const std::multimap<std::string, std::string> doors = {
      {"boost/spirit", "parser/src/grammar/"},
      {"boost/graph", "lts/"},
      {"boost/graph", "tests/lts/"},
      {"CLI/", "cli/"},
      {"simdjson", "monitor/src/"},
      {"simdjson", "tests/bench/"},
      {"yaml-cpp", "monitor/src/"},
      {"yaml-cpp", "cli/"},
  };
  for_each_include([&](const File& file, std::size_t line, const std::string& header) {
    bool is_restricted = false;
    bool is_permitted = false;
    for (const auto& [library, folder] : doors) {
      if (!begins_with(header, library)) continue;
      is_restricted = true;
      is_permitted = is_permitted || begins_with(file.path, folder);
    }
    EXPECT_TRUE(!is_restricted || is_permitted) << place(file, line) << " includes " << header;
  });
}

TEST(ConventionsTest, LibrariesIncludeOnlyWhatTheirArrowsPointTo) {
  const std::map<std::string, std::set<std::string>> arrows = {
      {"base", {"base"}},
      {"parser", {"base", "parser"}},
      {"lts", {"base", "lts"}},
      {"semantics", {"base", "parser", "lts", "semantics"}},
      {"monitor", {"base", "lts", "monitor"}},
      {"cli", {"base", "parser", "lts", "semantics", "monitor", "cli"}},
  };
  for_each_include([&](const File& file, std::size_t line, const std::string& header) {
    const auto from = arrows.find(file.path.substr(0, file.path.find('/')));
    if (from == arrows.end() || !begins_with(header, "perentie/")) return;
    const std::string to = header.substr(9, header.find('/', 9) - 9);
    EXPECT_EQ(from->second.count(to), 1U) << place(file, line) << " includes " << header;
  });
}

TEST(ConventionsTest, SourcesAreOfReadableSize) {
  for (const File& file : files()) {
    if (!is_source(file.path)) continue;
    EXPECT_LE(file.lines.size(), 800U) << file.path;
  }
}

TEST(ConventionsTest, DiagnosticCodesStandForOneThing) {
  const std::regex code(R"re("([A-Z]\d{3})",\s*(error|warning|\w+::Severity))re");
  std::map<std::string, std::string> place_of;
  for (const File& file : files()) {
    if (begins_with(file.path, "tests/")) continue;
    if (!is_source(file.path) && !ends_with(file.path, "diagnostic_codes.def")) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      std::smatch match;
      if (!std::regex_search(file.lines[i], match, code)) continue;
      const auto [first, is_new] = place_of.try_emplace(match[1].str(), place(file, i));
      EXPECT_TRUE(is_new) << match[1] << " is at " << first->second << " and " << place(file, i);
    }
  }
  EXPECT_GT(place_of.size(), 50U);
}

TEST(ConventionsTest, EveryHeaderSaysItsIdeaFirst) {
  for (const File& file : files()) {
    if (!ends_with(file.path, ".hpp") || file.lines.empty()) continue;
    EXPECT_TRUE(begins_with(file.lines[0], "// ")) << file.path << " begins with no comment";
    const auto once = std::find(file.lines.begin(), file.lines.end(), "#pragma once");
    EXPECT_NE(once, file.lines.end()) << file.path << " lacks #pragma once";
  }
}

TEST(ConventionsTest, NothingIsLeftForLater) {
  const std::regex later(std::string("\\b(TO") + "DO|FIX" + "ME|XX" + "X)\\b");
  for (const File& file : files()) {
    if (!is_source(file.path)) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      EXPECT_FALSE(std::regex_search(file.lines[i], later)) << place(file, i);
    }
  }
}

// The name that a heading has in a link, as GitHub makes it.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading.substr(heading.find_first_not_of("# "))) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80) {
      anchor += static_cast<char>(std::tolower(byte));
    } else if (c == ' ') {
      anchor += '-';
    }
  }
  return anchor;
}

bool has_anchor(const fs::path& file, const std::string& anchor) {
  const std::vector<std::string> lines = lines_of(file);
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    return begins_with(line, "#") && line.find_first_not_of("# ") != std::string::npos &&
           anchor_of(line) == anchor;
  });
}

TEST(ConventionsTest, LinksInTheDocumentsLeadSomewhere) {
  const std::regex link(R"(\]\(([^)\s]+)\))");
  const std::regex code(R"(`[^`]*`)");
  for (const File& file : files()) {
    if (!ends_with(file.path, ".md")) continue;
    bool in_fence = false;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      if (begins_with(file.lines[i], "```")) in_fence = !in_fence;
      if (in_fence || begins_with(file.lines[i], "    ")) continue;
      const std::string line = std::regex_replace(file.lines[i], code, "");
      for (std::sregex_iterator it(line.begin(), line.end(), link), end; it != end; ++it) {
        const std::string target = (*it)[1];
        if (begins_with(target, "http:") || begins_with(target, "https:")) continue;
        const std::size_t hash = target.find('#');
        const std::string path = target.substr(0, hash);
        const fs::path file_meant =
            path.empty() ? fs::path(file.path) : fs::path(file.path).parent_path() / path;
        EXPECT_TRUE(fs::exists(file_meant)) << place(file, i) << " links to " << target;
        if (hash != std::string::npos && fs::is_regular_file(file_meant)) {
          EXPECT_TRUE(has_anchor(file_meant, target.substr(hash + 1)))
              << place(file, i) << " links to " << target;
        }
      }
    }
  }
}

// Files that the documents name in `code`: base/src/check.cpp, docs/cli.md.
TEST(ConventionsTest, FilesNamedInTheDocumentsExist) {
  const std::regex named(
      "`((base|parser|semantics|lts|monitor|cli|tests|corpus|docs|cmake)/[A-Za-z0-9_./-]+)`");
  for (const File& file : files()) {
    if (!ends_with(file.path, ".md")) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const std::string& line = file.lines[i];
      for (std::sregex_iterator it(line.begin(), line.end(), named), end; it != end; ++it) {
        const std::string path = (*it)[1];
        const bool exists = fs::exists(path) || fs::exists(path + ".cpp");
        EXPECT_TRUE(exists) << place(file, i) << " names " << path;
      }
    }
  }
}

}  // namespace
}  // namespace perentie

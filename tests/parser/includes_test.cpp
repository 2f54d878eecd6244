// Includes through a loader of our own: where files are looked for, cycles, limits.
#include "perentie/parser/parse.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "parse_support.hpp"

namespace perentie::parser {
namespace {

/// A file system of texts that notes what was asked for.
struct Files {
  std::map<std::string, std::string> texts;
  std::vector<std::string> asked{};

  Parsed parse(const std::string& root) {
    ParseOptions options;
    options.load = [this](const std::string& path) -> base::FileText {
      asked.push_back(path);
      const auto found = texts.find(path);
      if (found == texts.end()) return {std::nullopt, "it is not there"};
      return {found->second, {}};
    };
    Parsed parsed;
    const base::FileId file = *parsed.sources.add(root, texts.at(root));
    parsed.tree = parse_script(file, parsed.sources, parsed.diagnostics, options);
    return parsed;
  }
};

TEST(IncludesTest, AreRelativeToTheScriptThenToTheIncludingFile) {  // CSPM reference 2.8
  Files files{{{"models/main.csp", "include \"sub/a.csp\"\nx = 1\n"},
               {"models/sub/a.csp", "include \"b.csp\"\ninclude \"c.csp\"\n"},
               {"models/sub/b.csp", "wrong = 1\n"},
               {"models/b.csp", "b = 1\n"},
               {"models/sub/c.csp", "c = 1\n"}}};
  const Parsed parsed = files.parse("models/main.csp");
  EXPECT_EQ(parsed.messages(), "");
  EXPECT_EQ(parsed.printed(), "b = 1\nc = 1\nx = 1\n");
  EXPECT_EQ(files.asked, (std::vector<std::string>{"models/sub/a.csp", "models/b.csp",
                                                   "models/c.csp", "models/sub/c.csp"}));
}

TEST(IncludesTest, UpwardsAndAbsolute) {
  Files files{{{"a/b/main.csp", "include \"../up.csp\"\ninclude \"/abs/x.csp\"\n"},
               {"a/up.csp", "up = 1\n"},
               {"/abs/x.csp", "x = 1\n"}}};
  EXPECT_EQ(files.parse("a/b/main.csp").printed(), "up = 1\nx = 1\n");
}

TEST(IncludesTest, MissingFilesAreReportedAtTheLine) {
  Files files{{{"main.csp", "x = 1\ninclude \"no.csp\"\ny = 2\n"}}};
  const Parsed parsed = files.parse("main.csp");
  EXPECT_EQ(parsed.messages(),
            "main.csp:2:9: error: cannot read `no.csp`: it is not there [P022]\n"
            "include \"no.csp\"\n        ^~~~~~~~\n");
  EXPECT_EQ(parsed.printed(), "x = 1\ny = 2\n");
}

TEST(IncludesTest, CyclesAreReportedOnce) {
  Files files{{{"main.csp", "include \"a.csp\"\nx = 1\n"},
               {"a.csp", "include \"b.csp\"\na = 1\n"},
               {"b.csp", "include \"a.csp\"\nb = 1\n"}}};
  const Parsed parsed = files.parse("main.csp");
  EXPECT_EQ(parsed.codes(), "P023");
  EXPECT_EQ(parsed.diagnostics.all()[0].notes.size(), 1U);
  EXPECT_EQ(parsed.printed(), "b = 1\na = 1\nx = 1\n");
}

TEST(IncludesTest, TheSameFileTwiceIsReadTwice) {
  Files files{{{"main.csp", "include \"a.csp\"\ninclude \"a.csp\"\n"}, {"a.csp", "a = 1\n"}}};
  const Parsed parsed = files.parse("main.csp");
  EXPECT_EQ(parsed.messages(), "");
  EXPECT_EQ(parsed.printed(), "a = 1\na = 1\n");
}

// A loader that always has another file to include ends at the limit on nesting.
TEST(IncludesTest, NestingIsLimited) {
  ParseOptions options;
  int count = 0;
  options.load = [&](const std::string&) -> base::FileText {
    return {"include \"f" + std::to_string(count++) + ".csp\"\n", {}};
  };
  const Parsed parsed = parse_text("include \"first.csp\"\n", options);
  EXPECT_EQ(parsed.codes(), "P023");
  EXPECT_LT(count, 1000);
}

TEST(IncludesTest, NothingGoesOnAcrossTheBoundary) {  // CSPM reference 1.1.10
  Files files{{{"main.csp", "x = 1 +\ninclude \"a.csp\"\n[] STOP\n"}, {"a.csp", "2"}}};
  const Parsed parsed = files.parse("main.csp");
  EXPECT_EQ(parsed.codes(), "P001");
}

TEST(IncludesTest, SpansLieInTheirFiles) {
  Files files{{{"main.csp", "module M\ninclude \"a.csp\"\nexports\nendmodule\n"},
               {"a.csp", "f(0) = 1\nf(1) = 2"}}};
  const Parsed parsed = files.parse("main.csp");
  EXPECT_EQ(parsed.dump(),
            "script\n"
            "  module M @1:1\n"
            "    private: function f @a.csp:1:1\n"
            "      clause (1) @a.csp:1:1\n"
            "        pattern integer 0 @a.csp:1:3\n"
            "        body: integer 1 @a.csp:1:8\n"
            "      clause (1) @a.csp:2:1\n"
            "        pattern integer 1 @a.csp:2:3\n"
            "        body: integer 2 @a.csp:2:8\n");
}

}  // namespace
}  // namespace perentie::parser

// The helps: every subcommand and option explains itself, in `--help` and in docs/cli.md, and every
// example that is printed runs.
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using ::testing::HasSubstr;

std::string help_of(const std::string& subcommand) {
  std::vector<std::string> arguments = {"--help"};
  if (!subcommand.empty()) arguments.insert(arguments.begin(), subcommand);
  const Outcome outcome = perentie(arguments);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.errors, "");
  return outcome.output;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The first words of the lines between `Subcommands:` and the next empty line.
std::vector<std::string> subcommands() {
  std::vector<std::string> names;
  bool inside = false;
  for (const std::string& line : lines_of(help_of(""))) {
    if (line == "Subcommands:") {
      inside = true;
    } else if (line.empty()) {
      inside = false;
    } else if (inside && line.size() > 2 && line[2] != ' ') {
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return names;
}

// The commands after `Example:` or `Examples:`; a line that ends with \ goes on.
std::vector<std::string> examples_in(const std::string& help) {
  std::vector<std::string> examples;
  bool goes_on = false;
  for (const std::string& line : lines_of(help)) {
    if (goes_on) {
      examples.back() += "\n" + line;
    } else if (line.rfind("  perentie ", 0) == 0) {
      examples.push_back(line);
    } else {
      continue;
    }
    goes_on = line.back() == '\\';
  }
  return examples;
}

// A folder in which the examples can run as they are printed: with the corpus, `perentie` and
// `dot` on the PATH (a stand-in, Graphviz is not ours to test), and room for files.
class Workshop {
 public:
  Workshop() {
    std::filesystem::create_symlink(std::filesystem::absolute("corpus"), folder.path() / "corpus");
    std::string command = "exec";
    for (const std::string& word : perentie_command()) command += " '" + word + "'";
    program("perentie", command + " \"$@\"");
    program("dot", "grep -q digraph");
  }

  Outcome run_line(const std::string& line) const {
    const std::string path = (folder.path() / "bin").string() + ":" + std::getenv("PATH");
    return run({"bash", "-c", "set -o pipefail\n" + line},
               {.folder = folder.path(), .variables = {{"PATH", path}}});
  }

 private:
  void program(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(folder.path() / "bin");
    const std::string file = folder.file("bin/" + name, "#!/bin/sh\n" + text + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }

  TemporaryFolder folder;
};

TEST(HelpTest, EveryExampleRuns) {
  const Workshop workshop;
  std::vector<std::string> helps = subcommands();
  helps.emplace_back();
  for (const std::string& subcommand : helps) {
    const std::vector<std::string> examples = examples_in(help_of(subcommand));
    EXPECT_FALSE(examples.empty()) << subcommand;
    for (const std::string& example : examples) {
      const Outcome outcome = workshop.run_line(example);
      // A violation or counterexample that is found is a success of the example.
      const bool may_refute = example.find("perentie monitor") != std::string::npos ||
                              example.find("perentie check") != std::string::npos;
      EXPECT_TRUE(outcome.exit_code == 0 || (may_refute && outcome.exit_code == 1))
          << example << "\nexits with " << outcome.exit_code << "\n"
          << outcome.errors;
      EXPECT_THAT(outcome.errors, ::testing::Not(HasSubstr("error:")));
    }
  }
}

TEST(HelpTest, TheReferenceHasEverySubcommandAndOption) {
  const std::string reference = read_text("docs/cli.md");
  const std::regex option("--[a-z][a-z-]*");
  EXPECT_GE(subcommands().size(), 4U);
  for (const std::string& subcommand : subcommands()) {
    EXPECT_THAT(reference, HasSubstr("\n## perentie " + subcommand + "\n"));
    const std::string help = help_of(subcommand);
    for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it) {
      EXPECT_THAT(reference, HasSubstr("`" + it->str())) << "of " << subcommand;
    }
  }
}

TEST(HelpTest, TheReferenceHasEveryExitCode) {
  const std::string reference = read_text("docs/cli.md");
  for (const char* code : {"0", "1", "2", "3", "4", "5", "130"}) {
    EXPECT_THAT(reference, HasSubstr("\n| " + std::string(code) + " |"));
  }
}

}  // namespace
}  // namespace perentie::test

// perentie lts: the file that is asked for, in the format that its name implies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string rover = "corpus/rover/rover.csp";

TEST(LtsTest, WritesAutToStandardOutput) {
  const Outcome outcome = perentie({"lts", rover, "-p", "ROVER_ABORT"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output,
            "des (0,3,4)\n"
            "(0,\"move.0\",1)\n"
            "(1,\"mission_abort\",2)\n"
            "(2,\"tick\",3)\n");
  EXPECT_THAT(outcome.errors, HasSubstr("4 states, 3 transitions"));
}

TEST(LtsTest, TheNameOfTheOutputChoosesTheFormat) {
  const TemporaryFolder folder;
  const auto written = [&](const std::string& name, const std::vector<std::string>& more = {}) {
    const std::string file = (folder.path() / name).string();
    std::vector<std::string> arguments = {"-q", "lts", rover, "-p", "ROVER_SYSTEM", "-o", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = perentie(arguments);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.errors, "");
    EXPECT_EQ(outcome.output, "");
    return read_text(file);
  };
  EXPECT_THAT(written("rover.aut"), StartsWith("des (0,1028,227)\n"));
  EXPECT_THAT(written("rover.dot"), StartsWith("digraph"));
  EXPECT_TRUE(nlohmann::json::parse(written("rover.json")).is_object());
  EXPECT_THAT(written("rover.aut", {"-f", "dot"}), StartsWith("digraph"));
  EXPECT_THAT(written("named.dot", {"--state-names"}), HasSubstr("ROVER_ABORT ; ROVER_SYSTEM"));
}

TEST(LtsTest, NormalFormsHaveNoInvisibleEvents) {
  const std::string hidden = R"(ROVER_SYSTEM \ {|radiation_level|})";
  EXPECT_THAT(perentie({"lts", rover, "-p", hidden}).output, HasSubstr("\"tau\""));
  EXPECT_THAT(perentie({"lts", rover, "-p", hidden, "--tau", "i"}).output, HasSubstr("\"i\""));
  EXPECT_THAT(perentie({"lts", rover, "-p", hidden, "--normal"}).output,
              ::testing::Not(HasSubstr("tau")));
}

TEST(LtsTest, AnExhaustedBudgetWritesNothing) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "rover.aut";
  const Outcome outcome =
      perentie({"lts", rover, "-p", "ROVER_SYSTEM", "-o", file.string(), "--max-states", "3"});
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.errors, HasSubstr("inconclusive: the limit of 3 states was reached"));
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(LtsTest, ErrorsOfTheModelAndOfFiles) {
  const TemporaryFolder folder;
  EXPECT_EQ(perentie({"lts", folder.file("m.csp", "P = ("), "-p", "P"}).exit_code, 3);
  EXPECT_EQ(perentie({"lts", rover, "-p", "NOWHERE"}).exit_code, 3);
  EXPECT_EQ(perentie({"lts", rover, "-p", "1 + 1"}).exit_code, 3);
  EXPECT_EQ(perentie({"lts", (folder.path() / "missing.csp").string(), "-p", "P"}).exit_code, 5);
  const Outcome outcome =
      perentie({"lts", rover, "-p", "STOP", "-o", (folder.path() / "no/where.aut").string()});
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.errors, HasSubstr("cannot write"));
  EXPECT_EQ(perentie({"lts", rover, "-p", "STOP", "-o", "/dev/full"}).exit_code, 5);
}

}  // namespace
}  // namespace perentie::test

// Where output goes: results that cannot be written are an error, and nothing but a terminal gets
// colours.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string rover = "corpus/rover/rover.csp";

TEST(OutputTest, AFullDeviceIsAnErrorOfEverySubcommand) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"monitor", "corpus/rover/pass.yaml"},
        {"monitor", "corpus/rover/red_ignored.yaml", "--format", "json"},
        {"lts", rover, "-p", "ROVER_SYSTEM"},
        {"eval", rover, "-e", "Events"},
        {"dump", rover},
        {"--help"},
        {"lts", "--help"},
        {"--version"}}) {
    SCOPED_TRACE(arguments.front());
    const Outcome outcome = perentie(arguments, {.output_file = "/dev/full"});
    EXPECT_EQ(outcome.exit_code, 5);
    EXPECT_THAT(outcome.errors, HasSubstr("standard output could not be written"));
  }
}

TEST(OutputTest, OnlyATerminalGetsColours) {
  const std::vector<std::string> wrong = {"eval", rover, "-e", "nowhere"};
  EXPECT_THAT(perentie(wrong, {.variables = {{"TERM", "xterm-256color"}}}).errors,
              Not(HasSubstr("\033")));
  EXPECT_THAT(perentie({"--color", "always", "eval", rover, "-e", "nowhere"}).errors,
              HasSubstr("\033["));
}

// script(1) runs a command on a terminal of its own.
std::string on_a_terminal(const std::string& no_colour) {
  std::string command;
  for (const std::string& word : perentie_command()) command += "'" + word + "' ";
  command += "eval " + rover + " -e nowhere";
  return run({"script", "--quiet", "--command", command, "/dev/null"},
             {.variables = {{"TERM", "xterm"}, {"NO_COLOR", no_colour}}})
      .output;
}

TEST(OutputTest, NoColorIsHonouredOnATerminal) {
  if (run({"sh", "-c", "command -v script"}).exit_code != 0) {
    GTEST_SKIP() << "script(1) is not installed";
  }
  EXPECT_THAT(on_a_terminal(""), HasSubstr("\033["));
  const std::string plain = on_a_terminal("1");
  EXPECT_THAT(plain, HasSubstr("not in scope"));
  EXPECT_THAT(plain, Not(HasSubstr("\033[")));
}

TEST(OutputTest, QuietSilencesNotesButNotErrors) {
  EXPECT_EQ(perentie({"-q", "lts", rover, "-p", "STOP"}).errors, "");
  EXPECT_THAT(perentie({"-q", "lts", rover, "-p", "NOWHERE"}).errors, HasSubstr("not in scope"));
}

}  // namespace
}  // namespace perentie::test

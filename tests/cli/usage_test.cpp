// The command line when it is wrong: exit code 2, a sentence, and nothing on standard output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Wrong {
  std::vector<std::string> arguments;
  std::string message;
};

TEST(UsageTest, WrongCommandLines) {
  const std::string rover = "corpus/rover/rover.csp";
  for (const Wrong& wrong : {
           Wrong{{}, "a subcommand is needed"},
           {{"chekc"}, "no subcommand `chekc`"},
           {{"monitor", "--no-such-option"}, "--no-such-option"},
           {{"monitor", "corpus/rover/pass.yaml", "--mode", "lax"}, "--mode: lax not in"},
           {{"monitor", "corpus/rover/pass.yaml", "--format", "xml"}, "--format: xml not in"},
           {{"lts", rover}, "--process says which one is meant"},
           {{"lts", "-p", "STOP"}, "FILE is required"},
           {{"lts", rover, "-p", "STOP", "--max-states", "many"}, "`many` is not a positive"},
           {{"lts", rover, "-p", "STOP", "--max-states", "0"}, "`0` is not a positive"},
           {{"lts", rover, "-p", "STOP", "--timeout", "-1"}, "`-1` is not a positive"},
           {{"lts", rover, "-p", "STOP", "-f", "svg"}, "--format: svg not in"},
           {{"dump", rover, "--phase", "soup"}, "--phase: soup not in"},
       }) {
    const Outcome outcome = perentie(wrong.arguments);
    SCOPED_TRACE(outcome.errors);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.errors, StartsWith("perentie: error: "));
    EXPECT_THAT(outcome.errors, HasSubstr(wrong.message));
    EXPECT_EQ(outcome.output, "");
  }
}

TEST(UsageTest, Version) {
  const Outcome outcome = perentie({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, StartsWith("perentie "));
  EXPECT_EQ(outcome.errors, "");
}

}  // namespace
}  // namespace perentie::test

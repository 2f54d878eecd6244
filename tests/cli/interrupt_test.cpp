// Ctrl-C while a model is explored: the program ends by itself, says so, and exits with 130.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using ::testing::HasSubstr;

const std::string endless = "channel up\nCOUNT(n) = up -> COUNT(n + 1)\n";

TEST(InterruptTest, ExplorationEndsWithoutAFile) {
  const TemporaryFolder folder;
  const auto model = folder.path() / "pipe";
  const auto file = folder.path() / "count.aut";
  const Outcome outcome = interrupted_perentie(
      {"lts", model.string(), "-p", "COUNT(0)", "-o", file.string(), "--timeout", "60"}, model,
      endless, 300);
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_THAT(outcome.errors, HasSubstr("the run was interrupted"));
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(InterruptTest, MonitoringEndsWithoutAVerdict) {
  const TemporaryFolder folder;
  const auto model = folder.path() / "pipe";
  const Outcome outcome =
      interrupted_perentie({"monitor", "--model", model.string(), "--process", "COUNT(0)",
                            "--trace", folder.file("trace", "up\n"), "--timeout", "60"},
                           model, endless, 300);
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_THAT(outcome.output, HasSubstr("INCONCLUSIVE"));
  EXPECT_THAT(outcome.output, HasSubstr("the run was interrupted"));
}

}  // namespace
}  // namespace perentie::test

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

TEST(InterruptTest, AViolationOnALivePipeIsReportedAtOnce) {
  const TemporaryFolder folder;
  const auto trace = folder.path() / "pipe";
  const std::string model = folder.file("model.csp", "channel a, b\nP = a -> b -> P\n");
  const Outcome outcome = interrupted_perentie(
      {"monitor", "--model", model, "--process", "P", "--trace", trace.string()}, trace, "a\na\n",
      2'000, PipeEnd::open, SIGKILL);
  EXPECT_EQ(outcome.exit_code, 1) << "it did not wait to be killed";
  EXPECT_THAT(outcome.output, HasSubstr("VIOLATION"));
}

TEST(InterruptTest, WaitingForALivePipeEndsWithAReport) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    const auto trace = folder.path() / "pipe";
    const std::string model = folder.file("model.csp", "channel a, b\nP = a -> b -> P\n");
    const Outcome outcome = interrupted_perentie(
        {"monitor", "--model", model, "--process", "P", "--trace", trace.string()}, trace,
        "a\nb\na\n", 500, PipeEnd::open, signal);
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_THAT(outcome.output, HasSubstr("INCONCLUSIVE"));
    EXPECT_THAT(outcome.output, HasSubstr("3 events"));
    EXPECT_THAT(outcome.errors, HasSubstr("interrupted"));
  }
}

TEST(InterruptTest, WhatWasDecidedIsWritten) {
  const TemporaryFolder folder;
  const auto model = folder.path() / "pipe";
  const Outcome outcome =
      interrupted_perentie({"refines", "-b", "-q", "-f", "plain", model.string()}, model,
                           endless + "assert STOP [T= STOP\nassert COUNT(0) :[divergence free]\n",
                           1'000, PipeEnd::closed, SIGTERM);
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_THAT(outcome.output, HasSubstr("STOP [T= STOP: Passed"));
  EXPECT_THAT(outcome.output, HasSubstr("Inconclusive"));
  EXPECT_THAT(outcome.errors, HasSubstr("the run was interrupted"));
}

}  // namespace
}  // namespace perentie::test

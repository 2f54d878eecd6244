// perentie monitor where something is missing, broken or at its end: the message, the exit code,
// and that what was checked before is not lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string rover = "corpus/rover/rover.csp";

class MonitorTest : public ::testing::Test {
 protected:
  Outcome monitor(const std::string& process, const std::string& trace,
                  const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"monitor", "--model", rover,      "--process", process,
                                          "--trace", trace,     "--format", "json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return perentie(arguments);
  }
  // The rover on a trace of this text.
  Outcome on(const std::string& text, const std::vector<std::string>& more = {}) const {
    return monitor("ROVER_SYSTEM", folder.file("trace", text), more);
  }

  TemporaryFolder folder;
};

TEST_F(MonitorTest, AnEmptyTraceConforms) {
  const Outcome outcome = on("");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const json report = json::parse(outcome.output);
  EXPECT_EQ(report["verdict"], "conforms");
  EXPECT_EQ(report["events_total"], 0);
  EXPECT_EQ(report["event"], nullptr);
  EXPECT_EQ(report["permitted_next"], json({"mission_start"}));
}

TEST_F(MonitorTest, ATraceMayEndWhereTheModelCouldGoOn) {
  const Outcome outcome = on("mission_start\nmove.0\ninspect.1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const json report = json::parse(outcome.output);
  EXPECT_EQ(report["verdict"], "conforms");
  EXPECT_EQ(report["events_checked"], 3);
  EXPECT_EQ(report["permitted_next"], json({"move.1", "radiation_level.Green",
                                            "radiation_level.Orange", "radiation_level.Red"}));
}

TEST_F(MonitorTest, NoEventIsPermittedAfterTermination) {
  const std::string trace = folder.file("trace", "move.0\nmission_abort\nmove.0\n");
  const Outcome outcome = monitor("ROVER_ABORT", trace);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
  const json report = json::parse(outcome.output);
  EXPECT_EQ(report["events_checked"], 3);
  EXPECT_EQ(report["event"], "move.0");
  EXPECT_EQ(report["expected"], json({"✓"}));
}

TEST_F(MonitorTest, AnUnknownEventIsAViolationInStrictModeOnly) {
  EXPECT_EQ(on("mission_start\nlunch\n").exit_code, 0);
  const Outcome strict = on("mission_start\nlunch\n", {"--mode", "strict"});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_EQ(json::parse(strict.output)["event_in_alphabet"], false);
}

TEST_F(MonitorTest, TheTraceMayComeFromStandardInput) {
  const Outcome outcome =
      perentie({"monitor", "--model", rover, "--process", "ROVER_SYSTEM", "--trace", "-"},
               {.input = "mission_start\nmission_complete\n"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("mission_complete, number 2"));
}

TEST_F(MonitorTest, HiddenChannelsAreNotWaitedFor) {
  EXPECT_EQ(on("mission_start\nmove.0\n", {"--alphabet", "mission_start,move"}).exit_code, 0);
  EXPECT_EQ(on("mission_start\nmission_start\n", {"--alphabet", "mission_start"}).exit_code, 0);
  EXPECT_EQ(on("mission_start\nmission_start\n").exit_code, 1);
}

TEST_F(MonitorTest, ACutOffTraceIsInconclusiveAndKeepsWhatWasChecked) {
  const Outcome outcome = on("{\"event\": \"mission_start\"}\n{\"event\": \"move.");
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.errors, HasSubstr("trace:2:"));
  EXPECT_THAT(outcome.errors, HasSubstr("cut off"));
  const json report = json::parse(outcome.output);
  EXPECT_EQ(report["verdict"], "inconclusive");
  EXPECT_EQ(report["events_checked"], 1);
  EXPECT_EQ(report["event"], "mission_start");
}

TEST_F(MonitorTest, AViolationBeforeTheBrokenPlaceIsStillAViolation) {
  const Outcome outcome = on("{\"event\": \"move.1\"}\n{\"event\": \"move.");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(json::parse(outcome.output)["event"], "move.1");
  EXPECT_THAT(outcome.errors, HasSubstr("trace:2:"));
}

TEST_F(MonitorTest, ABinaryFileIsNoTrace) {
  const Outcome outcome = on(std::string("\0\1\xFF\xFE\0rubbish\x80", 13));
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.errors, HasSubstr("it is a binary file"));
  EXPECT_EQ(outcome.output, "");
}

TEST_F(MonitorTest, FilesThatCannotBeRead) {
  const std::string missing = (folder.path() / "missing").string();
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"monitor", missing},
        {"monitor", folder.path().string()},
        {"monitor", "--model", missing, "--process", "P", "--trace", missing},
        {"monitor", "--model", rover, "--process", "ROVER_SYSTEM", "--trace", missing},
        {"monitor", "corpus/rover/pass.yaml", "--map", missing},
        {"monitor", "corpus/rover/pass.yaml", "--mapping", missing}}) {
    const Outcome outcome = perentie(arguments);
    SCOPED_TRACE(outcome.errors);
    EXPECT_EQ(outcome.exit_code, 5);
    EXPECT_THAT(outcome.errors, HasSubstr("cannot read"));
    EXPECT_THAT(outcome.errors, HasSubstr(folder.path().string()));
    EXPECT_EQ(outcome.output, "");
  }
}

TEST_F(MonitorTest, AConfigurationThatNamesAMissingFile) {
  const std::string config =
      folder.file("config.yaml", "model: missing.csp\nmain_process: P\ntrace_file: trace\n");
  const Outcome outcome = perentie({"monitor", config});
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.errors, HasSubstr("missing.csp"));
}

TEST_F(MonitorTest, AConfigurationThatIsNoYaml) {
  const Outcome outcome = perentie({"monitor", folder.file("config.yaml", "model: [")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("this is not YAML"));
}

TEST_F(MonitorTest, NothingToMonitor) {
  const Outcome nothing = perentie({"monitor"});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.errors, HasSubstr("a model (--model"));
  const Outcome no_trace = perentie({"monitor", "--model", rover, "--process", "ROVER_SYSTEM"});
  EXPECT_EQ(no_trace.exit_code, 2);
  EXPECT_THAT(no_trace.errors, HasSubstr("a trace (--trace"));
}

TEST_F(MonitorTest, AProcessThatTheModelDoesNotHave) {
  const Outcome outcome = monitor("ROVER_SYTEM", folder.file("trace", ""));
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.errors, HasSubstr("`ROVER_SYTEM` is not in scope"));
  EXPECT_THAT(outcome.errors, HasSubstr("did you mean `ROVER_SYSTEM`?"));
  EXPECT_EQ(outcome.output, "");
}

TEST_F(MonitorTest, TheConfigurationIsNamedForAProcessThatIsMissing) {
  folder.file("trace", "");
  folder.file("m.csp", "channel a\nP = a -> P\n");
  const Outcome outcome = perentie(
      {"monitor", folder.file("c.yaml", "model: m.csp\nmain_process: Q\ntrace_file: trace\n")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.errors, HasSubstr("c.yaml (main_process)"));
}

TEST_F(MonitorTest, AChannelOfTheCommonAlphabetThatTheModelDoesNotHave) {
  folder.file("trace", "");
  folder.file("m.csp", "channel start\nP = start -> P\n");
  const Outcome outcome =
      perentie({"monitor", folder.file("c.yaml",
                                       "model: m.csp\nmain_process: P\ntrace_file: trace\n"
                                       "alphabet: [start]\ncommon_alphabet: [starts]\n")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("c.yaml:5:19"));
  EXPECT_THAT(outcome.errors, HasSubstr("the model has no channel `starts`"));
  EXPECT_THAT(outcome.errors, HasSubstr("did you mean `start`?"));
}

TEST_F(MonitorTest, AnExhaustedBudgetIsNoVerdict) {
  const Outcome states = on("mission_start\n", {"--max-states", "3"});
  EXPECT_EQ(states.exit_code, 4);
  const json report = json::parse(states.output);
  EXPECT_EQ(report["verdict"], "inconclusive");
  EXPECT_THAT(report["reason"].get<std::string>(), HasSubstr("the limit of 3 states"));
  EXPECT_EQ(report["events_checked"], 0);

  const std::string endless = folder.file("m.csp", "channel a : Int\nP(n) = a.n -> P(n + 1)\n");
  const Outcome time = perentie({"monitor", "--model", endless, "--process", "P(0)", "--trace",
                                 folder.file("t", "a.0\n"), "--timeout", "0.2"});
  EXPECT_EQ(time.exit_code, 4);
  EXPECT_THAT(time.output, HasSubstr("INCONCLUSIVE"));
  EXPECT_THAT(time.output, HasSubstr("time limit"));
}

TEST_F(MonitorTest, TheDeterminismGateCanBeRequired) {
  folder.file("m.csp", "channel a, b, h\nP = h -> a -> STOP [] h -> b -> STOP\n");
  folder.file("trace", "a\n");
  const std::string config = folder.file("c.yaml",
                                         "model: m.csp\nmain_process: P\ntrace_file: trace\n"
                                         "alphabet: [a, b, h]\ncommon_alphabet: [a, b]\n");
  EXPECT_EQ(perentie({"monitor", config}).exit_code, 0);
  EXPECT_THAT(perentie({"monitor", config}).errors, HasSubstr("determinism gate"));
  EXPECT_EQ(perentie({"monitor", config, "--determinism", "ignore"}).errors, "");
  EXPECT_EQ(perentie({"monitor", config, "--determinism", "require"}).exit_code, 4);
}

}  // namespace
}  // namespace perentie::test

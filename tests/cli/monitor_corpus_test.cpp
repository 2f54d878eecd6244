// The rover of corpus/rover, through the program: the paper's four experiments.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using nlohmann::json;

TEST(MonitorCorpusTest, EveryExperimentAnswersAsExpected) {
  const json expected = json::parse(std::ifstream("corpus/rover/expected.json"));
  ASSERT_EQ(expected.size(), 4U);
  for (const json& row : expected) {
    const std::string config = "corpus/rover/" + row["config"].get<std::string>();
    SCOPED_TRACE(config);
    const Outcome outcome = perentie({"monitor", config, "--format", "json"});
    EXPECT_EQ(outcome.exit_code, row["verdict"] == "conforms" ? 0 : 1);
    EXPECT_EQ(outcome.errors, "");
    const json report = json::parse(outcome.output);
    for (const char* key : {"verdict", "events_checked", "events_total", "event", "expected"}) {
      EXPECT_EQ(report[key], row[key]) << key;
    }
  }
}

TEST(MonitorCorpusTest, TheReportIsOneObjectOfTheSchemaOnOneLine) {
  const Outcome outcome =
      perentie({"monitor", "corpus/rover/red_ignored.yaml", "--format", "json"});
  EXPECT_EQ(outcome.output.find('\n'), outcome.output.size() - 1);
  const auto report = nlohmann::ordered_json::parse(outcome.output);
  std::vector<std::string> keys;
  for (const auto& item : report.items()) keys.push_back(item.key());
  EXPECT_EQ(keys, (std::vector<std::string>{"schema",
                                            "verdict",
                                            "reason",
                                            "events_checked",
                                            "events_total",
                                            "events_ignored",
                                            "note",
                                            "event",
                                            "event_in_alphabet",
                                            "expected",
                                            "permitted_next",
                                            "line",
                                            "column",
                                            "source",
                                            "model_position",
                                            "ignored",
                                            "name",
                                            "model",
                                            "process",
                                            "trace",
                                            "mode",
                                            "states",
                                            "transitions",
                                            "synthesis_seconds",
                                            "checking_seconds"}));
  EXPECT_EQ(report["schema"], "perentie.monitor/1");
  EXPECT_EQ(report["reason"], nullptr);
  EXPECT_EQ(report["line"], 56);
  EXPECT_EQ(report["column"], 1);
  EXPECT_EQ(json::parse(report["source"].get<std::string>())["target"]["name"], "WP1");
  EXPECT_EQ(report["model_position"].dump(), R"(["ROVER_ABORT ; ROVER_SYSTEM"])");
  EXPECT_EQ(report["name"], "rover_red_ignored");
  EXPECT_EQ(report["mode"], "permissive");
  EXPECT_EQ(report["states"], 227);
  EXPECT_EQ(report["transitions"], 1028);
  EXPECT_GT(report["synthesis_seconds"], 0.0);
  EXPECT_GT(report["checking_seconds"], 0.0);
}

TEST(MonitorCorpusTest, TheTextSaysWhatHappenedAndWhatWasPermitted) {
  const Outcome outcome = perentie({"monitor", "corpus/rover/red_ignored.yaml"});
  EXPECT_EQ(outcome.output,
            "VIOLATION: ROVER_SYSTEM does not permit the trace corpus/rover/red_ignored.jsonl\n"
            "  event      move.1, number 51: the model does not permit it here\n"
            "  at         corpus/rover/red_ignored.jsonl:56:1\n"
            "             {\"stamp\": 25.5, \"topic\": \"/drive/target\", \"target\": {\"name\": "
            "\"WP1\", \"x\": 4.0, \"y\": 1.5}}\n"
            "  permitted  move.0\n"
            "  model at   ROVER_ABORT ; ROVER_SYSTEM\n"
            "  checked    51 of 243 events, permissive mode\n");
}

TEST(MonitorCorpusTest, OptionsWinOverTheConfiguration) {
  const Outcome outcome =
      perentie({"monitor", "corpus/rover/pass.yaml", "--trace", "corpus/rover/red_ignored.jsonl",
                "--mode", "strict", "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const json report = json::parse(outcome.output);
  EXPECT_EQ(report["event"], "move.1");
  EXPECT_EQ(report["mode"], "strict");
}

TEST(MonitorCorpusTest, PathsInAConfigurationAreRelativeToIt) {
  const auto root = std::filesystem::current_path();
  const TemporaryFolder elsewhere;
  const Outcome outcome = perentie({"monitor", (root / "corpus/rover/pass.yaml").string()},
                                   {.folder = elsewhere.path()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
}

}  // namespace
}  // namespace perentie::test

// The paper's case study from config and trace to verdict, on models built by hand
// (rover_models.hpp): our corpus always, the recorded runs of Varanus where their data is.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "perentie/monitor/report.hpp"
#include "perentie/monitor/varanus_config.hpp"
#include "perentie/test/paths.hpp"
#include "rover_models.hpp"
#include "support.hpp"

namespace perentie::monitor {
namespace {

nlohmann::json read_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

// Runs a config against a model that stands for the one that it names.
RunResult run_config(const std::filesystem::path& path, const lts::Lts& process) {
  Sink sink;
  const auto config = load_varanus_config(path, sink.sources, sink.diagnostics);
  EXPECT_TRUE(config) << sink.text();
  TraceSetup setup{.mapping = "varanus-rover", .fallback = "simple"};
  if (config->mapping) setup = {.mapping = config->mapping->value};
  TestTrace trace = TestTrace::from_file(config->trace_file->value, setup);
  const MonitorModel model = make_monitor_model(lts::normalise(process).normal);
  RunResult result = run_trace(trace.stream(), model, config->mode);
  EXPECT_EQ(trace.diagnostics(), "");
  return result;
}

TEST(RoverTest, OurCorpusComesOutAsExpected) {
  const auto folder = test::corpus() / "rover";
  const auto rows = read_json(folder / "expected.json");
  ASSERT_EQ(rows.size(), 4U);
  for (const auto& row : rows) {
    const std::string config = row["config"];
    SCOPED_TRACE(config);
    const RunResult result = run_config(folder / config, paper_rover());
    const auto json = nlohmann::json::parse(to_json(result, {}));
    for (const auto& [key, value] : row.items()) {
      if (key == "config") continue;
      EXPECT_EQ(json[key], value) << key;
    }
    EXPECT_EQ(result.events_ignored, 0U);
  }
}

TEST(RoverTest, TheTracesAreTheEventsThatTheReadmeSays) {
  const auto events_of = [](const char* file, const char* mapping) {
    TestTrace trace = TestTrace::from_file(test::corpus() / "rover" / file, {.mapping = mapping});
    return trace.events();
  };
  const std::string mapping = test::corpus() / "rover/robot_log.yaml";
  const std::vector<std::string> pass = events_of("pass.jsonl", mapping.c_str());
  ASSERT_EQ(pass.size(), 243U);
  EXPECT_EQ(pass[0], "mission_start");
  EXPECT_EQ(pass[2], "move.0");
  EXPECT_EQ(pass[242], "mission_complete");

  std::vector<std::string> red = pass;
  red[49] = "radiation_level.Red";
  EXPECT_EQ(events_of("red_ignored.jsonl", mapping.c_str()), red);
  std::vector<std::string> swapped = pass;
  std::swap(swapped[48], swapped[50]);
  EXPECT_EQ(events_of("swapped.jsonl", "simple"), swapped);
  std::vector<std::string> mismatch = pass;
  mismatch[120] = "move.5";
  EXPECT_EQ(events_of("mismatch.jsonl", "simple"), mismatch);
}

TEST(RoverTest, TheRecordedRunsOfVaranusComeOutExactly) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  int rows = 0;
  for (const auto& row : read_json(data / "varanus/recorded-verdicts.json")) {
    const std::string config = row["config"];
    // The RoboChart rows need that model itself.
    if (config.find("config_rover_") == std::string::npos) continue;
    SCOPED_TRACE(config);
    const RunResult result = run_config(data / "varanus" / config, journal_rover());
    const bool violation = row["verdict"] == "violation";
    EXPECT_EQ(result.verdict == RunVerdict::violation, violation);
    EXPECT_EQ(result.events_checked, row["events_checked"]);
    EXPECT_EQ(result.events_total, 233U);
    EXPECT_EQ(result.event, row["last_event"]);
    if (violation) {
      EXPECT_EQ(nlohmann::json(result.permitted), row["permissible"]);
    }
    ++rows;
  }
  EXPECT_EQ(rows, 5);
}

}  // namespace
}  // namespace perentie::monitor

// The verdicts that FDR and Varanus gave on the case studies of others, recorded from real runs.
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "perentie/test/paths.hpp"
#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using nlohmann::json;

void expect_recorded_verdict(const std::filesystem::path& data, const std::string& name) {
  const json rows = json::parse(std::ifstream(data / "varanus/recorded-verdicts.json"));
  const std::string config = "oracles/inspection-rover-ras/" + name;
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const json& r) { return r["config"] == config; });
  ASSERT_NE(row, rows.end());
  const Outcome outcome =
      perentie({"monitor", (data / "varanus" / config).string(), "--format", "json"});
  const bool passes = (*row)["verdict"] == "pass";
  ASSERT_EQ(outcome.exit_code, passes ? 0 : 1) << outcome.errors;
  const json report = json::parse(outcome.output);
  EXPECT_EQ(report["verdict"], passes ? "conforms" : "violation");
  EXPECT_EQ(report["events_checked"], (*row)["events_checked"]);
  EXPECT_EQ(report["event"], (*row)["last_event"]);
  EXPECT_EQ(report["expected"].get<std::set<std::string>>(),
            (*row)["permissible"].get<std::set<std::string>>());
}

class RecordedVerdictTest : public ::testing::TestWithParam<const char*> {};

TEST_P(RecordedVerdictTest, ComesOutExactly) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  expect_recorded_verdict(data, GetParam());
}

// The other three RoboChart rows are this model with other traces: seconds each, and no news.
INSTANTIATE_TEST_SUITE_P(
    Varanus, RecordedVerdictTest,
    ::testing::Values("config_rover_pass.yaml", "config_rover_pass_normal.yaml",
                      "config_rover_fail_safety.yaml", "config_rover_fail_ordering.yaml",
                      "config_rover_fail_param_mismatch.yaml", "config_robochart_pass.yaml"));

}  // namespace
}  // namespace perentie::test

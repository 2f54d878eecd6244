// The traces that Varanus ships: each is read, or refused for a reason that is written here.
#include <gtest/gtest.h>

#include <map>

#include "perentie/test/paths.hpp"
#include "support.hpp"

namespace perentie::monitor {
namespace {

namespace fs = std::filesystem;

const TraceSetup varanus_rule{.mapping = "varanus-rover", .fallback = "simple"};

// How the README's four experiments and its pass trace look: 233 events, and the events at which
// the recorded runs of Varanus stopped.
struct RoverTrace {
  const char* file;
  std::size_t stop;        // the event, counted from 1
  const char* stop_event;  // as Varanus recorded it
};

const RoverTrace rover_traces[] = {
    {"trace-json-pass.txt", 233, "radiation_level.Green"},
    {"trace-json-fail-safety.txt", 74, "move.1"},
    {"trace-json-fail-message-order.txt", 100, "inspect.2"},
    {"trace-json-fail-param-mismatch.txt", 92, "arrived_at.3"},
};

TEST(VaranusTracesTest, TheRoverTracesGiveTheRecordedEvents) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  for (const RoverTrace& trace : rover_traces) {
    const fs::path path = data / "varanus/oracles/inspection-rover-ras" / trace.file;
    TestTrace test = TestTrace::from_file(path, varanus_rule);
    const std::vector<std::string> events = test.events();
    EXPECT_EQ(test.diagnostics(), "");
    ASSERT_EQ(events.size(), 233U) << trace.file;
    EXPECT_EQ(events.front(), "radiation_level.Green");
    EXPECT_EQ(events.back(), "radiation_level.Green");
    EXPECT_EQ(events[trace.stop - 1], trace.stop_event) << trace.file;
  }
}

TEST(VaranusTracesTest, TheRoverTracesGoThroughTheEventMap) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  const fs::path folder = data / "varanus/oracles/inspection-rover-ras";
  TraceSetup setup = varanus_rule;
  setup.event_map = {
      {"Green", "Radiation_Green"}, {"Red", "Radiation_Red"}, {"Orange", "Radiation_Orange"}};
  TestTrace test = TestTrace::from_file(folder / "trace-json-fail-safety.txt", setup);
  std::map<std::string, int> levels;
  for (const std::string& event : test.events()) {
    if (event.starts_with("radiation_level.")) ++levels[event];
  }
  EXPECT_EQ(levels.size(), 2U);
  EXPECT_GT(levels["radiation_level.Radiation_Green"], 100);
  EXPECT_GT(levels["radiation_level.Radiation_Orange"], 0);
}

// Traces that are refused, and the reason that is given. All others of the data must be read to
// their end.
const std::map<std::string, std::string> refused = {
    {"log-json-good.txt", "this is how Python prints a dictionary"},
    // Copied from a terminal: after 188 events there is a prompt with a command.
    {"log-events-good.txt", ":189:52: error: this is not an event"},
    {"trace-events-good.txt", ":189:52: error: this is not an event"},
};

// Snapshots of all variables instead of messages; a mapping for them comes with a later stage.
bool is_snapshot_trace(const fs::path& path) {
  const std::string folder = path.parent_path().filename();
  return folder == "mascot-test" || folder == "scenarios";
}

bool is_trace(const fs::path& path) {
  const std::string name = path.filename();
  if (path.extension() != ".json" && path.extension() != ".txt") return false;
  return !name.ends_with("event_map.json") && name != "recorded-verdicts.json" &&
         name != "checks_assertions.json";
}

TEST(VaranusTracesTest, EveryTraceIsReadOrRefusedForAReason) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  std::size_t read = 0;
  std::size_t with_reason = 0;
  for (const auto& entry : fs::recursive_directory_iterator(data / "varanus")) {
    if (!is_trace(entry.path())) continue;
    TestTrace test = TestTrace::from_file(entry.path(), varanus_rule);
    const std::vector<std::string> events = test.events();
    const auto reason = refused.find(entry.path().filename());
    if (is_snapshot_trace(entry.path())) {
      EXPECT_NE(test.diagnostics().find("the message has no `topic`"), std::string::npos)
          << entry.path();
      ++with_reason;
    } else if (reason != refused.end()) {
      EXPECT_NE(test.diagnostics().find(reason->second), std::string::npos) << test.diagnostics();
      ++with_reason;
    } else {
      EXPECT_EQ(test.diagnostics(), "") << entry.path();
      EXPECT_FALSE(events.empty()) << entry.path();
      ++read;
    }
  }
  EXPECT_GE(read, 50U);
  EXPECT_GE(with_reason, 15U);
}

TEST(VaranusTracesTest, CountsOfOtherFormats) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  const std::pair<const char*, std::size_t> traces[] = {
      {"mascot-test/scenario-traces/scenario0-10-trace.json", 11},
      {"oracles/inspection-rover-ras/log-events-good.txt", 188},
      {"oracles/inspection-rover-taros/log.json", 243},
      {"oracles/mascot-model/rosmon-mascot-pass.json", 10},
      {"rosmon-test/hello_goodbye.json", 2},
  };
  for (const auto& [file, count] : traces) {
    TestTrace test = TestTrace::from_file(data / "varanus" / file, varanus_rule);
    EXPECT_EQ(test.events().size(), count) << file;
  }
}

}  // namespace
}  // namespace perentie::monitor

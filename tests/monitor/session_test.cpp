// Whole traces: the verdict and all that goes with it.
#include "perentie/monitor/session.hpp"

#include <gtest/gtest.h>

#include "support.hpp"

namespace perentie::monitor {
namespace {

using Texts = std::vector<std::string>;

// mission_start -> (move.1 -> mission_complete -> SKIP [] stop -> SKIP)
const char* const mission =
    "0 mission_start 1; 1 move.1 2; 2 mission_complete 3; 3 tick 4; 1 stop 3";

RunResult run(const MonitorModel& model, const std::string& trace, Mode mode,
              std::string* diagnostics = nullptr) {
  TestTrace test(trace);
  RunResult result = run_trace(test.stream(), model, mode);
  if (diagnostics != nullptr) *diagnostics = test.diagnostics();
  return result;
}

TEST(SessionTest, ATraceThatConforms) {
  const MonitorModel model = model_from(mission);
  const RunResult result = run(model, "mission_start\nmove.1\n", Mode::strict);
  EXPECT_EQ(result.verdict, RunVerdict::conforms);
  EXPECT_EQ(result.events_checked, 2U);
  EXPECT_EQ(result.events_total, 2U);
  EXPECT_EQ(result.event, "move.1");
  EXPECT_EQ(result.place, (TracePlace{2, 1}));
  EXPECT_EQ(result.permitted, Texts{"mission_complete"});
  EXPECT_EQ(result.model_states, std::vector<lts::State>{lts::State{2}});
}

TEST(SessionTest, ATraceMayEndAnywhereAndMayBeEmpty) {
  const MonitorModel model = model_from(mission);
  for (const char* empty : {"", "\n\n", "[]"}) {
    const RunResult result = run(model, empty, Mode::strict);
    EXPECT_EQ(result.verdict, RunVerdict::conforms);
    EXPECT_EQ(result.events_checked, 0U);
    EXPECT_EQ(result.events_total, 0U);
    EXPECT_EQ(result.event, "");
    EXPECT_EQ(result.permitted, Texts{"mission_start"});
  }
}

TEST(SessionTest, AViolationSaysWhatWasPermitted) {
  const MonitorModel model = model_from(mission);
  const RunResult result =
      run(model, "mission_start\nmission_complete\nmove.1\nmove.1\n", Mode::permissive);
  EXPECT_EQ(result.verdict, RunVerdict::violation);
  EXPECT_EQ(result.events_checked, 2U);
  EXPECT_EQ(result.events_total, 4U);
  EXPECT_EQ(result.event, "mission_complete");
  EXPECT_TRUE(result.event_in_alphabet);
  EXPECT_EQ(result.place, (TracePlace{2, 1}));
  EXPECT_EQ(result.source, "mission_complete");
  EXPECT_EQ(result.permitted, (Texts{"move.1", "stop"}));
  EXPECT_EQ(result.model_states, std::vector<lts::State>{lts::State{1}});
}

TEST(SessionTest, TerminationIsPermittedWhereTheModelMayTerminate) {
  const MonitorModel model = model_from(mission);
  const RunResult before = run(model, "mission_start\nstop\nstop\n", Mode::strict);
  EXPECT_EQ(before.permitted, Texts{"✓"});
  EXPECT_EQ(run(model, "mission_start\nstop\n✓\n", Mode::strict).verdict, RunVerdict::conforms);
  const RunResult after = run(model, "mission_start\nstop\ntick\nstop\n", Mode::permissive);
  EXPECT_EQ(after.verdict, RunVerdict::violation);
  EXPECT_EQ(after.events_checked, 4U);
  EXPECT_EQ(after.permitted, Texts{});
}

TEST(SessionTest, EventsOutsideTheAlphabet) {
  const MonitorModel model = model_from(mission);
  const std::string trace = "noise\nmission_start\nmove. 2\nnoise\nmove.1\n";
  const RunResult permissive = run(model, trace, Mode::permissive);
  EXPECT_EQ(permissive.verdict, RunVerdict::conforms);
  EXPECT_EQ(permissive.events_checked, 5U);
  EXPECT_EQ(permissive.events_ignored, 3U);
  EXPECT_EQ(permissive.ignored,
            (std::map<std::string, std::uint64_t>{{"move.2", 1}, {"noise", 2}}));
  const RunResult strict = run(model, "mission_start\nmove. 2\n", Mode::strict);
  EXPECT_EQ(strict.verdict, RunVerdict::violation);
  EXPECT_EQ(strict.event, "move.2");
  EXPECT_FALSE(strict.event_in_alphabet);
  EXPECT_EQ(strict.similar, Texts{"move.1"});
}

TEST(SessionTest, TheKindsOfIgnoredEventsKeptAreLimited) {
  const MonitorModel model = model_from(mission);
  std::string trace;
  for (int i = 0; i < 1000; ++i) trace += "noise." + std::to_string(i) + "\n";
  const RunResult result = run(model, trace, Mode::permissive);
  EXPECT_EQ(result.events_ignored, 1000U);
  EXPECT_EQ(result.ignored.size(), RunResult::max_ignored_names);
}

TEST(SessionTest, BadInputAfterGoodEventsIsInconclusive) {
  const MonitorModel model = model_from(mission);
  std::string diagnostics;
  const RunResult result =
      run(model, "{\"event\":\"mission_start\"}\n{\"event\":\"move.1\"}\n{\"event\":", Mode::strict,
          &diagnostics);
  EXPECT_EQ(result.verdict, RunVerdict::inconclusive);
  EXPECT_EQ(result.events_checked, 2U);
  EXPECT_EQ(result.events_total, std::nullopt);
  EXPECT_EQ(result.event, "move.1");
  EXPECT_NE(diagnostics.find("trace:3:10: error: the message is cut off"), std::string::npos)
      << diagnostics;
}

TEST(SessionTest, BadInputAfterAViolationDoesNotChangeTheVerdict) {
  const MonitorModel model = model_from(mission);
  std::string diagnostics;
  const RunResult result =
      run(model, "{\"event\":\"stop\"}\n{\"event\":\"move.1\"}\n{]\n", Mode::strict, &diagnostics);
  EXPECT_EQ(result.verdict, RunVerdict::violation);
  EXPECT_EQ(result.events_checked, 1U);
  EXPECT_EQ(result.events_total, std::nullopt);
  EXPECT_NE(diagnostics, "");
}

TEST(SessionTest, OneMessageOfSeveralEventsIsCheckedEventByEvent) {
  const MonitorModel model = model_from("0 speed.1 1; 1 speed_ok 0");
  TestTrace test(
      "{\"topic\":\"v\",\"v\":1}\n{\"topic\":\"v\",\"v\":2}\n",
      {.mapping = "perentie-mapping: 1\nrules: [{topic: v, events: ['speed.{v}', speed_ok]}]\n"});
  const RunResult result = run_trace(test.stream(), model, Mode::permissive);
  EXPECT_EQ(result.verdict, RunVerdict::violation);
  EXPECT_EQ(result.event, "speed_ok");
  EXPECT_EQ(result.events_checked, 4U);
  EXPECT_EQ(result.events_ignored, 1U);
  EXPECT_EQ(result.place.line, 2U);
  EXPECT_EQ(result.source, "{\"topic\":\"v\",\"v\":2}");
}

TEST(SessionTest, ALongLineIsShortenedBetweenCharacters) {
  const MonitorModel model = model_from(mission);
  std::string line = "{\"event\":\"stop\",\"note\":\"";
  for (int i = 0; i < 500; ++i) line += "\u00e9";
  const RunResult result = run(model, line + "\"}\n", Mode::strict);
  EXPECT_LE(result.source.size(), 403U);
  EXPECT_TRUE(result.source.ends_with("\u00e9...")) << result.source;
}

}  // namespace
}  // namespace perentie::monitor

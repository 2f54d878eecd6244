// What machines and people read about a run.
#include "perentie/monitor/report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support.hpp"

namespace perentie::monitor {
namespace {

const char* const mission = "0 start 1; 1 move.0 1; 1 move.1 2; 2 tick 3";

RunSubject subject(Mode mode) {
  RunSubject s;
  s.name = "patrol";
  s.model = "rover.csp";
  s.process = "ROVER";
  s.trace = "rover.jsonl";
  s.mode = mode;
  s.states = 4;
  s.transitions = 5;
  s.synthesis_seconds = 0.25;
  return s;
}

RunResult run(const std::string& trace, Mode mode) {
  TestTrace test(trace);
  RunResult result = run_trace(test.stream(), model_from(mission), mode);
  result.checking_seconds = 0.5;  // a measured time is never the same twice
  return result;
}

TEST(ReportTest, JsonOfAViolation) {
  RunSubject about = subject(Mode::permissive);
  about.model_position = {"ROVER_MOVING"};
  EXPECT_EQ(
      to_json(run("{\"event\":\"start\"}\n{\"event\":\"noise\"}\n{\"event\":\"start\"}\n{"
                  "\"event\":\"move.1\"}\n",
                  Mode::permissive),
              about),
      R"({"schema":"perentie.monitor/1","verdict":"violation","reason":null,)"
      R"("events_checked":3,)"
      R"("events_total":4,"events_ignored":1,"note":null,"event":"start","event_in_alphabet":true,)"
      R"("expected":["move.0","move.1"],"permitted_next":[],"line":3,"column":1,)"
      R"("source":"{\"event\":\"start\"}","model_position":["ROVER_MOVING"],)"
      R"("ignored":{"noise":1},"name":"patrol","model":"rover.csp","process":"ROVER",)"
      R"("trace":"rover.jsonl","mode":"permissive","states":4,"transitions":5,)"
      R"("synthesis_seconds":0.25,"checking_seconds":0.5})");
}

TEST(ReportTest, JsonOfATraceThatConforms) {
  EXPECT_EQ(
      to_json(run("start\nmove.1\n", Mode::strict), subject(Mode::strict)),
      R"({"schema":"perentie.monitor/1","verdict":"conforms","reason":null,)"
      R"("events_checked":2,)"
      R"("events_total":2,"events_ignored":0,"note":null,"event":"move.1","event_in_alphabet":true,)"
      R"("expected":[],"permitted_next":["✓"],"line":2,"column":1,"source":null,)"
      R"("model_position":[],"ignored":{},"name":"patrol","model":"rover.csp",)"
      R"("process":"ROVER","trace":"rover.jsonl","mode":"strict","states":4,)"
      R"("transitions":5,"synthesis_seconds":0.25,"checking_seconds":0.5})");
}

TEST(ReportTest, JsonOfAnEmptyTraceHasNoEvent) {
  const auto json = nlohmann::json::parse(to_json(run("", Mode::strict), subject(Mode::strict)));
  EXPECT_EQ(json["verdict"], "conforms");
  EXPECT_TRUE(json["event"].is_null());
  EXPECT_TRUE(json["line"].is_null());
  EXPECT_EQ(json["events_total"], 0);
}

TEST(ReportTest, JsonIsUtf8WhateverTheTraceHolds) {
  RunResult result = run("start\n", Mode::strict);
  result.verdict = RunVerdict::violation;
  result.source = "\xFF\xFE";
  EXPECT_EQ(nlohmann::json::parse(to_json(result, subject(Mode::strict)))["source"],
            "\uFFFD\uFFFD");
}

TEST(ReportTest, TextOfAViolation) {
  RunSubject about = subject(Mode::permissive);
  about.model_position = {"ROVER_MOVING"};
  EXPECT_EQ(to_text(run("{\"event\":\"start\"}\n{\"event\":\"start\"}\n{\"event\":\"move.1\"}\n",
                        Mode::permissive),
                    about),
            "VIOLATION: ROVER does not permit the trace rover.jsonl\n"
            "  event      start, number 2: the model does not permit it here\n"
            "  at         rover.jsonl:2:1\n"
            "             {\"event\":\"start\"}\n"
            "  permitted  move.0, move.1\n"
            "  model at   ROVER_MOVING\n"
            "  checked    2 of 3 events, permissive mode\n");
}

TEST(ReportTest, TextOfAnUnknownEventInStrictMode) {
  EXPECT_EQ(to_text(run("start\nmove.2\n", Mode::strict), subject(Mode::strict)),
            "VIOLATION: ROVER does not permit the trace rover.jsonl\n"
            "  event      move.2, number 2: the model has no such event, and the mode is strict\n"
            "  at         rover.jsonl:2:1\n"
            "  similar    move.0, move.1\n"
            "  permitted  move.0, move.1\n"
            "  checked    2 of 2 events, strict mode\n");
}

TEST(ReportTest, TextOfATraceThatConforms) {
  EXPECT_EQ(to_text(run("start\nnoise\nmove.1\nnoise\nhum\n", Mode::permissive),
                    subject(Mode::permissive)),
            "CONFORMS: ROVER permits the trace rover.jsonl\n"
            "  last event hum\n"
            "  next       ✓\n"
            "  checked    5 of 5 events, permissive mode\n"
            "  ignored    3 events that the model does not have: hum, noise (2 times)\n");
}

TEST(ReportTest, TextSaysIfNothingWasChecked) {
  EXPECT_EQ(to_text(run("noise\n", Mode::permissive), subject(Mode::permissive)),
            "CONFORMS: ROVER permits the trace rover.jsonl\n"
            "  last event noise\n"
            "  next       start\n"
            "  checked    1 of 1 event, permissive mode\n"
            "  ignored    1 event that the model does not have: noise\n"
            "  note       no event of the trace is an event of the model: do the names agree?\n");
}

TEST(ReportTest, TextAfterTheEndOfTheModel) {
  const std::string text =
      to_text(run("start\nmove.1\ntick\nstart\n", Mode::strict), subject(Mode::strict));
  EXPECT_NE(text.find("  permitted  nothing: the model has stopped\n"), std::string::npos) << text;
}

TEST(ReportTest, TextOfAPositionInSeveralStates) {
  RunSubject about = subject(Mode::strict);
  about.model_position = {"A", "B", "C", "D", "E"};
  const std::string text = to_text(run("start\n", Mode::strict), about);
  EXPECT_NE(text.find("  model at   A\n"
                      "  or at      B\n"
                      "  or at      C\n"
                      "             or at 2 more states\n"),
            std::string::npos)
      << text;
}

TEST(ReportTest, ARunThatDidNotBeginSaysOnlyWhy) {
  RunResult result;
  result.verdict = RunVerdict::inconclusive;
  result.reason = "the limit of 3 states was reached while the model was explored";
  EXPECT_EQ(to_text(result, subject(Mode::strict)),
            "INCONCLUSIVE: the limit of 3 states was reached while the model was explored\n");
  const auto json = nlohmann::json::parse(to_json(result, subject(Mode::strict)));
  EXPECT_EQ(json["verdict"], "inconclusive");
  EXPECT_EQ(json["reason"], result.reason);
  EXPECT_EQ(json["events_checked"], 0);
  EXPECT_TRUE(json["events_total"].is_null());
}

TEST(ReportTest, TextOfATraceThatCannotBeRead) {
  EXPECT_EQ(to_text(run("{\"event\":\"start\"}\n{", Mode::strict), subject(Mode::strict)),
            "INCONCLUSIVE: the trace could not be read to its end\n"
            "  last event start\n"
            "  next       move.0, move.1\n"
            "  checked    1 event, strict mode\n");
  const std::string text =
      to_text(run("{\"event\":\"move.1\"}\n{", Mode::strict), subject(Mode::strict));
  EXPECT_TRUE(
      text.ends_with("  checked    1 event, strict mode\n"
                     "  note       the rest of the trace was not read; the verdict does "
                     "not depend on it\n"))
      << text;
}

TEST(ReportTest, NothingInATraceCommandsTheTerminal) {
  const std::string text =
      to_text(run("{\"event\":\"a\\u001b[31m\"}\n", Mode::strict), subject(Mode::strict));
  EXPECT_NE(text.find("  event      a?[31m, number 1"), std::string::npos) << text;
}

TEST(ReportTest, LongListsAreCut) {
  std::string edges;
  for (int i = 10; i < 40; ++i) edges += "0 e." + std::to_string(i) + " 0; ";
  TestTrace test("x\n");
  const RunResult result = run_trace(test.stream(), model_from(edges + "0"), Mode::strict);
  EXPECT_EQ(result.permitted.size(), 30U);
  EXPECT_NE(to_text(result, subject(Mode::strict)).find("e.20, e.21, and 18 more\n"),
            std::string::npos)
      << to_text(result, subject(Mode::strict));
}

}  // namespace
}  // namespace perentie::monitor

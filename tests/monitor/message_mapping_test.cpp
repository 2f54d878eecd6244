// From messages to events: the built-in mappings, every conversion, every complaint.
#include <gtest/gtest.h>

#include "support.hpp"

namespace perentie::monitor {
namespace {

using Texts = std::vector<std::string>;

// The events of a trace, with the diagnostics last if there are any.
Texts events_of(const std::string& trace, const TraceSetup& setup = {}) {
  TestTrace test(trace, setup);
  Texts texts = test.events();
  if (!test.diagnostics().empty()) texts.push_back(test.diagnostics());
  return texts;
}

// A mapping with one rule for the topic `t`.
TraceSetup rule(const std::string& body) {
  return {.mapping = "perentie-mapping: 1\nname: m\nrules:\n  - topic: t\n" + body};
}

TEST(SimpleMappingTest, TopicAndDataAreAnEvent) {
  EXPECT_EQ(
      events_of("{\"topic\": \"hello\", \"data\": null, \"time\": 0}\n"
                "{\"topic\": \"move\", \"data\": \"2\", \"time\": 5}\n"
                "{\"data\": 100, \"topic\": \"velocity\"}\n"
                "{\"topic\": \"footswitch\", \"data\": false}\n"
                "{\"topic\": \"move\", \"data\": \"1.1\"}\n"
                "{\"topic\": \"speed\", \"data\": 38.0}\n"
                "{\"topic\": \"speed\", \"data\": -0.5}\n"
                "{\"topic\": \"at\", \"data\": [1, \"x\", true]}\n"
                "{\"topic\": \"at\", \"data\": []}\n"
                "{\"event\": \"move.3\"}\n",
                {.event_map = {{"velocity", "speed"}, {"footswitch", "pedal"}, {"2", "two"}}}),
      (Texts{"hello", "move.2", "speed.100", "pedal.false", "move.1.1", "speed.38", "speed.-0.5",
             "at.1.x.true", "at", "move.3"}));
}

TEST(SimpleMappingTest, BareEventsHaveTheirChannelRenamed) {
  EXPECT_EQ(events_of("velocity.5\nstop\nvelocity . 1\n",
                      {.event_map = {{"velocity", "speed"}, {"stop", "halt.now"}, {"5", "x"}}}),
            (Texts{"speed.5", "halt.now", "speed. 1"}));
}

TEST(SimpleMappingTest, WithoutDataThereIsNoEvent) {
  EXPECT_EQ(
      events_of("{\"topic\": \"a\", \"data\": null}\n{\"topic\": \"move\", \"location\": 1}\n"),
      (Texts{"a",
             "trace:2:1: error: the field `data` is missing [M025]\n"
             "{\"topic\": \"move\", \"location\": 1}\n^\n"
             "perentie: note: the mapping is `simple`\n"}));
}

TEST(SimpleMappingTest, WithoutTopicThereIsNoEvent) {
  EXPECT_EQ(events_of("{\"velocity\":100, \"footswitch\": false }\n"),
            (Texts{"trace:1:1: error: the message has no `topic` [M023]\n"
                   "{\"velocity\":100, \"footswitch\": false }\n^\n"}));
  EXPECT_EQ(
      events_of("{\"topic\": 7}\n"),
      (Texts{"trace:1:11: error: `topic` must be a string [M023]\n{\"topic\": 7}\n          ^\n"}));
}

TEST(RoverMappingTest, TheFourTopicsOfTheRover) {
  EXPECT_EQ(
      events_of(
          "{\"topic\": \"/command\", \"name\": \"move\", \"location\": 1, \"time\": 1.5}\n"
          "{\"topic\": \"/currentLoc\", \"data\": 1}\n"
          "{\"topic\": \"/odom\", \"data\": 9}\n"
          "{\"topic\": \"/inspected\", \"location\": 1}\n"
          "{\"value\": 8.0, \"topic\": \"/radiation_sensor_plugin/sensor_0\", \"pose\": {}}\n",
          {.mapping = "varanus-rover"}),
      (Texts{"move.1", "arrived_at.1", "inspected.1", "radiation_level.Green"}));
}

TEST(RoverMappingTest, ThresholdsCutToIntegersFirst) {
  const std::pair<const char*, const char*> cases[] = {
      {"0", "Green"},    {"-0.9", "Green"},    {"119", "Green"},    {"119.99", "Green"},
      {"120", "Orange"}, {"120.0", "Orange"},  {"249.9", "Orange"}, {"250", "Red"},
      {"1e9", "Red"},    {"\"200\"", "Orange"}};
  for (const auto& [value, level] : cases) {
    const std::string line =
        std::string("{\"topic\": \"/radiation_sensor_plugin/sensor_0\", \"value\": ") + value +
        "}\n";
    EXPECT_EQ(events_of(line, {.mapping = "varanus-rover"}),
              Texts{std::string("radiation_level.") + level})
        << value;
    EXPECT_EQ(events_of(line, {.mapping = "varanus-rover",
                               .event_map = {{level, std::string("Radiation_") + level}}}),
              Texts{std::string("radiation_level.Radiation_") + level});
  }
}

TEST(RoverMappingTest, AReadingBelowZeroIsAnError) {
  EXPECT_EQ(
      events_of("{\"topic\": \"/inspected\", \"location\": 1}\n"
                "{\"value\": -1.0, \"topic\": \"/radiation_sensor_plugin/sensor_0\"}\n"
                "{\"topic\": \"/inspected\", \"location\": 2}\n",
                {.mapping = "varanus-rover"}),
      (Texts{"inspected.1",
             "trace:2:11: error: the field `value` is -1.0, which is below the lowest threshold "
             "[M025]\n"
             "{\"value\": -1.0, \"topic\": \"/radiation_sensor_plugin/sensor_0\"}\n          ^~~~\n"
             "perentie: note: the mapping is "
             "`varanus-rover`\n"}));
}

TEST(RoverMappingTest, NotANumberIsAnError) {
  for (const char* value : {"NaN", "Infinity", "-Infinity", "true", "\"high\"", "{}", "[1]"}) {
    const Texts texts =
        events_of(std::string("{\"topic\": \"/radiation_sensor_plugin/sensor_0\", \"value\": ") +
                      value + "}\n",
                  {.mapping = "varanus-rover"});
    ASSERT_EQ(texts.size(), 1U);
    EXPECT_NE(texts[0].find("which is not a number [M025]"), std::string::npos) << texts[0];
  }
}

TEST(TwoPassRuleTest, TheSimpleMappingIsUsedIfTheFirstMakesNothing) {
  const TraceSetup varanus{.mapping = "varanus-rover", .fallback = "simple"};
  // No topic of the rover (slashes matter here): all lines are simple.
  EXPECT_EQ(
      events_of("{\"topic\": \"inspected\", \"data\": \"1\"}\n{\"topic\": \"b\", \"data\": null}\n",
                varanus),
      (Texts{"inspected.1", "b"}));
  // One topic of the rover: the others are dropped.
  EXPECT_EQ(
      events_of(
          "{\"topic\": \"a\", \"data\": \"1\"}\n{\"topic\": \"/inspected\", \"location\": 4}\n",
          varanus),
      (Texts{"inspected.4"}));
  EXPECT_EQ(events_of("", varanus), Texts{});
  EXPECT_EQ(
      events_of("[{\"topic\": \"a\", \"data\": 1},\n {\"topic\": \"b\", \"data\": 2}]", varanus),
      (Texts{"a.1", "b.2"}));
}

TEST(TwoPassRuleTest, AFaultInTheFirstPassEndsTheTrace) {
  const Texts texts = events_of("{\"topic\": \"a\", \"data\": 1}\n{\"data\": 1}\n",
                                {.mapping = "varanus-rover", .fallback = "simple"});
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_NE(texts[0].find("trace:2:1: error: the message has no `topic`"), std::string::npos);
}

TEST(MessageMappingTest, SlashesAreOptionalUnlessTheMappingSaysOtherwise) {
  const std::string trace = "{\"topic\": \"t\", \"x\": 1}\n{\"topic\": \"/t\", \"x\": 2}\n";
  EXPECT_EQ(events_of(trace, rule("    event: e.{x}\n")), (Texts{"e.1", "e.2"}));
  EXPECT_EQ(
      events_of(trace, {.mapping = "perentie-mapping: 1\nrules: [{topic: /t, event: 'e.{x}'}]\n"}),
      (Texts{"e.1", "e.2"}));
  EXPECT_EQ(
      events_of(trace, {.mapping = "perentie-mapping: 1\nunknown-topics: ignore\nleading-slash: "
                                   "significant\nrules: [{topic: /t, event: 'e.{x}'}]\n"}),
      (Texts{"e.2"}));
}

TEST(MessageMappingTest, TopicPatterns) {
  const TraceSetup setup{.mapping =
                             "perentie-mapping: 1\nunknown-topics: ignore\nrules:\n"
                             "  - {topic: '/robot*/cmd', event: one}\n"
                             "  - {topic: '/log/**', ignore: true}\n"
                             "  - {topic: '**/cmd', event: 'other.{topic}'}\n"};
  EXPECT_EQ(events_of("{\"topic\": \"/robot1/cmd\"}\n{\"topic\": \"robot/cmd\"}\n"
                      "{\"topic\": \"/robot/x/cmd\"}\n{\"topic\": \"/log/a/cmd\"}\n"
                      "{\"topic\": \"/cmd\"}\n{\"topic\": \"/robot1/cmds\"}\n",
                      setup),
            (Texts{"one", "one", "other./robot/x/cmd"}));
}

TEST(MessageMappingTest, OneMessageMayBeSeveralEventsOrNone) {
  const TraceSetup setup = rule(
      "    events: ['speed.{v}', 'level.{l}', speed_ok]\n"
      "    values:\n"
      "      v: {field: v}\n"
      "      l: {field: l, table: {0: low, 1: high}, otherwise: ignore}\n");
  EXPECT_EQ(
      events_of("{\"topic\":\"t\",\"v\":5,\"l\":1}\n{\"topic\":\"t\",\"v\":6,\"l\":2}\n", setup),
      (Texts{"speed.5", "level.high", "speed_ok", "speed.6", "speed_ok"}));
}

TEST(MessageMappingTest, RulesMayAskForFields) {
  const TraceSetup setup{.mapping =
                             "perentie-mapping: 1\nunknown-topics: ignore\nrules:\n"
                             "  - {topic: t, has: [a.b, c], event: both}\n"
                             "  - {has: a, event: 'a.{a.b}'}\n"};
  EXPECT_EQ(
      events_of("{\"topic\":\"t\",\"a\":{\"b\":1},\"c\":null}\n{\"topic\":\"t\",\"a\":{\"b\":2}}\n"
                "{\"a\":{\"b\":3}}\n{\"topic\":\"t\"}\n",
                setup),
      (Texts{"both", "a.2", "a.3"}));
}

TEST(MessageMappingTest, FieldsAreFoundAnywhereInTheMessage) {
  EXPECT_EQ(
      events_of(
          "{\"pose\":{\"skip\":[{\"x\":9}],\"position\":{\"x\":3}},\"r\":[[7,8],{\"k\":\"v\"}],"
          "\"\\u0074opic\":\"t\"}\n",
          rule("    event: 'e.{pose.position.x}.{r[0][1]}.{r[1].k}'\n")),
      (Texts{"e.3.8.v"}));
  // The last of equal keys counts, as in Python.
  EXPECT_EQ(events_of("{\"topic\":\"u\",\"x\":1,\"topic\":\"t\",\"x\":2}\n",
                      rule("    event: 'e.{x}'\n")),
            (Texts{"e.2"}));
  // A field and what is in it.
  EXPECT_EQ(events_of("{\"topic\":\"t\",\"x\":[4,5]}\n", rule("    event: 'e.{x}.{x[0]}'\n")),
            (Texts{"e.4.5.4"}));
}

TEST(MessageMappingTest, Conversions) {
  const auto value = [](const std::string& body) {
    return rule("    event: 'e[.{v}]'\n    values:\n      v: {field: v, " + body + "}\n");
  };
  const auto one = [](const std::string& json) { return "{\"topic\":\"t\",\"v\":" + json + "}\n"; };
  EXPECT_EQ(events_of(one("-7.9"), value("as: integer")), Texts{"e.-7"});
  EXPECT_EQ(events_of(one("-0.5"), value("as: integer")), Texts{"e.0"});
  EXPECT_EQ(events_of(one("\"12\""), value("as: integer")), Texts{"e.12"});
  EXPECT_EQ(events_of(one("123456789012345678901"), value("as: integer")),
            Texts{"e.123456789012345678901"});
  EXPECT_EQ(events_of(one("1e3"), value("as: text")), Texts{"e.1000"});
  EXPECT_EQ(events_of(one("-0"), value("as: text")), Texts{"e.0"});
  EXPECT_EQ(events_of(one("\"a\\u00e9\\n\""), value("as: text")), Texts{"e.a\u00e9\n"});
  EXPECT_EQ(events_of(one("NaN"), value("as: text")), Texts{"e.NaN"});
  EXPECT_EQ(events_of(one("3"), value("table: {3: three}")), Texts{"e.three"});
  EXPECT_EQ(events_of(one("true"), value("table: {'true': 'on', 'false': 'off'}")), Texts{"e.on"});
  EXPECT_EQ(events_of(one("4"), value("table: {3: three}, otherwise: keep")), Texts{"e.4"});
  EXPECT_EQ(events_of(one("4"), value("table: {3: three}, otherwise: {text: other}")),
            Texts{"e.other"});
  EXPECT_EQ(events_of(one("4"), value("table: {3: three}, otherwise: ignore")), Texts{});
  EXPECT_EQ(events_of(one("2.5"), value("thresholds: [{at-least: 2.5, text: A}]")), Texts{"e.A"});
  EXPECT_EQ(
      events_of(one("2.4"), value("thresholds: [{at-least: 2.5, text: A}], otherwise: {text: B}")),
      Texts{"e.B"});
  EXPECT_EQ(events_of("{\"topic\":\"t\"}\n", value("missing: null")), Texts{"e"});
  EXPECT_EQ(events_of("{\"topic\":\"t\"}\n", value("missing: ignore")), Texts{});
  EXPECT_EQ(events_of("{\"topic\":\"t\"}\n", value("missing: {text: none}")), Texts{"e.none"});
}

TEST(MessageMappingTest, BracketsCanBeWritten) {
  EXPECT_EQ(events_of("{\"topic\":\"t\",\"x\":1}\n", rule("    event: 'e.{{{x},2}}.[[a]]'\n")),
            (Texts{"e.{1,2}.[a]"}));
}

TEST(MessageMappingTest, AGroupIsDroppedAsAWhole) {
  EXPECT_EQ(
      events_of("{\"topic\":\"t\",\"a\":1,\"b\":null}\n{\"topic\":\"t\",\"a\":null,\"b\":2}\n",
                rule("    event: 'e[.{a}.{b}].x[.{b}]'\n")),
      (Texts{"e.x", "e.x.2"}));
}

struct BadMessage {
  const char* name;
  std::string line;
  std::string diagnostics;
};

class BadMessageTest : public testing::TestWithParam<BadMessage> {};

TEST_P(BadMessageTest, IsReportedAtItsPlaceAndNothingBeforeIsLost) {
  const TraceSetup setup = rule("    event: 'e.{x}'\n");
  EXPECT_EQ(
      events_of("{\"topic\":\"t\",\"x\":1}\n" + GetParam().line + "\n{\"topic\":\"t\",\"x\":2}\n",
                setup),
      (Texts{"e.1", GetParam().diagnostics}));
}

const BadMessage bad_messages[] = {
    {"cut_off", "{\"topic\": \"t\", \"x\": [1",
     "trace:2:23: error: the message is cut off: the text ends before the JSON object does [M021]\n"
     "{\"topic\": \"t\", \"x\": [1\n                      ^\n"},
    {"cut_off_in_a_string", "{\"topic\": \"t\", \"x\": \"ab",
     "trace:2:24: error: the message is cut off: the text ends before the JSON object does [M021]\n"
     "{\"topic\": \"t\", \"x\": \"ab\n                       ^\n"},
    {"python_dictionary", "{u'topic': u't'}",
     "trace:2:2: error: the message is not JSON from here on [M021]\n{u'topic': u't'}\n ^\n"
     "perentie: note: this is how Python prints a dictionary; write messages with `json.dumps`\n"},
    {"two_messages", "{\"topic\":\"t\",\"x\":1}{\"topic\":\"t\",\"x\":2}",
     "trace:2:20: error: the message is not JSON from here on [M021]\n"
     "{\"topic\":\"t\",\"x\":1}{\"topic\":\"t\",\"x\":2}\n                   ^\n"},
    {"missing_comma", "{\"topic\":\"t\" \"x\":1}",
     "trace:2:14: error: the message is not JSON from here on [M021]\n"
     "{\"topic\":\"t\" \"x\":1}\n             ^~~\n"},
    {"a_word", "{\"topic\":\"t\",\"x\":yes}",
     "trace:2:18: error: the message is not JSON from here on [M021]\n"
     "{\"topic\":\"t\",\"x\":yes}\n                 ^\n"},
    {"broken_utf8", "{\"topic\":\"t\",\"x\":\"\xFF\"}",
     "trace:2:19: error: the message is not JSON from here on [M021]\n"
     "{\"topic\":\"t\",\"x\":\"\xFF\"}\n                  ^\n"},
    {"missing_field", "{\"topic\":\"t\"}",
     "trace:2:1: error: the field `x` is missing [M025]\n{\"topic\":\"t\"}\n^\n"
     "perentie: note: the mapping is `m`\n"},
    {"null_field", "{\"topic\":\"t\",\"x\":null}",
     "trace:2:18: error: the field `x` is null, but the event needs it [M025]\n"
     "{\"topic\":\"t\",\"x\":null}\n                 ^~~~\n"
     "perentie: note: the mapping is `m`\n"},
    {"object_field", "{\"topic\":\"t\",\"x\":{\"y\":1}}",
     "trace:2:18: error: the field `x` is {\"y\":1}, which is not a single value or a list of them "
     "[M025]\n{\"topic\":\"t\",\"x\":{\"y\":1}}\n                 ^~~~~~~\n"
     "perentie: note: the mapping is `m`\n"},
    {"unmapped_topic", "{\"topic\":\"tt\",\"x\":1}",
     "trace:2:10: error: the mapping `m` has no rule for the topic \"tt\" [M024]\n"
     "{\"topic\":\"tt\",\"x\":1}\n         ^~~~\n"},
};

INSTANTIATE_TEST_SUITE_P(Messages, BadMessageTest, testing::ValuesIn(bad_messages),
                         [](const auto& instance) { return instance.param.name; });

// The first block of a Markdown text that begins with ``` and this word.
std::string fenced_block(const std::string& text, const std::string& word) {
  const std::string open = "```" + word + "\n";
  const std::size_t begin = text.find(open) + open.size();
  return text.substr(begin, text.find("```", begin) - begin);
}

TEST(MessageMappingTest, TheWorkedExampleOfTheManualIsTrue) {
  const auto manual = base::read_file("docs/mapping.md");
  ASSERT_TRUE(manual.text) << manual.error;
  std::string events;
  for (const std::string& event : events_of(fenced_block(*manual.text, "json"),
                                            {.mapping = fenced_block(*manual.text, "yaml")})) {
    events += event + "\n";
  }
  EXPECT_EQ(events, fenced_block(*manual.text, "text"));
}

TEST(MessageMappingTest, NaNAndInfinityAreNoFaultWhereTheyDoNotMatter) {
  EXPECT_EQ(events_of("{\"a\":NaN,\"topic\":\"t\",\"b\":[1.5,Infinity,-Infinity],\"x\":1}\n",
                      rule("    event: 'e.{x}'\n")),
            (Texts{"e.1"}));
  // A real fault behind them is found where it is.
  const Texts texts =
      events_of("{\"a\":NaN,\"topic\":\"t\",\"x\":1,}\n", rule("    event: 'e.{x}'\n"));
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_NE(texts[0].find("trace:1:28: error: the message is not JSON from here on"),
            std::string::npos)
      << texts[0];
}

TEST(MessageMappingTest, DeepMessagesAreMappedOrRefused) {
  const std::string open(100000, '[');
  const std::string close(100000, ']');
  const TraceSetup setup = rule("    event: 'e.{x}'\n");
  EXPECT_EQ(events_of("{\"a\":" + open + close + ",\"topic\":\"t\",\"x\":1}\n", setup),
            Texts{"e.1"});
  const Texts broken = events_of("{\"a\":" + open + ",\"topic\":\"t\",\"x\":1}\n", setup);
  ASSERT_EQ(broken.size(), 1U);
  EXPECT_NE(broken[0].find("[M021]"), std::string::npos) << broken[0];
  const Texts nested = events_of("{\"topic\":\"t\",\"x\":" + open + close + "}\n", setup);
  ASSERT_EQ(nested.size(), 1U);
  EXPECT_NE(nested[0].find("which is not a single value or a list of them"), std::string::npos);
}

TEST(MessageMappingTest, PlacesInALongLineAreColumnsOfTheFile) {
  const std::string padding(5000, 'x');
  const Texts texts =
      events_of("{\"pad\":\"" + padding + "\u00e9\",\"topic\":\"t\"\n", rule("    event: e\n"));
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_NE(texts[0].find("trace:1:5023: error: the message is cut off"), std::string::npos)
      << texts[0];
  EXPECT_LT(texts[0].size(), 600U);
}

}  // namespace
}  // namespace perentie::monitor

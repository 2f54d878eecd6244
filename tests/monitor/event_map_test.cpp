// Event maps: what they rename, and what is said about files that are none.
#include "perentie/monitor/event_map.hpp"

#include <gtest/gtest.h>

#include "perentie/test/paths.hpp"
#include "support.hpp"

namespace perentie::monitor {
namespace {

std::string diagnostics_of(const std::string& json) {
  Sink sink;
  const auto file = sink.sources.add("map.json", json);
  EXPECT_FALSE(parse_event_map(*file, sink.sources, sink.diagnostics)) << json;
  return sink.text();
}

TEST(EventMapTest, RenamesWhatItHas) {
  Sink sink;
  const auto file = sink.sources.add(
      "map.json",
      "\xEF\xBB\xBF {\"velocity\": \"speed\",\n \"Gr\\u00fcn\" : \"Green\", \"a\":\"a\"}\n");
  const auto map = parse_event_map(*file, sink.sources, sink.diagnostics);
  ASSERT_TRUE(map) << sink.text();
  EXPECT_EQ(map->size(), 3U);
  EXPECT_EQ((*map)("velocity"), "speed");
  EXPECT_EQ((*map)("Gr\u00fcn"), "Green");
  EXPECT_EQ((*map)("other"), "other");
}

TEST(EventMapTest, RenamesTheChannelOfAnEvent) {
  EventMap map;
  map.add("velocity", "speed");
  map.add("move.1", "go.first");
  EXPECT_EQ(map.rename_event("velocity"), "speed");
  EXPECT_EQ(map.rename_event("velocity.5.6"), "speed.5.6");
  EXPECT_EQ(map.rename_event("velocity .5"), "speed.5");
  EXPECT_EQ(map.rename_event("move.1"), "go.first");
  EXPECT_EQ(map.rename_event("move.2"), "move.2");
  EXPECT_EQ(map.rename_event("c.velocity"), "c.velocity");
}

TEST(EventMapTest, AnEmptyObjectIsAnEmptyMap) {
  Sink sink;
  const auto file = sink.sources.add("map.json", "{ }");
  const auto map = parse_event_map(*file, sink.sources, sink.diagnostics);
  ASSERT_TRUE(map);
  EXPECT_TRUE(map->empty());
}

TEST(EventMapTest, WhatIsNotAnEventMapIsReportedAtItsPlace) {
  EXPECT_EQ(diagnostics_of(""),
            "map.json:1:1: error: the event map ends before its JSON object does [M003]\n\n^\n");
  EXPECT_EQ(
      diagnostics_of("{\"a\": \"b\""),
      "map.json:1:10: error: the event map ends before its JSON object does [M003]\n{\"a\": \"b\"\n"
      "         ^\n");
  EXPECT_EQ(diagnostics_of("{\"a\": \"b\",}"),
            "map.json:1:11: error: the event map is not JSON from here on [M003]\n{\"a\": \"b\",}\n"
            "          ^\n");
  EXPECT_EQ(
      diagnostics_of("[\"a\"]"),
      "map.json:1:1: error: an event map must be a JSON object of names to names [M007]\n[\"a\"]\n"
      "^\n");
  EXPECT_EQ(
      diagnostics_of("{\"a\": 1, \"b\": {\"c\": \"}\"}, \"d\": [1, {}], \"e\": null}"),
      "map.json:1:7: error: the model's name for `a` must be a string [M007]\n"
      "{\"a\": 1, \"b\": {\"c\": \"}\"}, \"d\": [1, {}], \"e\": null}\n      ^\n"
      "map.json:1:15: error: the model's name for `b` must be a string [M007]\n"
      "{\"a\": 1, \"b\": {\"c\": \"}\"}, \"d\": [1, {}], \"e\": null}\n              ^~~~~~~~~~\n"
      "map.json:1:32: error: the model's name for `d` must be a string [M007]\n"
      "{\"a\": 1, \"b\": {\"c\": \"}\"}, \"d\": [1, {}], \"e\": null}\n"
      "                               ^~~~~~~\n"
      "map.json:1:46: error: the model's name for `e` must be a string [M007]\n"
      "{\"a\": 1, \"b\": {\"c\": \"}\"}, \"d\": [1, {}], \"e\": null}\n"
      "                                             ^~~~\n");
}

TEST(EventMapTest, HostileTextIsNoDanger) {
  diagnostics_of("{\"a\": " + std::string(100000, '['));
  diagnostics_of("{\"a\": " + std::string(100000, '[') + std::string(100000, ']') + "}");
  diagnostics_of(std::string("\0\x01\xFF", 3));
}

TEST(EventMapTest, AFileThatIsNotThereIsNamed) {
  Sink sink;
  EXPECT_FALSE(load_event_map("none.json", sink.sources, sink.diagnostics));
  EXPECT_EQ(
      sink.text(),
      "perentie: error: cannot read the event map `none.json`: No such file or directory [M001]\n");
}

TEST(EventMapTest, VaranusMapsLoad) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data / "varanus")) {
    if (!entry.path().filename().string().ends_with("event_map.json")) continue;
    Sink sink;
    EXPECT_TRUE(load_event_map(entry.path(), sink.sources, sink.diagnostics)) << sink.text();
    ++count;
  }
  EXPECT_EQ(count, 5);
}

}  // namespace
}  // namespace perentie::monitor

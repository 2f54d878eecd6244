// Mapping files: what they may say, and what is said about them when they are wrong.
#include "perentie/monitor/mapping.hpp"

#include <gtest/gtest.h>

#include "perentie/base/diagnostic.hpp"
#include "support.hpp"

namespace perentie::monitor {
namespace {

std::string diagnostics_of(const std::string& yaml) {
  Sink sink;
  const auto file = sink.sources.add("m.yaml", yaml);
  const auto mapping = parse_mapping(*file, sink.sources, sink.diagnostics);
  EXPECT_EQ(mapping.has_value(), !sink.diagnostics.has_errors());
  return sink.text();
}

const std::string head = "perentie-mapping: 1\nrules:\n";

TEST(MappingTest, TheBuiltInMappingsAreGoodAndNamed) {
  for (const std::string_view name : builtin_mapping_names()) {
    Sink sink;
    const auto mapping = load_mapping(std::string(name), sink.sources, sink.diagnostics);
    ASSERT_TRUE(mapping) << sink.text();
    EXPECT_EQ(mapping->name, name);
    EXPECT_EQ(sink.text(), "");
  }
}

TEST(MappingTest, TheBuiltInMappingsAreTheShippedFiles) {
  for (const std::string_view name : builtin_mapping_names()) {
    const auto file = base::read_file("monitor/mappings/" + std::string(name) + ".yaml");
    ASSERT_TRUE(file.text) << file.error;
    EXPECT_EQ(*file.text, builtin_mapping_text(name));
  }
}

TEST(MappingTest, AMappingThatIsNotThereIsNamed) {
  Sink sink;
  EXPECT_FALSE(load_mapping("rover.yaml", sink.sources, sink.diagnostics));
  EXPECT_EQ(
      sink.text(),
      "perentie: error: cannot read the mapping `rover.yaml`: No such file or directory [M001]\n"
      "perentie: note: the mappings that come with the program are `simple` or "
      "`varanus-rover`\n");
}

TEST(FieldPathTest, KeysAndIndices) {
  for (const char* good : {"data", "pose.position.x", "ranges[0]", "a[1][2].b", "@type", "a-b"}) {
    const auto path = parse_field_path(good);
    ASSERT_TRUE(path) << good;
    EXPECT_EQ(to_string(*path), good);
  }
  for (const char* bad : {"", ".", "a.", ".a", "a..b", "[0]", "a[", "a[]", "a[x]", "a[-1]", "a[0]b",
                          "a.[0]", "a]", "a[4294967296]", "a{b"}) {
    EXPECT_FALSE(parse_field_path(bad)) << bad;
  }
  std::string long_path = "a";
  for (int i = 0; i < 40; ++i) long_path += ".a";
  EXPECT_FALSE(parse_field_path(long_path));
}

struct BadMapping {
  const char* name;
  std::string yaml;
  std::string diagnostics;
};

class BadMappingTest : public testing::TestWithParam<BadMapping> {};

TEST_P(BadMappingTest, IsReportedAtItsPlace) {
  EXPECT_EQ(diagnostics_of(GetParam().yaml), GetParam().diagnostics);
}

const BadMapping bad_mappings[] = {
    {"not_yaml", "rules: [a\nb: c",
     "m.yaml:2:2: error: this is not YAML: end of sequence flow not found "
     "[M002]\nb: c\n ^\n"},
    {"empty", "",
     "m.yaml:1:1: error: the file must be a map of keys to values, but it is empty [M007]\n\n^\n"},
    {"a_list", "- a\n",
     "m.yaml:1:1: error: the file must be a map of keys to values, but it is a list [M007]\n- "
     "a\n^\n"},
    {"two_documents", "perentie-mapping: 1\nrules: []\n---\na: b\n",
     "m.yaml:3:1: error: the file goes on behind the end of its YAML document [M002]\n---\n^\n"},
    {"no_keys", "name: x\n",
     "m.yaml:1:1: error: a mapping must have the key `perentie-mapping` [M004]\nname: x\n^\n"
     "m.yaml:1:1: error: a mapping must have the key `rules` [M004]\nname: x\n^\n"},
    {"other_format", "perentie-mapping: 2\nrules: []\n",
     "m.yaml:1:19: error: the mapping is of format 2, but this program reads format 1 [M008]\n"
     "perentie-mapping: 2\n                  ^\n"},
    {"unknown_key", "perentie-mapping: 1\nrule: x\nrules: []\n",
     "m.yaml:2:1: warning: the key `rule` means nothing in a mapping and is ignored [M005]\n"
     "rule: x\n^~~~\nperentie: note: did you mean `rules`?\n"},
    {"key_given_twice", "perentie-mapping: 1\nrules: []\nrules: []\n",
     "m.yaml:3:1: error: the key `rules` is given twice [M006]\nrules: []\n^~~~~\n"},
    {"rules_not_a_list", "perentie-mapping: 1\nrules: x\n",
     "m.yaml:2:8: error: `rules` must be a list, but it is `x` [M007]\nrules: x\n       ^\n"},
    {"bad_word", "perentie-mapping: 1\nunknown-topics: drop\nrules: []\n",
     "m.yaml:2:17: error: `unknown-topics` must be `error` or `ignore`, but it is `drop` [M008]\n"
     "unknown-topics: drop\n                ^~~~\n"},
    {"rule_for_nothing", head + "  - event: a\n",
     "m.yaml:3:5: error: a rule must say which messages it is for, by `topic` or by `has` [M004]\n"
     "  - event: a\n    ^\n"},
    {"rule_without_event", head + "  - topic: a\n",
     "m.yaml:3:5: error: a rule must have exactly one of `event`, `events` and `ignore: true` "
     "[M004]\n"
     "  - topic: a\n    ^\n"},
    {"rule_that_does_not_ignore", head + "  - {topic: a, ignore: false}\n",
     "m.yaml:3:24: error: `ignore: false` says nothing; give `event` or `events` instead [M008]\n"
     "  - {topic: a, ignore: false}\n                       ^~~~~\n"},
    {"no_events", head + "  - {topic: a, events: []}\n",
     "m.yaml:3:24: error: `events` is empty; write `ignore: true` instead [M008]\n"
     "  - {topic: a, events: []}\n                       ^\n"},
    {"bad_path", head + "  - {topic: a, has: 'x[', event: a}\n",
     "m.yaml:3:21: error: `x[` is not a field path such as `pose.position.x` or `data[0]` [M009]\n"
     "  - {topic: a, has: 'x[', event: a}\n                    ^~~~\n"},
    {"open_brace", head + "  - {topic: a, event: 'a.{b'}\n",
     "m.yaml:3:23: error: the event `a.{b` cannot be read: `{` is not closed by `}` [M010]\n"
     "  - {topic: a, event: 'a.{b'}\n                      ^~~~~~\n"},
    {"no_such_value", head + "  - {topic: a, event: 'a.{b c.}'}\n",
     "m.yaml:3:23: error: the event `a.{b c.}` cannot be read: `{b c.}` names neither a value of "
     "the "
     "rule nor a field [M010]\n"
     "  - {topic: a, event: 'a.{b c.}'}\n                      ^~~~~~~~~~\n"},
    {"group_without_value", head + "  - {topic: a, event: 'a[.b]'}\n",
     "m.yaml:3:23: error: the event `a[.b]` cannot be read: an optional group must hold a value "
     "such "
     "as `{data}` [M010]\n  - {topic: a, event: 'a[.b]'}\n                      ^~~~~~~\n"},
    {"nested_groups", head + "  - {topic: a, event: 'a[.{b}[.{c}]]'}\n",
     "m.yaml:3:23: error: the event `a[.{b}[.{c}]]` cannot be read: `[` stands inside another `[` "
     "[M010]\n  - {topic: a, event: 'a[.{b}[.{c}]]'}\n                      ^~~~~~~~~~~~~~~\n"},
    {"empty_event", head + "  - {topic: a, event: ''}\n",
     "m.yaml:3:23: error: the event `` cannot be read: it is empty [M010]\n"
     "  - {topic: a, event: ''}\n                      ^~\n"},
    {"bounds_that_do_not_ascend",
     head + "  - topic: a\n    event: a.{v}\n    values:\n      v:\n        field: v\n"
            "        thresholds: [{at-least: 5, text: A}, {at-least: 5, text: B}]\n",
     "m.yaml:8:57: error: the bounds of thresholds must ascend [M008]\n"
     "        thresholds: [{at-least: 5, text: A}, {at-least: 5, text: B}]\n"
     "                                                        ^\n"},
    {"bound_that_is_no_number",
     head +
         "  - topic: a\n    event: a.{v}\n    values:\n      v: {field: v, thresholds: [{at-least: "
         "low, text: A}]}\n",
     "m.yaml:6:45: error: `at-least` must be a number, but it is `low` [M007]\n"
     "      v: {field: v, thresholds: [{at-least: low, text: A}]}\n"
     "                                            ^~~\n"},
    {"otherwise_of_nothing",
     head + "  - topic: a\n    event: a.{v}\n    values:\n      v: {field: v, otherwise: keep}\n",
     "m.yaml:6:32: error: `otherwise` belongs to `thresholds` or `table`, of which there is none "
     "[M008]\n      v: {field: v, otherwise: keep}\n                               ^~~~\n"},
    {"table_and_thresholds",
     head + "  - topic: a\n    event: a.{v}\n    values:\n      v: {field: v, table: {1: a}, "
            "thresholds: "
            "[{at-least: 5, text: A}]}\n",
     "m.yaml:6:10: error: the value `v` cannot have both `thresholds` and `table` [M008]\n"
     "      v: {field: v, table: {1: a}, thresholds: [{at-least: 5, text: A}]}\n         ^\n"},
    {"fallback_that_is_no_word",
     head + "  - topic: a\n    event: a.{v}\n    values:\n      v: {field: v, missing: keep}\n",
     "m.yaml:6:30: error: `missing` must be `error`, `ignore` or `null` or a map `{text: ...}`, "
     "but it "
     "is `keep` [M008]\n      v: {field: v, missing: keep}\n                             ^~~~\n"},
};

INSTANTIATE_TEST_SUITE_P(Mappings, BadMappingTest, testing::ValuesIn(bad_mappings),
                         [](const auto& instance) { return instance.param.name; });

TEST(MappingTest, AllFaultsOfAFileAreReportedAtOnce) {
  Sink sink;
  const auto file = sink.sources.add("m.yaml", "perentie-mapping: x\nname: [a]\nrules: [{}, 1]\n");
  EXPECT_FALSE(parse_mapping(*file, sink.sources, sink.diagnostics));
  EXPECT_EQ(sink.diagnostics.error_count(), 5U) << sink.text();
}

TEST(MappingTest, HostileYamlIsNoDanger) {
  EXPECT_NE(diagnostics_of(std::string(100000, '[')), "");
  EXPECT_NE(diagnostics_of(std::string(100000, '{')), "");
  EXPECT_NE(diagnostics_of(std::string("\0\x01\xFF", 3)), "");
  // Texts on which yaml-cpp has hung, or of which it makes documents without end.
  for (const char* text :
       {",", ",\n-", ", b'N# ", "rules: (\n\"a\",\n)", "[:", "{:", "a: [", "- !+(.,.)"}) {
    EXPECT_NE(diagnostics_of(text), "") << text;
  }
  EXPECT_NE(diagnostics_of("rules: &a [*a, *a]\nperentie-mapping: *b\n"), "");
}

}  // namespace
}  // namespace perentie::monitor

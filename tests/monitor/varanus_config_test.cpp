// Varanus configs: every key, every way to write it, every complaint.
#include "perentie/monitor/varanus_config.hpp"

#include <gtest/gtest.h>

#include "perentie/test/paths.hpp"
#include "support.hpp"

namespace perentie::monitor {
namespace {

struct Parsed {
  std::optional<VaranusConfig> config;
  std::string diagnostics;
};

Parsed parse(const std::string& yaml, const std::string& path = "configs/c.yaml") {
  Sink sink;
  const auto file = sink.sources.add(path, yaml);
  Parsed parsed{parse_varanus_config(*file, sink.sources, sink.diagnostics), {}};
  parsed.diagnostics = sink.text();
  return parsed;
}

std::vector<std::string> values(const std::optional<std::vector<Placed<std::string>>>& list) {
  std::vector<std::string> texts;
  for (const auto& item : list.value()) texts.push_back(item.value);
  return texts;
}

TEST(VaranusConfigTest, EveryKey) {
  const Parsed parsed = parse(
      "---\nmodel: \"m.csp\" # the model\nmain_process: a -> b -> SKIP\nalphabet: [a, b, on]\n"
      "common_alphabet:\n  - a\n  - 'b'\nmap: maps/m.json\ntrace_file: ../t.txt\nname: \"n\"\n"
      "mode: \"strict\"\nstress_events: [a]\nstress_repetitions: 100000\n"
      "predictive_ltl_ws_url: ws://localhost:1\nmapping: r.yaml\n");
  ASSERT_TRUE(parsed.config) << parsed.diagnostics;
  EXPECT_EQ(parsed.diagnostics, "");
  const VaranusConfig& config = *parsed.config;
  EXPECT_EQ(config.model.value, "configs/m.csp");
  EXPECT_EQ(config.main_process.value, "a -> b -> SKIP");
  EXPECT_EQ(values(config.alphabet), (std::vector<std::string>{"a", "b", "on"}));
  EXPECT_EQ(values(config.common_alphabet), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(config.map->value, "configs/maps/m.json");
  EXPECT_EQ(config.trace_file->value, "configs/../t.txt");
  EXPECT_EQ(config.mapping->value, "configs/r.yaml");
  EXPECT_EQ(config.name, "n");
  EXPECT_EQ(config.mode, Mode::strict);
  EXPECT_EQ(config.stress_events, std::vector<std::string>{"a"});
  EXPECT_EQ(config.stress_repetitions, 100000U);
  EXPECT_EQ(config.predictive_ltl_ws_url, "ws://localhost:1");
}

TEST(VaranusConfigTest, Defaults) {
  const Parsed parsed = parse("model: m.csp\nmain_process: P\nmap:\n");
  ASSERT_TRUE(parsed.config) << parsed.diagnostics;
  EXPECT_EQ(parsed.config->mode, Mode::permissive);
  EXPECT_EQ(parsed.config->name, "c");
  EXPECT_FALSE(parsed.config->alphabet);
  EXPECT_FALSE(parsed.config->common_alphabet);
  EXPECT_FALSE(parsed.config->map);
  EXPECT_FALSE(parsed.config->trace_file);
  EXPECT_FALSE(parsed.config->mapping);
  EXPECT_FALSE(parsed.config->stress_repetitions);
}

TEST(VaranusConfigTest, ValuesKnowTheirPlace) {
  Sink sink;
  const auto file =
      sink.sources.add("c.yaml", "model: m.csp\nmain_process: P\ncommon_alphabet: [a, 'bc']\n");
  const auto config = parse_varanus_config(*file, sink.sources, sink.diagnostics);
  ASSERT_TRUE(config);
  EXPECT_EQ(sink.sources.text(*config->main_process.span), "P");
  EXPECT_EQ(sink.sources.text(*config->common_alphabet->at(1).span), "'bc'");
}

TEST(VaranusConfigTest, PathsAreRelativeToTheConfigOrAbsolute) {
  EXPECT_EQ(resolve_path("c.yaml", "m.csp"), "m.csp");
  EXPECT_EQ(resolve_path("a/b/c.yaml", "m.csp"), "a/b/m.csp");
  EXPECT_EQ(resolve_path("/a/c.yaml", "d/m.csp"), "/a/d/m.csp");
  EXPECT_EQ(resolve_path("a/c.yaml", "/d/m.csp"), "/d/m.csp");
  EXPECT_EQ(resolve_path("a/c.yaml", "-"), "-");
  EXPECT_EQ(parse("model: m.csp\nmain_process: P\nmapping: simple\n").config->mapping->value,
            "simple");
}

TEST(VaranusConfigTest, MissingKeysAreNamedAllAtOnce) {
  const Parsed parsed = parse("name: x\n");
  EXPECT_FALSE(parsed.config);
  EXPECT_EQ(
      parsed.diagnostics,
      "configs/c.yaml:1:1: error: a config must have the key `model` [M004]\nname: x\n^\n"
      "configs/c.yaml:1:1: error: a config must have the key `main_process` [M004]\nname: x\n^\n");
}

TEST(VaranusConfigTest, UnknownKeysAreWarnedOf) {
  const Parsed parsed = parse("model: m.csp\nmain_process: P\ncomon_alphabet: [a]\nfoo: 1\n");
  EXPECT_TRUE(parsed.config);
  EXPECT_EQ(
      parsed.diagnostics,
      "configs/c.yaml:3:1: warning: the key `comon_alphabet` means nothing in a config and is "
      "ignored [M005]\ncomon_alphabet: [a]\n^~~~~~~~~~~~~~\n"
      "perentie: note: did you mean `common_alphabet`?\n"
      "configs/c.yaml:4:1: warning: the key `foo` means nothing in a config and is ignored "
      "[M005]\nfoo: 1\n^~~\n");
}

TEST(VaranusConfigTest, WrongTypesAreReportedAtTheirPlace) {
  const Parsed parsed = parse(
      "model: [m.csp]\nmain_process:\nalphabet: {a: b}\ncommon_alphabet: [a, [b]]\nmode: Strict\n"
      "stress_repetitions: -1\n");
  EXPECT_FALSE(parsed.config);
  EXPECT_EQ(
      parsed.diagnostics,
      "configs/c.yaml:1:8: error: `model` must be a text, but it is a list [M007]\n"
      "model: [m.csp]\n       ^\n"
      "configs/c.yaml:2:14: error: `main_process` must be a text, but it is empty [M007]\n"
      "main_process:\n             ^\n"
      "configs/c.yaml:3:11: error: `alphabet` must be a list, but it is a map [M007]\n"
      "alphabet: {a: b}\n          ^\n"
      "configs/c.yaml:4:22: error: an entry of `common_alphabet` must be a text, but it is a "
      "list [M007]\ncommon_alphabet: [a, [b]]\n                     ^\n"
      "configs/c.yaml:5:7: error: `mode` must be `strict` or `permissive`, but it is `Strict` "
      "[M008]\nmode: Strict\n      ^~~~~~\n"
      "configs/c.yaml:6:21: error: `stress_repetitions` must be a whole number, 0 or more, but "
      "it is `-1` [M007]\nstress_repetitions: -1\n                    ^~\n");
}

TEST(VaranusConfigTest, ASingleChannelNeedsNoBrackets) {
  const Parsed parsed = parse("model: m.csp\nmain_process: P\nalphabet: a\n");
  EXPECT_EQ(values(parsed.config->alphabet), std::vector<std::string>{"a"});
}

TEST(VaranusConfigTest, AFileThatIsNotThereIsNamed) {
  Sink sink;
  EXPECT_FALSE(load_varanus_config("none.yaml", sink.sources, sink.diagnostics));
  EXPECT_EQ(
      sink.text(),
      "perentie: error: cannot read the config `none.yaml`: No such file or directory [M001]\n");
}

TEST(VaranusConfigTest, AllConfigsOfVaranusLoad) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data / "varanus")) {
    if (entry.path().extension() != ".yaml") continue;
    Sink sink;
    const auto config = load_varanus_config(entry.path(), sink.sources, sink.diagnostics);
    EXPECT_TRUE(config) << sink.text();
    EXPECT_EQ(sink.text(), "") << entry.path();
    EXPECT_NE(config->main_process.value, "");
    ++count;
  }
  EXPECT_EQ(count, 43);
}

}  // namespace
}  // namespace perentie::monitor

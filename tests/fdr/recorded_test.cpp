// What FDR, or the rules that it documents, are known to say about scripts of ours, in FDR's JSON:
// `recorded/`. Keys that are not recorded are not compared. `record` makes the files anew where FDR
// is installed.
#include <fstream>

#include <gtest/gtest.h>

#include "perentie/base/source.hpp"
#include "perentie/test/paths.hpp"
#include "replay.hpp"
#include "run_perentie.hpp"

namespace perentie::test {
namespace {

namespace fs = std::filesystem;

const fs::path recorded = "tests/fdr/recorded";

std::vector<fs::path> documents() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(recorded)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class RecordedTest : public ::testing::TestWithParam<fs::path> {};

TEST_P(RecordedTest, ComesOutAsItWasRecorded) {
  const Json theirs = Json::parse(read_text(GetParam()));
  const std::string script = theirs.at("file_name");
  const Json ours = our_document(script);
  ASSERT_TRUE(ours["errors"].empty()) << ours["errors"];
  // The same assertion may stand twice: each recorded result is that of the next one.
  std::size_t next = 0;
  for (const Json& result : theirs.at("results")) {
    const std::string wanted = normal_text(result.at("assertion_string"));
    while (next < ours["results"].size() &&
           normal_text(ours["results"][next]["assertion_string"]) != wanted) {
      ++next;
    }
    ASSERT_LT(next, ours["results"].size()) << "no assertion " << result["assertion_string"];
    EXPECT_TRUE(agrees(ours["results"][next], result)) << result["assertion_string"];
    ++next;
  }
  EXPECT_FALSE(theirs["results"].empty());
}

// Whether a counterexample says enough to be followed.
bool is_whole(const Json& counterexample) {
  const Json own = counterexample.value("implementation_behaviour", Json::object());
  const bool ends =
      own.contains("error_event") || own.contains("acceptance") || own.contains("loop_start");
  const bool is_property =
      counterexample["type"] == "deadlock" || counterexample["type"] == "divergence";
  return own.contains("trace") && ends &&
         (is_property || counterexample.contains("specification_behaviour"));
}

// Where whole counterexamples were recorded, our step rules can follow them.
TEST_P(RecordedTest, CounterexamplesCanBeReplayed) {
  const Json theirs = Json::parse(read_text(GetParam()));
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const auto file = base::add_file(theirs.at("file_name"), sources).file;
  ASSERT_TRUE(file);
  const auto script = semantics::Script::load(*file, sources, diagnostics);
  ASSERT_TRUE(script) << base::render_all(diagnostics, sources);
  std::size_t next = 0;
  const auto assertions = semantics::assertions_of(script->tree());
  for (const Json& result : theirs.at("results")) {
    const std::string wanted = normal_text(result.at("assertion_string"));
    while (normal_text(assertions.at(next).text) != wanted) ++next;
    Json whole = result;
    whole["counterexamples"] = Json::array();
    for (const Json& c : result.value("counterexamples", Json::array())) {
      if (is_whole(c)) whole["counterexamples"].push_back(c);
    }
    EXPECT_TRUE(replays(*script, assertions[next], whole, theirs)) << result;
    ++next;
  }
}

TEST(RecordedStoreTest, EveryFileNamesItsSource) {
  const std::string list = read_text(recorded / "README.md");
  for (const fs::path& file : documents()) {
    EXPECT_NE(list.find("| `" + file.filename().string() + "` |"), std::string::npos) << file;
  }
  EXPECT_GE(documents().size(), 4U);
}

std::string file_name(const ::testing::TestParamInfo<fs::path>& info) {
  return info.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(Store, RecordedTest, ::testing::ValuesIn(documents()), file_name);

}  // namespace
}  // namespace perentie::test

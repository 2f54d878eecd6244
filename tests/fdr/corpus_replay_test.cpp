// Every counterexample to an assertion of our corpus is replayed.
#include <gtest/gtest.h>

#include "perentie/base/source.hpp"
#include "perentie/test/corpus.hpp"
#include "perentie/test/paths.hpp"
#include "replay.hpp"

namespace perentie::test {
namespace {

namespace fs = std::filesystem;

class CorpusReplayTest : public ::testing::TestWithParam<fs::path> {};

TEST_P(CorpusReplayTest, TheImplementationCanDoItTheSpecificationCannot) {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const auto file = base::add_file(GetParam().string(), sources).file;
  ASSERT_TRUE(file);
  const auto script = semantics::Script::load(*file, sources, diagnostics);
  ASSERT_TRUE(script) << base::render_all(diagnostics, sources);
  const auto assertions = semantics::assertions_of(script->tree());
  const Json document = our_document(GetParam());
  ASSERT_EQ(document["results"].size(), assertions.size());
  std::size_t counterexamples = 0;
  for (std::size_t i = 0; i < assertions.size(); ++i) {
    const Json& result = document["results"][i];
    if (!result["errors"].empty()) continue;  // checks that are refused
    EXPECT_TRUE(replays(*script, assertions[i], result, document)) << assertions[i].text;
    const bool fails = (result["result"] == 0) != (result["is_negated"] == 1);
    EXPECT_EQ(result["counterexamples"].size(), fails ? 1U : 0U) << assertions[i].text;
    counterexamples += result["counterexamples"].size();
  }
  EXPECT_GT(counterexamples, 0U);
}

std::string file_name(const ::testing::TestParamInfo<fs::path>& info) {
  return info.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(Corpus, CorpusReplayTest,
                         ::testing::ValuesIn(scripts_in(corpus() / "check")), file_name);

}  // namespace
}  // namespace perentie::test

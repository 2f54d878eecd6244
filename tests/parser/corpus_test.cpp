// Our own corpus of scripts: what parses and what does not, with golden dumps beside the files.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "parse_support.hpp"
#include "perentie/parser/diagnostic_codes.hpp"
#include "perentie/test/corpus.hpp"
#include "perentie/test/golden.hpp"
#include "perentie/test/paths.hpp"

namespace perentie::parser {
namespace {

using test::matches_golden;
namespace fs = std::filesystem;

std::string test_name(const ::testing::TestParamInfo<fs::path>& info) {
  return info.param.stem().string();
}

fs::path with_suffix(fs::path file, const std::string& suffix) { return file += suffix; }

class PassingScript : public ::testing::TestWithParam<fs::path> {};

TEST_P(PassingScript, ParsesAsItsGoldenFileSays) {
  const Parsed parsed = parse_file(GetParam());
  EXPECT_EQ(parsed.messages(), "");
  if (GetParam().stem().string().starts_with("lex_")) {
    const Lexed lexed = lex_text(*base::read_file(GetParam().string()).text, GetParam().string());
    EXPECT_TRUE(matches_golden(with_suffix(GetParam(), ".tokens"), lexed.dump()));
  }
  EXPECT_TRUE(matches_golden(with_suffix(GetParam(), ".ast"), parsed.dump()));
  EXPECT_TRUE(matches_golden(with_suffix(GetParam(), ".printed"), parsed.printed()));
}

TEST_P(PassingScript, ParsesTheSameWhenPrinted) {
  if (GetParam().stem() == "decl_include_clauses") {
    GTEST_SKIP() << "clauses from two files are one function when printed into one";
  }
  const Parsed parsed = parse_file(GetParam());
  for (const std::size_t width : {100U, 20U, 0U}) {
    const std::string printed = print_script(parsed.tree, {width});
    const Parsed again = parse_text(printed);
    EXPECT_EQ(again.messages(), "");
    EXPECT_TRUE(same_tree(parsed.tree, again.tree)) << printed;
    EXPECT_EQ(print_script(again.tree, {width}), printed);
  }
}

INSTANTIATE_TEST_SUITE_P(Corpus, PassingScript,
                         ::testing::ValuesIn(scripts_in(test::corpus() / "parser/pass")),
                         test_name);

class FailingScript : public ::testing::TestWithParam<fs::path> {};

TEST_P(FailingScript, IsReportedWhereItSaysSo) {
  const Parsed parsed = parse_file(GetParam());
  std::map<base::FileId, test::CodesByLine> reported;
  for (const base::Diagnostic& d : parsed.diagnostics.all()) {
    const base::Position at = parsed.sources.position(d.span->begin);
    reported[parsed.sources.file_of(d.span->begin)][at.line].insert(std::string(d.code->id));
  }
  EXPECT_FALSE(reported.empty());
  for (std::uint32_t i = 0; i < parsed.sources.file_count(); ++i) {
    const base::FileId file{i};
    EXPECT_EQ(reported[file], test::expected_codes(std::string(parsed.sources.text(file))))
        << parsed.messages();
  }
}

TEST_P(FailingScript, IsReportedAsItsGoldenFileSays) {
  const Parsed parsed = parse_file(GetParam());
  EXPECT_TRUE(matches_golden(with_suffix(GetParam(), ".diagnostics"), parsed.messages()));
}

INSTANTIATE_TEST_SUITE_P(Corpus, FailingScript,
                         ::testing::ValuesIn(scripts_in(test::corpus() / "parser/fail")),
                         test_name);

TEST(DiagnosticCodesTest, EachIsProducedBySomeScriptOfTheCorpus) {
  std::set<std::string_view> produced;
  for (const fs::path& file : scripts_in(test::corpus() / "parser/fail")) {
    const Parsed parsed = parse_file(file);
    for (const base::Diagnostic& d : parsed.diagnostics.all()) produced.insert(d.code->id);
  }
  for (const base::DiagnosticCode* code : codes::all) {
    EXPECT_TRUE(produced.contains(code->id)) << code->id << ": " << code->title;
  }
}

TEST(DiagnosticCodesTest, AreSortedAndDistinct) {
  for (std::size_t i = 1; i < codes::all.size(); ++i) {
    EXPECT_LT(codes::all[i - 1]->id, codes::all[i]->id);
  }
}

}  // namespace
}  // namespace perentie::parser

// .aut files: exact output, everything that must be read, and a clear place for everything that is
// not.
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "perentie/lts/aut.hpp"
#include "perentie/lts/diagnostic_codes.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;
using test::to_text;

std::string write(const Lts& lts, const AutOptions& options = {}) {
  std::ostringstream out;
  write_aut(out, lts, options);
  return out.str();
}

/// The graph as `lts_from` text, or the rendered diagnostics.
std::string read(std::string_view text, const AutOptions& options = {}) {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const auto lts = read_aut("x.aut", text, sources, diagnostics, options);
  EXPECT_NE(lts.has_value(), diagnostics.has_errors());
  return lts ? to_text(*lts) : base::render_all(diagnostics, sources);
}

/// The first line of the first diagnostic, without its code.
std::string error(std::string_view text) {
  const std::string rendered = read(text);
  return rendered.substr(0, rendered.find(" ["));
}

TEST(AutTest, WritesSortedQuotedTransitions) {
  const Lts lts = lts_from("-> 1; 1 b.2 0; 0 tau 1; 0 tick 2; 1 a 1");
  EXPECT_EQ(write(lts),
            "des (1,4,3)\n"
            "(0,\"tau\",1)\n"
            "(0,\"tick\",2)\n"
            "(1,\"a\",1)\n"
            "(1,\"b.2\",0)\n");
  EXPECT_EQ(write(lts_from("0 tau 0"), {.tau = "i"}), "des (0,1,1)\n(0,\"i\",0)\n");
  EXPECT_EQ(write(lts_from("0")), "des (0,0,1)\n");
}

TEST(AutTest, EventsAreNotMistakenForTauAndTick) {
  const Lts lts = lts_from("0 tau 0; 0 i 0", {"i"});
  EXPECT_EQ(write(lts), "des (0,2,1)\n(0,\"tau\",0)\n(0,\"i\",0)\n");
  EXPECT_EQ(write(lts, {.tau = "i"}), "des (0,2,1)\n(0,\"i\",0)\n(0,\"\\x69\",0)\n");
  EXPECT_EQ(read(write(lts, {.tau = "i"}), {.tau = "i"}), "0 τ 0; 0 i 0");

  LtsBuilder builder(std::make_shared<const LabelNames>(
      LabelNames{std::string(tau_name), std::string(tick_name), "tau", "tick"}));
  builder.add_state();
  for (std::uint32_t l = 0; l < 4; ++l) builder.add_edge(State{0}, Label{l}, State{0});
  const std::string text = write(std::move(builder).finish(State{0}));
  EXPECT_EQ(text,
            "des (0,4,1)\n(0,\"tau\",0)\n(0,\"tick\",0)\n(0,\"\\x74au\",0)\n(0,\"\\x74ick\",0)\n");
  EXPECT_EQ(read(text), "0 τ 0; 0 ✓ 0; 0 tau 0; 0 tick 0");
}

TEST(AutTest, EscapesWhatWouldBreakTheLine) {
  LtsBuilder builder(std::make_shared<const LabelNames>(LabelNames{
      std::string(tau_name), std::string(tick_name), "say.\"a,\\b\"\r\n\t\x01", "größe.(1,2)"}));
  builder.add_state();
  builder.add_edge(State{0}, Label{2}, State{0});
  builder.add_edge(State{0}, Label{3}, State{0});
  const Lts lts = std::move(builder).finish(State{0});
  const std::string text = write(lts);
  EXPECT_EQ(text,
            "des (0,2,1)\n"
            "(0,\"say.\\\"a,\\\\b\\\"\\r\\n\\t\\x01\",0)\n"
            "(0,\"größe.(1,2)\",0)\n");
  EXPECT_EQ(read(text), to_text(lts));
}

TEST(AutTest, ReadsQuotedAndUnquotedLabels) {
  EXPECT_EQ(read("des (0,5,3)\n(0,a,1)\n(0,\"a\",2)\n(1,\"tau\",0)\n(1,tick,2)\n(2,c(1,2),0)\n"),
            "0 a 1; 0 a 2; 1 τ 0; 1 ✓ 2; 2 c(1,2) 0");
  EXPECT_EQ(read("des (0,2,2)\n(0,τ,1)\n(0,\"✓\",1)"), "0 τ 1; 0 ✓ 1; 1");
  EXPECT_EQ(read("des (0,2,1)\n(0,i,0)\n(0,tau,0)", {.tau = "i"}), "0 τ 0; 0 tau 0");
  EXPECT_EQ(read("des (0,1,1)\n(0,i,0)"), "0 i 0") << "i is an event unless it is said to be τ";
}

TEST(AutTest, ReadsLabelsOfOtherToolsAsTheyAre) {
  EXPECT_EQ(read("des (0,3,1)\n(0,\"say \\\"x\\\", \"y\"\",0)\n(0,\"\\q\\x4\\\",0)\n(0,\"\",0)"),
            "0 say \"x\", \"y\" 0; 0 \\q\\x4\\ 0; 0  0");
}

TEST(AutTest, LayoutDoesNotMatter) {
  EXPECT_EQ(read("des(1,2,2)\r\n(0,\"a\",1)\r\n(1,\"b\",0)\r\n"), "-> 1; 0 a 1; 1 b 0");
  EXPECT_EQ(read("\xEF\xBB\xBF\n  des ( 0 , 1 , 2 )  \n\n ( 0 , \"a b\" , 1 ) \n\n"), "0 a b 1; 1");
  EXPECT_EQ(read("des (0,1,2)\n(0,\ta  b ,1)"), "0 a  b 1; 1");
  EXPECT_EQ(read("des (0,1,1)\n(0,\" a \",0)"), "0  a  0") << "blanks inside quotes belong";
}

TEST(AutTest, EdgesMayComeInAnyOrderAndTwice) {
  EXPECT_EQ(read("des (0,4,3)\n(2,b,0)\n(0,a,1)\n(0,a,1)\n(1,b,2)\n"), "0 a 1; 1 b 2; 2 b 0");
}

TEST(AutTest, UnmentionedStatesAreKept) { EXPECT_EQ(read("des (4,0,5)\n"), "-> 4; 0; 1; 2; 3; 4"); }

TEST(AutTest, PointsAtTheError) {
  EXPECT_EQ(
      read("des (0,1,2)\n(0,\"a\",7)\n"),
      "x.aut:2:8: error: there is no state `7`: states are numbered from 0 and the header says "
      "that there are 2 [I003]\n"
      "(0,\"a\",7)\n"
      "       ^\n");
}

TEST(AutTest, HeaderErrors) {
  EXPECT_EQ(error(""), "x.aut:1:1: error: expected `des (initial, transitions, states)`");
  EXPECT_EQ(error("\n\n"), "x.aut:2:1: error: expected `des (initial, transitions, states)`");
  EXPECT_EQ(error("(0,a,1)\n"), "x.aut:1:1: error: expected `des (initial, transitions, states)`");
  EXPECT_EQ(error("des 0,1,2"), "x.aut:1:5: error: expected `(`");
  EXPECT_EQ(error("des (,1,2)"), "x.aut:1:6: error: expected a number");
  EXPECT_EQ(error("des (0,-1,2)"), "x.aut:1:8: error: expected a number");
  EXPECT_EQ(error("des (0 1 2, 1,2)"), "x.aut:1:8: error: expected `,`");
  EXPECT_EQ(error("des (0,1,2"), "x.aut:1:11: error: expected `)`");
  EXPECT_EQ(error("\n des (0,1,2) (0,a,1)"), "x.aut:2:14: error: nothing may follow on this line");
  EXPECT_EQ(error("des (0,0,0)"), "x.aut:1:10: error: an LTS has at least one state");
  EXPECT_TRUE(error("des (3,0,3)").starts_with("x.aut:1:6: error: there is no state `3`"));
}

TEST(AutTest, TransitionErrors) {
  const auto in_line = [](const std::string& line) { return error("des (0,1,2)\n" + line); };
  EXPECT_EQ(in_line("0,a,1)"), "x.aut:2:1: error: expected `(`");
  EXPECT_EQ(in_line("(a,a,1)"), "x.aut:2:2: error: expected a number");
  EXPECT_EQ(in_line("(0 a,1)"), "x.aut:2:4: error: expected `,`");
  EXPECT_EQ(in_line("(0)"), "x.aut:2:3: error: expected `,`");
  const std::string no_target = " error: expected a label, a comma and the target state";
  EXPECT_EQ(in_line("(0,"), "x.aut:2:4:" + no_target);
  EXPECT_EQ(in_line("(0,a)"), "x.aut:2:4:" + no_target);
  EXPECT_EQ(in_line("(0, a 1)"), "x.aut:2:5:" + no_target);
  EXPECT_EQ(in_line("(0,a,x)"), "x.aut:2:6: error: expected a number");
  EXPECT_EQ(in_line("(0,a,-1)"), "x.aut:2:6: error: expected a number");
  EXPECT_EQ(in_line("(0,a,1"), "x.aut:2:7: error: expected `)`");
  EXPECT_EQ(in_line("(0,a,1 2)"), "x.aut:2:8: error: expected `)`");
  EXPECT_EQ(in_line("(0,a,1) (1"), "x.aut:2:9: error: nothing may follow on this line");
  EXPECT_EQ(in_line("(0,,1)"), "x.aut:2:4: error: the label is missing");
  EXPECT_EQ(in_line("(0,\"a,1)"), "x.aut:2:4: error: the quotes of this label are not closed");
  EXPECT_EQ(in_line("(0,\",1)"), "x.aut:2:4: error: the quotes of this label are not closed");
  EXPECT_TRUE(in_line("(5,a,1)").starts_with("x.aut:2:2: error: there is no state `5`"));
  EXPECT_EQ(in_line("(0,\"größe\",x)"), "x.aut:2:12: error: expected a number")
      << "columns count characters";
}

TEST(AutTest, CountsAreChecked) {
  EXPECT_EQ(error("des (0,2,2)\n(0,a,1)\n"),
            "x.aut:1:8: error: the header says 2 transitions, but 1 follow");
  EXPECT_EQ(error("des (0,0,2)\n(0,a,1)\n"),
            "x.aut:1:8: error: the header says 0 transitions, but 1 follow");
  EXPECT_EQ(
      error("des (0,1,4294967295)\n(0,a,1)\n"),
      "x.aut:1:10: error: the header says 4,294,967,295 states, but the transitions can mention "
      "only 3");
}

TEST(AutTest, NumbersBeyondAllBoundsAreErrors) {
  EXPECT_EQ(error("des (0,0,4294967296)"),
            "x.aut:1:10: error: more than 4,294,967,295 states cannot be read");
  EXPECT_EQ(error("des (0,0,99999999999999999999999)"),
            "x.aut:1:10: error: this number is too large");
  EXPECT_EQ(
      error("des (0,9999999999999999999,1)"),
      "x.aut:1:8: error: the header says 9,999,999,999,999,999,999 transitions, but 0 follow");
  EXPECT_EQ(error("des (0,1,1)\n(18446744073709551616,a,0)"),
            "x.aut:2:2: error: this number is too large");
  EXPECT_TRUE(error("des (0,1,1)\n(4294967296,a,0)").starts_with("x.aut:2:2: error: there is no"));
}

TEST(AutTest, ReportsManyErrorsButNotAll) {
  std::string text = "des (0,100,1)\n";
  for (int i = 0; i < 100; ++i) text += "(0,a)\n";
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  EXPECT_FALSE(read_aut("x.aut", text, sources, diagnostics));
  EXPECT_EQ(diagnostics.error_count(), 20U);
  EXPECT_EQ(sources.position(diagnostics.all()[19].span->begin).line, 21U);
}

TEST(AutTest, BinaryAndHugeLinesGiveOneShortMessage) {
  std::string binary;
  for (int i = 0; i < 100'000; ++i) binary += static_cast<char>(i * 37);
  EXPECT_LT(read(binary).size(), 1000U);
  EXPECT_LT(read("des (0,1,1)\n(0,\"" + std::string(1'000'000, 'x') + "\",").size(), 1000U);
  EXPECT_EQ(error("des (0,1,1)\n(0,\"" + std::string(1'000'000, 'x') + "\",y)"),
            "x.aut:2:1000007: error: expected a number");
}

TEST(AutTest, EveryPrefixOfAFileIsRefusedWithAPlace) {
  const std::string text = write(lts_from("0 a 1; 1 tick 2; 0 tau 2"));
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    EXPECT_TRUE(read(text.substr(0, length)).starts_with("x.aut:")) << length;
  }
  EXPECT_EQ(read(text.substr(0, text.size() - 1)), "0 τ 2; 0 a 1; 1 ✓ 2; 2")
      << "the last line need not end in a newline";
}

TEST(AutTest, CodesAreListedInOrder) {
  for (std::size_t i = 1; i < codes::all.size(); ++i) {
    EXPECT_LT(codes::all[i - 1]->id, codes::all[i]->id);
  }
}

}  // namespace
}  // namespace perentie::lts

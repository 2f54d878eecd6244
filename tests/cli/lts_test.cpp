// perentie lts: the file that is asked for, in the format that its name implies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string rover = "corpus/rover/rover.csp";

TEST(LtsTest, WritesAutToStandardOutput) {
  const Outcome outcome = perentie({"lts", rover, "-p", "ROVER_ABORT"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output,
            "des (0,3,4)\n"
            "(0,\"move.0\",1)\n"
            "(1,\"mission_abort\",2)\n"
            "(2,\"tick\",3)\n");
  EXPECT_THAT(outcome.errors, HasSubstr("4 states, 3 transitions"));
}

TEST(LtsTest, TheNameOfTheOutputChoosesTheFormat) {
  const TemporaryFolder folder;
  const auto written = [&](const std::string& name, const std::vector<std::string>& more = {}) {
    const std::string file = (folder.path() / name).string();
    std::vector<std::string> arguments = {"-q", "lts", rover, "-p", "ROVER_SYSTEM", "-o", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = perentie(arguments);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.errors, "");
    EXPECT_EQ(outcome.output, "");
    return read_text(file);
  };
  EXPECT_THAT(written("rover.aut"), StartsWith("des (0,1028,227)\n"));
  EXPECT_THAT(written("rover.dot"), StartsWith("digraph"));
  EXPECT_TRUE(nlohmann::json::parse(written("rover.json")).is_object());
  EXPECT_THAT(written("rover.aut", {"-f", "dot"}), StartsWith("digraph"));
  EXPECT_THAT(written("named.dot", {"--state-names"}), HasSubstr("ROVER_ABORT ; ROVER_SYSTEM"));
}

TEST(LtsTest, NormalFormsHaveNoInvisibleEvents) {
  const std::string hidden = R"(ROVER_SYSTEM \ {|radiation_level|})";
  EXPECT_THAT(perentie({"lts", rover, "-p", hidden}).output, HasSubstr("\"tau\""));
  EXPECT_THAT(perentie({"lts", rover, "-p", hidden, "--tau", "i"}).output, HasSubstr("\"i\""));
  EXPECT_THAT(perentie({"lts", rover, "-p", hidden, "--normal"}).output,
              ::testing::Not(HasSubstr("tau")));
}

TEST(LtsTest, CompressesAndSaysTheSizes) {
  const TemporaryFolder folder;
  const std::string model =
      folder.file("m.csp",
                  "channel a, b, c\nP = a -> (b -> STOP [] ((c -> STOP) \\ {})) [] a -> c -> STOP\n"
                  "R = a -> b -> R\nQ = R \\ {b}\n");
  const Outcome outcome = perentie({"lts", model, "-p", "Q", "--compress", "dbisim"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output, "des (0,1,1)\n(0,\"a\",0)\n");
  EXPECT_THAT(outcome.errors,
              HasSubstr("2 states, 2 transitions; dbisim: 1 states, 1 transitions"));
  for (const char* name : {"sbisim", "wbisim", "tau_loop_factor", "diamond", "normal"}) {
    EXPECT_EQ(perentie({"lts", model, "-p", "P", "--compress", name}).exit_code, 0) << name;
  }
  EXPECT_EQ(perentie({"lts", model, "-p", "P", "--compress", "magic"}).exit_code, 2);
  EXPECT_EQ(perentie({"lts", model, "-p", "P", "--compress", "normal", "--normal"}).exit_code, 2);
}

TEST(LtsTest, ReadsAutFiles) {
  const TemporaryFolder folder;
  const std::string graph = folder.file("g.aut", "des (0,2,3)\n(0,\"i\",1)\n(1,\"a\",2)\n");
  EXPECT_EQ(perentie({"lts", graph, "--tau", "i", "--compress", "wbisim"}).output,
            "des (0,1,2)\n(0,\"a\",1)\n");
  EXPECT_EQ(perentie({"lts", graph, "-f", "fsm"}).output, "---\n\n\n\n---\n1 2 \"i\"\n2 3 \"a\"\n");
  EXPECT_THAT(perentie({"lts", graph, "-f", "graphml"}).output, HasSubstr("<graphml"));
  EXPECT_EQ(perentie({"lts", graph, "-p", "P"}).exit_code, 2);
  EXPECT_EQ(perentie({"lts", graph, "--state-names"}).exit_code, 2);
  EXPECT_EQ(perentie({"lts", rover}).exit_code, 2) << "a script without --process";
  EXPECT_EQ(perentie({"lts", folder.file("bad.aut", "des (0")}).exit_code, 5);
  EXPECT_EQ(perentie({"lts", "absent.aut"}).exit_code, 5);
}

TEST(LtsTest, AnExhaustedBudgetWritesNothing) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "rover.aut";
  const Outcome outcome =
      perentie({"lts", rover, "-p", "ROVER_SYSTEM", "-o", file.string(), "--max-states", "3"});
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.errors, HasSubstr("inconclusive: the limit of 3 states was reached"));
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(LtsTest, WorkersChangeNothing) {
  const auto graph = [](const char* workers) {
    return perentie({"-q", "lts", "corpus/philosophers/philosophers.csp", "-p", "SYSTEM(5)",
                     "--workers", workers});
  };
  const Outcome alone = graph("1");
  EXPECT_THAT(alone.output, StartsWith("des (0,34240,7774)\n"));
  EXPECT_EQ(graph("3").output, alone.output);
  EXPECT_EQ(graph("0").exit_code, 2);
}

TEST(LtsTest, ErrorsOfTheModelAndOfFiles) {
  const TemporaryFolder folder;
  EXPECT_EQ(perentie({"lts", folder.file("m.csp", "P = ("), "-p", "P"}).exit_code, 3);
  EXPECT_EQ(perentie({"lts", rover, "-p", "NOWHERE"}).exit_code, 3);
  EXPECT_EQ(perentie({"lts", rover, "-p", "1 + 1"}).exit_code, 3);
  EXPECT_EQ(perentie({"lts", (folder.path() / "missing.csp").string(), "-p", "P"}).exit_code, 5);
  const Outcome outcome =
      perentie({"lts", rover, "-p", "STOP", "-o", (folder.path() / "no/where.aut").string()});
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.errors, HasSubstr("cannot write"));
  EXPECT_EQ(perentie({"lts", rover, "-p", "STOP", "-o", "/dev/full"}).exit_code, 5);
}

TEST(LtsTest, StatsSayWhatTheProcessIsMadeOf) {
  TemporaryFolder folder;
  const std::string model = folder.file("m.csp", R"(
channel a, b
P = a -> a -> P
Q = b -> Q
R = (P ||| SKIP) ; R
)");
  const Outcome plain = perentie({"-q", "lts", model, "-p", "P ||| P ||| Q", "--stats"});
  EXPECT_EQ(plain.exit_code, 0);
  EXPECT_EQ(plain.output,
            "machine: compiled, 3 rules, 8 bytes a state\n"
            "leaves: 3, 2 different\n"
            "  2 x P: 2 states, 2 transitions\n"
            "  1 x Q: 1 states, 1 transitions\n"
            "whole: 4 states, 12 transitions, repeated ones included\n");
  const std::string file = (folder.path() / "out.aut").string();
  const Outcome small = perentie({"-q", "lts", model, "-p", "P ||| P ||| Q", "--stats",
                                  "--compress-leaves", "sbisim", "-o", file});
  EXPECT_THAT(small.output, HasSubstr("P: 2 states, 2 transitions; compressed: 1 states, 1 "));
  EXPECT_THAT(small.output, HasSubstr("whole: 1 states, 2 transitions\n"));
  EXPECT_EQ(read_text(file), "des (0,2,1)\n(0,\"a\",0)\n(0,\"b\",0)\n");
  EXPECT_THAT(perentie({"lts", model, "-p", "R", "--stats"}).output,
              HasSubstr("machine: made as it is explored, 1 formats, "));
  const std::string graph = folder.file("g.aut", "des (0,0,1)\n");
  EXPECT_EQ(perentie({"lts", graph, "--stats"}).exit_code, 2);
}

}  // namespace
}  // namespace perentie::test

// perentie refines: FDR's layouts, keys, flags and exit codes (CSPM reference 7.1-7.3), and
// programs that read them.
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <boost/property_tree/xml_parser.hpp>
#include <nlohmann/json.hpp>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// Runs the subcommand on a script called t.csp in a folder of its own.
Outcome refines(const std::string& script, std::vector<std::string> options) {
  const TemporaryFolder folder;
  folder.file("t.csp", script);
  std::vector<std::string> words{"refines", "t.csp"};
  words.insert(words.end(), options.begin(), options.end());
  return perentie(words, {.folder = folder.path()});
}

json document(const std::string& script, std::vector<std::string> options = {}) {
  options.insert(options.end(), {"--quiet", "--format", "json"});
  return json::parse(refines(script, std::move(options)).output);
}

json first_counterexample(const std::string& script, std::vector<std::string> options = {}) {
  return document(script, std::move(options)).at("results")[0].at("counterexamples").at(0);
}

constexpr const char* two =
    "channel a, b\nP = a -> b -> P\nassert STOP [T= P \\ {a}\nassert P [T= STOP\n";

TEST(RefinesTest, BriefIsOneLineForEachAssertion) {
  EXPECT_EQ(refines(two, {"--brief", "--quiet", "--format=plain"}).output,
            "STOP [T= P \\ {a}: Failed\nP [T= STOP: Passed\n");
}

// Figures of FDR's manual: 181 states, 493 transitions, 9 plys.
TEST(RefinesTest, TextHasTheLayoutOfFdr) {
  const Outcome outcome =
      perentie({"refines", "-q", "-f", "plain", "corpus/check/philosophers.csp"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output,
              StartsWith("Table :[deadlock free [F]]:\n"
                         "    Log:\n"
                         "        Result: Failed\n"
                         "        Visited States: 181\n"
                         "        Visited Transitions: 493\n"
                         "        Visited Plys: 9\n"
                         "        Counterexample (Deadlock Counterexample)\n"
                         "            Machine Debug:\n"
                         "                Table (Failure Behaviour):\n"
                         "                    Trace: <thinks.0, sits.0, takes.0.0, thinks.1, "
                         "sits.1, takes.1.1, thinks.2,\n"
                         "                    sits.2, takes.2.2>\n"
                         "                    Min Acceptance: {}\n"));
}

TEST(RefinesTest, HiddenEventsAreRevealed) {
  const Outcome outcome = refines(two, {"--reveal-taus", "--format", "plain"});
  EXPECT_THAT(outcome.output, HasSubstr("            Implementation Debug:\n"
                                        "                <unnamed> (Trace Behaviour):\n"
                                        "                    Trace: <τ>\n"
                                        "                    Error Event: b\n"
                                        "                    Unhidden trace: <a>\n"));
}

TEST(RefinesTest, ColourWhereItIsAskedFor) {
  EXPECT_THAT(refines(two, {"-b", "-f", "colour"}).output, HasSubstr("\033[32mPassed\033[m"));
  EXPECT_THAT(refines(two, {"-b", "-f", "colour"}).output, HasSubstr("\033[31mFailed\033[m"));
  EXPECT_THAT(refines(two, {"-b"}).output, Not(HasSubstr("\033")));
}

TEST(RefinesTest, JsonToTheByte) {
  EXPECT_EQ(
      refines(two, {"-q", "-f", "json", "--reveal-taus"}).output,
      R"-({"results":[{"assertion_string":"STOP [T= P \\ {a}","errors":[],"is_negated":0,)-"
      R"-("result":0,"visited_states":2,"visited_transitions":3,"visited_plys":1,)-"
      R"-("counterexamples":[{"type":"trace",)-"
      R"-("specification_behaviour":{"machine_name":"normal(…)","type":"trace",)-"
      R"-("error_event":0,"trace":[0],"states":["normal(…)","<unnamed>"]},)-"
      R"-("implementation_behaviour":{"type":"trace","error_event":3,"trace":[1],)-"
      R"-("states":["<unnamed>","<unnamed>"],"revealed_trace":[4]}}]},)-"
      R"-({"assertion_string":"P [T= STOP","errors":[],"is_negated":0,"result":1,)-"
      R"-("visited_states":1,"visited_transitions":1,"visited_plys":1,"counterexamples":[]}],)-"
      R"-("print_statement_results":[],"file_name":"t.csp",)-"
      R"-("event_map":{"0":"0","1":"τ","2":"✓","3":"b","4":"a"},)-"
      R"-("warnings":[],"errors":[]})-"
      "\n");
}

TEST(RefinesTest, SlashesAreEscaped) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.csp", "assert STOP [T= STOP");
  EXPECT_THAT(perentie({"refines", "-q", "-f", "json", file}).output, HasSubstr(R"(\/t.csp")"));
}

TEST(RefinesTest, EveryTypeOfCounterexample) {
  const std::string head = "channel a, b\nP = a -> P\nassert ";
  const auto type = [&](const std::string& assertion) {
    return first_counterexample(head + assertion)["type"];
  };
  EXPECT_EQ(type("STOP [T= P"), "trace");
  EXPECT_EQ(type("P [F= STOP"), "failure");
  EXPECT_EQ(type("P [FD= DIV"), "refinement_divergence");
  EXPECT_EQ(type("STOP :[deadlock free]"), "deadlock");
  EXPECT_EQ(type("DIV :[deadlock free [FD]]"), "deadlock");
  EXPECT_EQ(type("P \\ {a} :[divergence free]"), "divergence");
  EXPECT_EQ(type("STOP |~| P :[deterministic]"), "determinism");
  EXPECT_EQ(type("P :[has trace [T]]: <b>"), "trace");
  EXPECT_EQ(type("STOP |~| P :[has trace]: <a>"), "failure");
  EXPECT_EQ(type("DIV :[has trace]: <a>"), "refinement_divergence");
}

TEST(RefinesTest, BehavioursSayHowTheyEnd) {
  const json refusal = first_counterexample("channel a\nP = a -> SKIP\nassert P :[deadlock free]");
  EXPECT_FALSE(refusal.contains("specification_behaviour"));
  EXPECT_EQ(refusal["implementation_behaviour"],
            json::parse(R"({"machine_name":"P","type":"min_acceptance","acceptance":[],)"
                        R"("trace":[3,2],"states":["P","<unnamed>","<unnamed>"]})"));

  const json loop = first_counterexample(
      "channel a, b\nP = a -> Q\nQ = b -> Q\nassert P \\ {b} :[divergence free]");
  EXPECT_EQ(loop["implementation_behaviour"]["type"], "loop");
  EXPECT_EQ(loop["implementation_behaviour"]["loop_start"], 1);
  EXPECT_EQ(loop["implementation_behaviour"]["trace"], json({3, 1}));

  const json both = first_counterexample(
      "channel a, b\nP = a -> (STOP |~| b -> STOP)\nassert P :[deterministic]");
  EXPECT_EQ(both["specification_behaviour"]["type"], "trace");
  EXPECT_EQ(both["specification_behaviour"]["error_event"], 3);
  EXPECT_EQ(both["implementation_behaviour"]["type"], "min_acceptance");

  const json alone = first_counterexample("assert DIV :[deterministic]");
  EXPECT_EQ(alone["specification_behaviour"]["type"], "irrelevant");
}

// A counterexample shows that a negated assertion holds.
TEST(RefinesTest, NegatedAssertions) {
  const json results =
      document("channel a\nassert not STOP [T= a -> STOP\nassert not STOP [T= STOP").at("results");
  EXPECT_EQ(results[0]["is_negated"], 1);
  EXPECT_EQ(results[0]["result"], 1);
  EXPECT_EQ(results[0]["counterexamples"].size(), 1U);
  EXPECT_EQ(results[1]["result"], 0);
  EXPECT_EQ(results[1]["counterexamples"].size(), 0U);
  EXPECT_EQ(results[0]["assertion_string"], "not STOP [T= a -> STOP");
}

void expect_aligned(const json& behaviour, std::size_t length) {
  EXPECT_EQ(behaviour["trace"].size(), length) << behaviour;
  if (behaviour.contains("states")) {
    EXPECT_EQ(behaviour["states"].size(), length + 1);
  }
  if (!behaviour.contains("child_behaviours")) return;
  for (const json& child : behaviour["child_behaviours"]) expect_aligned(child, length);
}

TEST(RefinesTest, ComponentsAreAligned) {
  const std::string script =
      "channel a, b, c\nP = a -> b -> P\nQ = b -> c -> Q\n"
      "S = (P [|{b}|] Q) \\ {b}\nassert a -> STOP [T= S\n"
      "assert a -> (c -> STOP |~| STOP) ||| b -> STOP :[deterministic]";
  const json results = document(script, {"--divide"})["results"];
  const json& first = results[0]["counterexamples"][0];
  const json& whole = first["implementation_behaviour"];
  EXPECT_EQ(whole["trace"], json({3, 1}));
  const json& parallel = whole["child_behaviours"].at(0);
  EXPECT_EQ(parallel["child_behaviours"][0]["machine_name"], "P");
  EXPECT_EQ(parallel["child_behaviours"][0]["trace"], json({3, 4}));
  EXPECT_EQ(parallel["child_behaviours"][0]["error_event"], 3);
  EXPECT_EQ(parallel["child_behaviours"][1]["trace"], json({0, 4}));
  EXPECT_EQ(parallel["child_behaviours"][1]["error_event"], 0);
  for (const json& result : results) {
    const json& found = result["counterexamples"][0];
    const std::size_t length = found["implementation_behaviour"]["trace"].size();
    expect_aligned(found["implementation_behaviour"], length);
    expect_aligned(found["specification_behaviour"], length);
  }
  EXPECT_FALSE(
      first_counterexample(script)["implementation_behaviour"].contains("child_behaviours"));
}

TEST(RefinesTest, ErrorsAreInTheDocument) {
  const Outcome outcome = refines("channel a\nP = STPO\n", {"-q", "-f", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << "a document about errors is valid output";
  EXPECT_EQ(outcome.errors, "");
  const json found = json::parse(outcome.output);
  EXPECT_THAT(found["errors"][0].get<std::string>(),
              StartsWith("t.csp:2:5-9:\n    `STPO` is not in scope"));
  EXPECT_EQ(found["results"], json::array());

  const json evaluated = document("channel c : {0}\nassert c.1 -> STOP [T= STOP");
  EXPECT_EQ(evaluated["results"][0].size(), 2U) << evaluated;
  EXPECT_EQ(evaluated["results"][0]["errors"].size(), 1U);
}

TEST(RefinesTest, ErrorsInTextAndTypeChecks) {
  const Outcome text = refines("P = STPO", {"-q", "-f", "plain"});
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_EQ(text.output, "");
  EXPECT_THAT(text.errors, StartsWith("t.csp:1:5-9:\n    `STPO` is not in scope"));
  EXPECT_EQ(refines("x = 1 + true", {"--typecheck"}).exit_code, 1);
  EXPECT_EQ(refines("x = 1 + true", {"--typecheck", "-f", "json"}).exit_code, 1);
  const Outcome fine = refines("assert STOP [T= SKIP", {"-t", "-q", "-f", "plain"});
  EXPECT_EQ(fine.exit_code, 0);
  EXPECT_EQ(fine.output, "") << "nothing is checked";
}

TEST(RefinesTest, BudgetsAreNoVerdicts) {
  const json found =
      document("channel c : Int\nN(i) = c.i -> N(i + 1)\nassert N(0) :[deadlock free]",
               {"--max-states", "50"});
  const json& result = found["results"][0];
  EXPECT_FALSE(result.contains("result"));
  EXPECT_THAT(result["errors"][0].get<std::string>(), StartsWith("inconclusive: "));
}

TEST(RefinesTest, PrintStatements) {
  const json prints = document("print 1+1\nprint head(<>)")["print_statement_results"];
  EXPECT_EQ(prints[0], json::parse(R"({"print_statement":"1+1","location":"t.csp:1:1-10",)"
                                   R"("errors":[],"result":"2"})"));
  EXPECT_EQ(prints[1]["errors"].size(), 1U);
  for (const std::string wrong : {"print foo", "print 1 + true"}) {  // concerns itself only
    const json all = document(wrong + "\nassert STOP [T= STOP");
    EXPECT_EQ(all["errors"], json::array());
    EXPECT_EQ(all["results"][0]["result"], 1);
    EXPECT_EQ(all["print_statement_results"][0]["errors"].size(), 1U);
  }
  EXPECT_THAT(refines("print 1+1", {"-q", "-f", "plain"}).output,
              HasSubstr("1+1:\n    Result: 2\n"));
}

TEST(RefinesTest, FramedJsonIsADocumentForEachResult) {
  const Outcome outcome =
      refines(std::string(two) + "print 7\n", {"--quiet", "--format=framed_json"});
  std::istringstream lines(outcome.output);
  std::size_t results = 0;
  std::size_t prints = 0;
  std::size_t documents = 0;
  for (std::string line; std::getline(lines, line); ++documents) {
    const json found = json::parse(line);
    EXPECT_EQ(found["file_name"], "t.csp");
    results += found["results"].size();
    prints += found["print_statement_results"].size();
  }
  EXPECT_EQ(documents, 3U);
  EXPECT_EQ(results, 2U);
  EXPECT_EQ(prints, 1U);
}

TEST(RefinesTest, XmlHasTheSameContents) {
  std::istringstream text(refines(two, {"-q", "-f", "xml"}).output);
  boost::property_tree::ptree tree;
  boost::property_tree::read_xml(text, tree);
  EXPECT_EQ(tree.get<std::string>("file.event_map.i_3"), "b");
  EXPECT_EQ(tree.get<int>("file.results.item.visited_transitions"), 3);
  EXPECT_EQ(tree.get<std::string>("file.results.item.assertion_string"), "STOP [T= P \\ {a}");
}

TEST(RefinesTest, YamlHasTheSameContents) {
  const std::string text = refines(two, {"-q", "-f", "yaml"}).output;
  EXPECT_THAT(text, StartsWith("results:\n  - assertion_string: \"STOP [T= P \\\\ {a}\"\n"));
  EXPECT_THAT(text, HasSubstr("    visited_transitions: 3\n"));
  EXPECT_THAT(text, HasSubstr("  3: \"b\"\n"));
}

TEST(RefinesTest, TheNumberOfWorkersChangesNothing) {
  const auto with = [](const std::string& workers) {
    return perentie({"refines", "-f", "json", "--divide", "--refinement-bfs-workers", workers,
                     "corpus/check/golden_vectors.csp", "corpus/check/forms.csp"})
        .output;
  };
  const std::string one = with("1");
  EXPECT_THAT(one, HasSubstr("counterexamples"));
  EXPECT_EQ(one, with("2"));
  EXPECT_EQ(one, with("16"));
}

TEST(RefinesTest, OptionsOfFdrAreRead) {
  const std::vector<std::string> options{"--brief",
                                         "--quiet",
                                         "--compiler-leaf-compression=none",
                                         "--compiler-reuse-machines",
                                         "Off",
                                         "--cspm-evaluator-heap-size=4G",
                                         "--refinement-cluster-homogeneous",
                                         "true",
                                         "--refinement-storage-file-path",
                                         "a,b",
                                         "--refinement-storage-file-cache-size=90%",
                                         "--refinement-storage-compressor=LZ4HC",
                                         "--refinement-explorer-storage-type",
                                         "LSMTree"};
  const Outcome outcome = refines(two, options);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(refines(two, {"--compiler-leaf-compression=often"}).exit_code, 2);
  EXPECT_EQ(refines(two, {"--refinement-bfs-workers", "0"}).exit_code, 2);
  EXPECT_EQ(refines(two, {"--refinement-bfs-workers", "5000"}).exit_code, 0);
  EXPECT_EQ(refines(two, {"--no-such-flag"}).exit_code, 2);
  EXPECT_EQ(refines(two, {"--format", "html"}).exit_code, 2);
  const Outcome archive = refines(two, {"--archive", "out"});
  EXPECT_EQ(archive.exit_code, 2);
  EXPECT_THAT(archive.errors, HasSubstr("--archive is not supported"));
  const json without = document(two, {"--refinement-track-history", "Off"});
  EXPECT_EQ(without["results"][0]["result"], 0);
  EXPECT_EQ(without["results"][0]["counterexamples"], json::array());
  EXPECT_EQ(without["event_map"], json::object());
}

TEST(RefinesTest, ReadsStandardInput) {
  const Outcome outcome = perentie({"refines", "-b", "-q", "-"}, {.input = "assert STOP [T= STOP"});
  EXPECT_EQ(outcome.output, "STOP [T= STOP: Passed\n");
}

TEST(RefinesTest, ExitCodesOfOursOnDemand) {
  EXPECT_EQ(refines(two, {"--strict-exit"}).exit_code, 1);
  EXPECT_EQ(refines("x =", {"--strict-exit"}).exit_code, 3);
  EXPECT_EQ(refines("assert STOP [T= STOP", {"--strict-exit"}).exit_code, 0);
}

// A folder with a program `refines`, first on the PATH.
Surroundings with_refines(const TemporaryFolder& folder) {
  std::string script = "#!/bin/sh\nexec";
  for (const std::string& word : perentie_command()) script += " '" + word + "'";
  chmod(folder.file("refines", script + " refines \"$@\"\n").c_str(), 0755);
  const char* path = std::getenv("PATH");
  return {.variables = {{"PATH", folder.path().string() + ":" + (path == nullptr ? "" : path)},
                        {"PYTHONIOENCODING", "utf-8"}}};
}

TEST(RefinesTest, WorksUnderTheNameOfRefines) {
  const std::vector<std::string> command = perentie_command();
  if (command.size() != 1) GTEST_SKIP() << "an emulator runs the program";
  const TemporaryFolder folder;
  std::filesystem::create_symlink(std::filesystem::absolute(command[0]), folder.path() / "refines");
  const Outcome outcome = run({(folder.path() / "refines").string(), "-b", "-q", "-"},
                              {.input = "assert STOP [T= SKIP"});
  EXPECT_EQ(outcome.output, "STOP [T= SKIP: Failed\n") << outcome.errors;
}

bool has_python() { return run({"sh", "-c", "command -v python3"}).exit_code == 0; }

TEST(RefinesTest, ProgramsThatReadJsonWork) {
  if (!has_python()) GTEST_SKIP() << "there is no python3";
  const TemporaryFolder folder;
  const Outcome outcome =
      run({"python3", "tests/cli/python/report_results.py", "corpus/check/philosophers.csp"},
          with_refines(folder));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output,
              StartsWith("Table :[deadlock free [F]]: Failed, 181 states\n"
                         "  deadlock\n"
                         "    implementation Table <thinks.0, sits.0, takes.0.0, thinks.1, sits.1, "
                         "takes.1.1, thinks.2, sits.2, takes.2.2> offering {}\n"));
  EXPECT_THAT(outcome.output, HasSubstr("component Philosopher(0) <thinks.0, sits.0, takes.0.0, 0, "
                                        "0, 0, 0, 0, 0> offering {takes.0.1}\n"));
}

TEST(RefinesTest, ProgramsThatFollowFramedJsonWork) {
  if (!has_python()) GTEST_SKIP() << "there is no python3";
  const TemporaryFolder folder;
  const std::string file = folder.file("t.csp", std::string(two) + "print 2 * 3\n");
  const Outcome outcome =
      run({"python3", "tests/cli/python/follow_results.py", file}, with_refines(folder));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "NOT OK STOP [T= P \\ {a}\nok P [T= STOP\nprint 6 at " + file +
                                ":5:1-12\n1 of the assertions do not hold\n");
}

}  // namespace
}  // namespace perentie::test

// The assertions of corpus/check: outcomes, counts and counterexamples are those that the comments
// say, and a counterexample can be replayed by the step rules.
//
// A comment `-- expect: OUTCOME S/T/P KIND after <TRACE>` speaks of the next assertion. The counts
// are visited states, transitions and plys; counts, kind and trace may be left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "perentie/semantics/check.hpp"
#include "perentie/test/corpus.hpp"
#include "perentie/test/paths.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

namespace fs = std::filesystem;

struct Expectation {
  std::string outcome, counts, kind;
  std::optional<std::string> trace;  // with its brackets
};

// By line of the assertion.
std::map<std::size_t, Expectation> expectations(const fs::path& path) {
  static const std::regex form(
      R"(^-- expect: (\w+)( \d+/\d+/\d+)?(?: (event|acceptance|divergence|deadlock|nondeterminism|missing event)(?: after (<.*>))?)?$)");
  std::map<std::size_t, Expectation> found;
  std::ifstream stream(path);
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.find("expect:") == std::string::npos) continue;
    std::smatch m;
    if (!std::regex_match(line, m, form)) {
      ADD_FAILURE() << path << ":" << number << ": not understood: " << line;
      continue;
    }
    Expectation e{m[1], m[2].str(), m[3], std::nullopt};
    if (!e.counts.empty()) e.counts.erase(0, 1);
    if (m[4].matched) e.trace = m[4];
    found[number + 1] = e;
  }
  return found;
}

// The states after a trace of names, with τ; empty: the process cannot do it.
std::set<ProcId> after(TermSystem& system, const std::vector<std::string>& trace) {
  std::set<ProcId> states{system.initial()};
  std::vector<lts::Transition<ProcId>> steps;
  for (const std::string& event : trace) {
    std::set<ProcId> next;
    for (const ProcId state : states) {
      steps.clear();
      EXPECT_TRUE(system.successors(state, steps));
      const auto names = system.label_names();
      for (const auto& step : steps) {
        if ((*names)[step.label.value] == event) next.insert(step.target);
      }
    }
    states = std::move(next);
  }
  return states;
}

// The labels that a state offers, as sorted names.
std::vector<std::string> offers(TermSystem& system, ProcId state) {
  std::vector<lts::Transition<ProcId>> steps;
  EXPECT_TRUE(system.successors(state, steps));
  const auto names = system.label_names();
  std::set<std::string> found;
  for (const auto& step : steps) found.insert((*names)[step.label.value]);
  return {found.begin(), found.end()};
}

std::vector<std::string> sorted(std::vector<std::string> names) {
  std::ranges::sort(names);
  return names;
}

bool contains(const std::vector<std::string>& names, std::string_view wanted) {
  return std::ranges::find(names, wanted) != names.end();
}

// Replays a counterexample: some state after its trace behaves as it says.
void replay(TermSystem system, const Witness& w) {
  const std::set<ProcId> states = after(system, w.trace);
  ASSERT_FALSE(states.empty()) << "the process cannot perform the trace";
  bool shown = false;
  for (const ProcId state : states) {
    const std::vector<std::string> offered = offers(system, state);
    switch (w.kind) {
      case Witness::Kind::event:
        shown = shown || contains(offered, w.event);
        break;
      case Witness::Kind::acceptance:
        shown = shown || offered == sorted(w.offered);
        break;
      case Witness::Kind::deadlock:
        shown = shown || offered.empty();
        break;
      case Witness::Kind::nondeterminism:
        shown = shown || (!contains(offered, lts::tau_name) && !contains(offered, w.event));
        break;
      case Witness::Kind::divergence:
        shown = shown || contains(offered, lts::tau_name);
        break;
      case Witness::Kind::missing_event:
        shown = true;
        break;
    }
  }
  EXPECT_TRUE(shown) << "no state after the trace does it";
}

// The process that a counterexample is one of.
parser::ExprId implementation(const parser::Assertion& assertion) {
  if (const auto* r = std::get_if<parser::RefinementAssertion>(&assertion.claim)) {
    return r->implementation;
  }
  if (const auto* p = std::get_if<parser::PropertyAssertion>(&assertion.claim)) return p->process;
  return std::get<parser::HasTraceAssertion>(assertion.claim).process;
}

class CheckCorpusTest : public ::testing::TestWithParam<fs::path> {};

TEST_P(CheckCorpusTest, EveryAssertionComesOutAsItsCommentSays) {
  const auto expected = expectations(GetParam());
  const auto script = TestScript::of_file(GetParam());
  ASSERT_TRUE(script->loaded()) << script->messages();
  const auto assertions = assertions_of(script->script().tree());
  EXPECT_EQ(assertions.size(), expected.size()) << "an assertion without a comment, or the reverse";
  for (const ScriptAssertion& assertion : assertions) {
    const auto position = script->sources().position(assertion.span.begin);
    SCOPED_TRACE(fmt::format("{}:{}: {}", position.path, position.line, assertion.text));
    ASSERT_TRUE(expected.contains(position.line));
    const Expectation& expectation = expected.at(position.line);
    base::Diagnostics diagnostics;
    const CheckResult result = check(script->script(), assertion, {}, diagnostics);
    EXPECT_EQ(name_of(result.outcome), expectation.outcome)
        << base::render_all(diagnostics, script->sources());
    if (!expectation.counts.empty()) {
      EXPECT_EQ(fmt::format("{}/{}/{}", result.counts.states, result.counts.transitions,
                            result.counts.plys),
                expectation.counts);
    }
    // A counterexample is there iff the claim, without `not`, fails.
    const bool is_refuted =
        (result.outcome == CheckResult::Outcome::fails) != assertion.assertion.negated;
    ASSERT_EQ(result.witness.has_value(), is_refuted);
    if (!result.witness) continue;
    EXPECT_EQ(name_of(result.witness->kind), expectation.kind);
    if (expectation.trace) {
      EXPECT_EQ(fmt::format("<{}>", fmt::join(result.witness->trace, ", ")), *expectation.trace);
    }
    const auto process =
        script->script().process(implementation(assertion.assertion), assertion, diagnostics);
    ASSERT_TRUE(process);
    // A trace that cannot be performed is found in the normal form: its witness has no τ.
    if (std::holds_alternative<parser::HasTraceAssertion>(assertion.assertion.claim)) continue;
    replay(script->script().terms(*process, diagnostics), *result.witness);
  }
}

std::string file_name(const ::testing::TestParamInfo<fs::path>& info) {
  return info.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(Corpus, CheckCorpusTest,
                         ::testing::ValuesIn(test::scripts_in(test::corpus() / "check")),
                         file_name);

}  // namespace
}  // namespace perentie::semantics

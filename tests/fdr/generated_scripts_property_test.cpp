// Random scripts through our `refines`: verdicts and counts against refinement by definition, and
// every counterexample replayed. Where FDR is installed the same scripts go through it.
#include <fstream>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "gen_script.hpp"
#include "perentie/lts/determinism.hpp"
#include "perentie/lts/divergence.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/test/refinement_oracle.hpp"
#include "replay.hpp"
#include "run_perentie.hpp"

namespace perentie::test {
namespace {

using semantics::ProcId;
using semantics::ScriptAssertion;

// Larger processes are left out.
constexpr std::size_t max_states = 3'000;

struct Loaded {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  std::unique_ptr<semantics::Script> script;
  std::vector<ScriptAssertion> assertions;

  explicit Loaded(const std::string& text) {
    script = semantics::Script::load(*sources.add("generated.csp", text), sources, diagnostics);
    if (script) assertions = semantics::assertions_of(script->tree());
  }
  std::string messages() const { return base::render_all(diagnostics, sources); }
};

// The process as a graph; nothing: it has more than `most` states. Graphs of one script have the
// same labels if all their events are known, so each is explored twice.
std::optional<lts::Lts> graph_of(Loaded& loaded, parser::ExprId process,
                                 const ScriptAssertion& assertion, std::uint64_t most) {
  const auto term = loaded.script->process(process, assertion, loaded.diagnostics);
  RC_ASSERT(term.has_value());
  semantics::TermSystem terms = loaded.script->terms(*term, loaded.diagnostics);
  auto found = lts::explore(terms, {.limits = {.max_states = most}});
  if (!found.complete()) return std::nullopt;
  return std::move(found.lts);
}

Semantics semantics_of(parser::Model model) {
  return model == parser::Model::traces     ? Semantics::traces
         : model == parser::Model::failures ? Semantics::failures
                                            : Semantics::failures_divergences;
}

// What a result must be by definition; nothing: the processes are too large. `counted`, if it is
// there, is the result whose counts must be those of the definition.
std::optional<bool> expected(Loaded& loaded, const ScriptAssertion& assertion,
                             const parser::RefinementAssertion& claim, const Json* counted) {
  constexpr std::uint64_t most = 64;
  std::optional<lts::Lts> specification;
  std::optional<lts::Lts> implementation;
  for (int i = 0; i < 2; ++i) {
    specification = graph_of(loaded, claim.specification, assertion, most);
    implementation = graph_of(loaded, claim.implementation, assertion, most);
    if (!specification || !implementation) return std::nullopt;
  }
  const Semantics model = semantics_of(claim.model);
  if (counted != nullptr) {
    const NaiveCounts counts = naive_counts(*specification, *implementation, model);
    const auto count = [&](const char* key) { return counted->at(key).get<std::uint64_t>(); };
    RC_ASSERT(count("visited_states") == counts.states);
    RC_ASSERT(count("visited_plys") == counts.plys);
    // A graph has each transition once; FDR and we count repetitions.
    RC_ASSERT(count("visited_transitions") >= counts.transitions);
  }
  return !naive_refutation(*specification, *implementation, model).has_value();
}

std::optional<bool> expected(Loaded& loaded, const ScriptAssertion& assertion,
                             const parser::PropertyAssertion& claim, const Json*) {
  const auto graph = graph_of(loaded, claim.process, assertion, max_states);
  if (!graph) return std::nullopt;
  const bool with_divergence = !claim.model || *claim.model != parser::Model::failures;
  const auto divergent = lts::divergent_states(*graph);
  const bool diverges = std::find(divergent.begin(), divergent.end(), true) != divergent.end();
  switch (claim.property) {
    case parser::Property::divergence_free:
      return !diverges;
    case parser::Property::deadlock_free: {
      bool deadlocks = false;
      for (std::uint32_t s = 0; s < graph->state_count(); ++s) {
        deadlocks = deadlocks || graph->edges(lts::State{s}).empty();
      }
      return !deadlocks && !(with_divergence && diverges);
    }
    case parser::Property::deterministic:
      break;
  }
  const auto model = with_divergence ? lts::DeterminismModel::failures_divergences
                                     : lts::DeterminismModel::failures;
  return std::holds_alternative<lts::Deterministic>(lts::check_determinism(*graph, model));
}

// CSPM reference 5.3.8.
std::optional<bool> expected(Loaded& loaded, const ScriptAssertion& assertion,
                             const parser::HasTraceAssertion& claim, const Json*) {
  const auto graph = graph_of(loaded, claim.process, assertion, 64);
  if (!graph) return std::nullopt;
  const parser::Model model = claim.model.value_or(parser::Model::failures_divergences);
  StateSet states = tau_closure(*graph, StateSet{1} << graph->initial().value);
  for (const parser::ExprId expr : loaded.script->tree().list(claim.trace)) {
    const auto event = loaded.script->evaluate(expr, loaded.diagnostics);
    RC_ASSERT(event.has_value());
    const auto label = graph->find_label(*event);
    if (!label) return false;
    for (std::uint32_t s = 0; s < graph->state_count(); ++s) {
      if (!contains(states, s) || model == parser::Model::traces) continue;
      if (is_stable(*graph, s) && graph->edges(lts::State{s}, *label).empty()) return false;
    }
    const bool diverges = any_diverges(*graph, states);
    if (model == parser::Model::failures_divergences && diverges) return false;
    states = tau_closure(*graph, step(*graph, states, *label));
    if (states == 0) return false;
  }
  return true;
}

void check_by_definition(Loaded& loaded, const ScriptAssertion& assertion, const Json& result,
                         bool with_counts) {
  const Json* counted = with_counts ? &result : nullptr;
  const auto holds =
      std::visit([&](const auto& claim) { return expected(loaded, assertion, claim, counted); },
                 assertion.assertion.claim);
  if (!holds) return;
  RC_ASSERT((result["result"] == 1) == (*holds != assertion.assertion.negated));
}

std::filesystem::path written(const TemporaryFolder& folder, const GenScript& script) {
  return folder.file("generated.csp", to_text(script));
}

RC_GTEST_PROP(GeneratedScriptsTest, VerdictsCountsAndCounterexamplesAreRight, ()) {
  const GenScript script = *gen_script();
  const TemporaryFolder folder;
  // The counts by definition are those of processes that are not compressed: neither leaves nor by
  // the script.
  const std::string leaf_compression = *rc::gen::element<std::string>("none", "sbisim");
  const Json document = our_document(written(folder, script), max_states, leaf_compression);
  const bool with_counts =
      leaf_compression == "none" && to_text(script).find("normal(") == std::string::npos;
  Loaded loaded(to_text(script));
  RC_ASSERT(loaded.script != nullptr);
  RC_ASSERT(document["results"].size() == loaded.assertions.size());
  for (std::size_t i = 0; i < loaded.assertions.size(); ++i) {
    const Json& result = document["results"][i];
    RC_ASSERT(result["assertion_string"] == loaded.assertions[i].text);
    if (!result["errors"].empty()) {
      RC_ASSERT(result["errors"].dump().find("inconclusive") != std::string::npos);
      continue;
    }
    RC_TAG(std::string(result["result"] == 1 ? "passes" : "fails"));
    const auto replayed = replays(*loaded.script, loaded.assertions[i], result, document);
    if (!replayed) RC_FAIL(std::string(replayed.message()));
    check_by_definition(loaded, loaded.assertions[i], result, with_counts);
  }
}

RC_GTEST_PROP(GeneratedScriptsTest, SimplerScriptsAreScripts, ()) {
  const GenScript script = *gen_script();
  const std::vector<GenScript> all = simpler(script);
  const std::size_t stride = all.size() / 4 + 1;
  for (std::size_t i = *rc::gen::inRange<std::size_t>(0, stride); i < all.size(); i += stride) {
    const Loaded loaded(to_text(all[i]));
    if (!loaded.script) RC_FAIL(to_text(all[i]) + loaded.messages());
  }
}

TEST(GeneratedScriptsTest, FdrSaysTheSame) {
  const auto program = fdr_program();
  if (!program) GTEST_SKIP() << "FDR's refines is not on the PATH";
  rc::check("FDR says the same", [&] {
    const GenScript script = *gen_script();
    const TemporaryFolder folder;
    const std::filesystem::path file = written(folder, script);
    const Json ours = our_document(file, max_states);
    const Json theirs = fdr_document(*program, file);
    Loaded loaded(to_text(script));
    RC_ASSERT(ours["results"].size() == theirs["results"].size());
    for (std::size_t i = 0; i < loaded.assertions.size(); ++i) {
      if (!ours["results"][i]["errors"].empty()) continue;
      const auto same = agrees(ours["results"][i], theirs["results"][i]);
      if (!same) RC_FAIL(std::string(same.message()));
      const auto replayed =
          replays(*loaded.script, loaded.assertions[i], theirs["results"][i], theirs);
      if (!replayed) RC_FAIL("FDR's counterexample: " + std::string(replayed.message()));
    }
  });
}

}  // namespace
}  // namespace perentie::test

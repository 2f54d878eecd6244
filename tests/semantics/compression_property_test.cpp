// Random processes with compressions anywhere, applied and as the identity: the same failures and
// divergences.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "gen_process.hpp"
#include "machine_support.hpp"
#include "perentie/lts/lts_system.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/lts/refine.hpp"
#include "perentie/lts/specifications.hpp"
#include "perentie/semantics/compression.hpp"
#include "perentie/semantics/process_graph.hpp"
#include "perentie/semantics/process_system.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

const lts::ExploreOptions small{.limits = {.max_states = 2'000}};

std::optional<lts::Lts> explored(TestScript& script, const std::string& process,
                                 Preserved preserved, LeafCompression leaves) {
  base::Diagnostics diagnostics;
  script.script().set_preserved(preserved);
  script.script().set_leaf_compression(leaves);
  const auto term = script.script().process(process, diagnostics);
  if (!term) return std::nullopt;
  auto found = explore_process(script.script(), *term, small, diagnostics);
  if (!found.complete) return std::nullopt;
  return std::move(found.lts);
}

bool refines(const lts::Lts& specification, const lts::Lts& implementation,
             lts::SemanticModel model) {
  const auto normal = lts::normalise(specification, {.acceptances = true}).normal;
  lts::LtsSystem system(implementation);
  const auto found = lts::refine(lts::NormalSpecification(normal), system, model);
  RC_ASSERT(found.complete() || found.counterexample);
  return !found.counterexample;
}

void expect_equivalent(const lts::Lts& left, const lts::Lts& right) {
  for (const auto model : {lts::SemanticModel::traces, lts::SemanticModel::failures,
                           lts::SemanticModel::failures_divergences}) {
    RC_ASSERT(refines(left, right, model));
    RC_ASSERT(refines(right, left, model));
  }
}

RC_GTEST_PROP(CompressionPropertyTest, AppliedCompressionsKeepFailuresAndDivergences, ()) {
  const std::string definitions = test::some_definitions();
  const std::string process =
      test::some_compression() + "(" + test::some_process(2) + ") [] " + test::some_process(2);
  RC_LOG() << definitions << process;
  TestScript script(definitions);
  RC_ASSERT(script.loaded());
  const auto exact = explored(script, process, Preserved::identity, LeafCompression::none);
  const auto applied =
      explored(script, process, Preserved::failures_divergences, LeafCompression::none);
  RC_ASSERT(exact.has_value() <= applied.has_value());
  if (!exact) RC_DISCARD("too large");
  RC_CLASSIFY(applied->state_count() < exact->state_count(), "smaller");
  expect_equivalent(*exact, *applied);
}

// Networks of generalised leaves, checked as they are, beside their plain graphs.
RC_GTEST_PROP(CompressionPropertyTest, GeneralisedLeavesHaveTheSameRefinements, ()) {
  const std::string definitions = test::some_definitions();
  const auto leaf = [&] {
    const std::string inner = test::some_process(1);
    return test::pick(2) == 0 ? "normal(" + inner + ")" : "sbisim(diamond(" + inner + "))";
  };
  const std::string one = test::some_event(), two = test::some_event();
  std::string process = "(" + leaf() + " [|{" + one + "}|] " + leaf() + ")";
  if (test::pick(2) == 0) process += " \\ {" + two + "}";
  const std::string other = test::some_process(2);
  RC_LOG() << definitions << process << "\n" << other;
  TestScript script(definitions);
  RC_ASSERT(script.loaded());
  const auto exact = explored(script, process, Preserved::identity, LeafCompression::none);
  const auto beside = explored(script, other, Preserved::identity, LeafCompression::none);
  if (!exact || !beside) RC_DISCARD("too large");
  script.script().set_preserved(Preserved::failures_divergences);
  base::Diagnostics diagnostics;
  const auto term = script.script().process(process, diagnostics);
  RC_ASSERT(term);
  for (const auto* specification : {&*exact, &*beside}) {
    const auto normal = lts::normalise(*specification, {.acceptances = true}).normal;
    for (const auto model : {lts::SemanticModel::traces, lts::SemanticModel::failures,
                             lts::SemanticModel::failures_divergences}) {
      const auto found = refine_process(script.script(), *term, lts::NormalSpecification(normal),
                                        model, {}, diagnostics);
      RC_ASSERT(found.complete() || found.counterexample);
      RC_ASSERT(found.counterexample.has_value() != refines(*specification, *exact, model));
      RC_CLASSIFY(found.counterexample.has_value(), "fails");
      if (found.counterexample) RC_ASSERT(is_run(script.script(), *term, *found.counterexample));
    }
  }
}

RC_GTEST_PROP(CompressionPropertyTest, WeaklyCompressedLeavesKeepFailuresAndDivergences, ()) {
  const std::string definitions = test::some_definitions();
  const std::string process = test::some_process(2);
  RC_LOG() << definitions << process;
  TestScript script(definitions);
  RC_ASSERT(script.loaded());
  const auto exact = explored(script, process, Preserved::identity, LeafCompression::none);
  if (!exact) RC_DISCARD("too large");
  const auto strong = explored(script, process, Preserved::identity, LeafCompression::wbisim);
  RC_ASSERT(strong.has_value());
  expect_equivalent(*exact, *strong);
  const auto weak = explored(script, process, Preserved::priority, LeafCompression::wbisim);
  RC_ASSERT(weak.has_value());
  RC_CLASSIFY(weak->state_count() < strong->state_count(), "smaller");
  expect_equivalent(*exact, *weak);
}

}  // namespace
}  // namespace perentie::semantics

// Random processes with compressions anywhere, applied and as the identity: the same failures and
// divergences.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "gen_process.hpp"
#include "perentie/lts/lts_system.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/lts/refine.hpp"
#include "perentie/lts/specifications.hpp"
#include "perentie/semantics/compression.hpp"
#include "perentie/semantics/process_system.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

const lts::ExploreOptions small{.limits = {.max_states = 2'000}};

std::optional<lts::Lts> explored(TestScript& script, const std::string& process,
                                 Preserved preserved) {
  base::Diagnostics diagnostics;
  script.script().set_preserved(preserved);
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

RC_GTEST_PROP(CompressionPropertyTest, AppliedCompressionsKeepFailuresAndDivergences, ()) {
  const std::string definitions = test::some_definitions();
  const std::string process =
      test::some_compression() + "(" + test::some_process(2) + ") [] " + test::some_process(2);
  RC_LOG() << definitions << process;
  TestScript script(definitions);
  RC_ASSERT(script.loaded());
  const auto exact = explored(script, process, Preserved::identity);
  const auto applied = explored(script, process, Preserved::failures_divergences);
  RC_ASSERT(exact.has_value() <= applied.has_value());
  if (!exact) RC_DISCARD("too large");
  RC_CLASSIFY(applied->state_count() < exact->state_count(), "smaller");
  for (const auto model : {lts::SemanticModel::traces, lts::SemanticModel::failures,
                           lts::SemanticModel::failures_divergences}) {
    RC_ASSERT(refines(*exact, *applied, model));
    RC_ASSERT(refines(*applied, *exact, model));
  }
}

}  // namespace
}  // namespace perentie::semantics

// Divergence, normal form and determinism on random graphs against the definitions.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "compare_with_oracles.hpp"
#include "perentie/test/gen_lts.hpp"

namespace perentie::lts {
namespace {

using test::arbitrary_lts;

TEST(AnalysisPropertyTest, TheGeneratorGivesEveryKindOfGraph) {
  constexpr int draws = 1000;
  const auto gen = arbitrary_lts({.max_states = 5});
  int deterministic = 0;
  int divergent = 0;
  int refusing = 0;
  for (std::uint64_t seed = 0; seed < draws; ++seed) {
    const Lts lts = gen(rc::Random(seed), static_cast<int>(seed % 100)).value();
    const auto verdict = check_determinism(lts, DeterminismModel::failures_divergences);
    if (const auto* found = std::get_if<Nondeterminism>(&verdict)) {
      ++(found->event ? refusing : divergent);
    } else {
      ++deterministic;
    }
  }
  EXPECT_GT(deterministic, draws / 10);
  EXPECT_GT(divergent, draws / 10);
  EXPECT_GT(refusing, draws / 10);
}

RC_GTEST_PROP(AnalysisPropertyTest, DivergenceIsWhatTheDefinitionSays, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 12, .events = {"a"}, .tau_weight = 3});
  RC_ASSERT(test::wrong_in_divergence(lts) == "");
}

RC_GTEST_PROP(AnalysisPropertyTest, TheNormalFormHasTheSameBehaviours, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 6});
  RC_ASSERT(test::wrong_in_normal_form(lts, 5) == "");
}

RC_GTEST_PROP(AnalysisPropertyTest, DeterminismIsWhatTheDefinitionSays, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 5});
  RC_ASSERT(test::wrong_in_determinism(lts, DeterminismModel::failures, 5) == "");
  RC_ASSERT(test::wrong_in_determinism(lts, DeterminismModel::failures_divergences, 5) == "");
}

RC_GTEST_PROP(AnalysisPropertyTest, DeterminismOfSparseGraphs, ()) {
  // One event: long traces, many deterministic graphs.
  const Lts lts = *arbitrary_lts({.max_states = 5, .events = {"a"}, .tick_weight = 0});
  RC_ASSERT(test::wrong_in_determinism(lts, DeterminismModel::failures, 32) == "");
  RC_ASSERT(test::wrong_in_determinism(lts, DeterminismModel::failures_divergences, 32) == "");
}

}  // namespace
}  // namespace perentie::lts

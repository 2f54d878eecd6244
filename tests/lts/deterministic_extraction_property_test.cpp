// What is extracted from random graphs, held against the definition of refinement and against the
// determinism check, which goes another way.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <variant>

#include "perentie/lts/determinism.hpp"
#include "perentie/lts/deterministic_extraction.hpp"
#include "perentie/test/gen_lts.hpp"
#include "perentie/test/lts_oracles.hpp"
#include "perentie/test/refinement_oracle.hpp"

namespace perentie::lts {
namespace {

using test::arbitrary_lts;
using test::Semantics;

bool is_deterministic(const Lts& lts, DeterminismModel model) {
  return std::holds_alternative<Deterministic>(check_determinism(lts, model));
}

bool refines(const Lts& specification, const Lts& implementation) {
  return !test::naive_refutation(specification, implementation, Semantics::failures_divergences);
}

/// All states of an extraction are reachable.
bool some_state_diverges(const Lts& lts) {
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (test::diverges(lts, s)) return true;
  }
  return false;
}

RC_GTEST_PROP(DeterministicExtractionPropertyTest, TheResultIsADeterministicRefinement, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 7});
  const Lts result = deterministic_extraction(lts);
  RC_ASSERT(result.state_count() <= lts.state_count() + 1);
  RC_ASSERT(is_deterministic(result, DeterminismModel::failures));
  RC_ASSERT(is_deterministic(result, DeterminismModel::failures_divergences) ==
            !some_state_diverges(result));
  RC_ASSERT(refines(lts, result));
}

RC_GTEST_PROP(DeterministicExtractionPropertyTest, DecidesDeterminism, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 5});
  const Lts result = deterministic_extraction(lts);
  const bool expected = is_deterministic(lts, DeterminismModel::failures_divergences);
  RC_CLASSIFY(expected, "deterministic");
  RC_ASSERT((!some_state_diverges(result) && refines(result, lts)) == expected);
}

}  // namespace
}  // namespace perentie::lts

// Refinement that cannot be decided: states whose transitions cannot be computed, and limits,
// wherever the search meets them. Verdicts themselves are compared with an oracle in
// refine_property_test.cpp.
#include "perentie/lts/refine.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "perentie/base/hash.hpp"

namespace perentie::lts {
namespace {

constexpr std::uint32_t never = ~std::uint32_t{0};

/// State n leads to n + 1 by τ, state 0 also to itself by an event.
struct TauChain {
  using State = std::uint32_t;

  std::uint32_t last = never;
  std::uint32_t fails_at = never;

  State initial() const { return 0; }
  bool successors(State s, std::vector<Transition<State>>& out) {
    if (s == fails_at) return false;
    if (s == 0) out.push_back({Label{2}, 0});
    if (s < last) out.push_back({tau, s + 1});
    return true;
  }
  std::uint64_t state_hash(State s) const { return base::hash_mix(0, s); }
  std::shared_ptr<const LabelNames> label_names() const {
    return std::make_shared<const LabelNames>(LabelNames{"τ", "✓", "a"});
  }
};
static_assert(TransitionSystem<TauChain>);

constexpr SemanticModel all_models[] = {SemanticModel::traces, SemanticModel::failures,
                                        SemanticModel::failures_divergences};

TEST(RefineTest, AFailureIsNoVerdictHoweverDeepItLies) {
  for (const SemanticModel model : all_models) {
    for (std::uint32_t depth = 0; depth < 6; ++depth) {
      TauChain system{.last = 9, .fails_at = depth};
      const auto found = refine(DivergenceFreedom{}, system, model);
      EXPECT_TRUE(found.failed) << depth;
      EXPECT_FALSE(found.complete()) << depth;
      EXPECT_FALSE(found.counterexample) << depth;
    }
  }
}

TEST(RefineTest, StatesThatASearchForDivergencesEntersAreLimited) {
  for (const SemanticModel model : all_models) {
    TauChain system;  // has no end
    const auto found = refine(DivergenceFreedom{}, system, model, {.limits = {.max_states = 100}});
    ASSERT_TRUE(found.limit);
    EXPECT_EQ(found.limit->kind, base::LimitKind::states);
    EXPECT_FALSE(found.counterexample);
  }
}

TEST(RefineTest, ALimitThatIsNotExceededDoesNotMatter) {
  for (const SemanticModel model : all_models) {
    TauChain system{.last = 99};
    const auto found = refine(DivergenceFreedom{}, system, model, {.limits = {.max_states = 100}});
    EXPECT_TRUE(found.complete());
    EXPECT_EQ(found.counts.states, 100U);
  }
}

}  // namespace
}  // namespace perentie::lts

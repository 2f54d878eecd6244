// Exploration and refinement say the same with any number of workers.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "perentie/base/hash.hpp"
#include "perentie/lts/count.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/lts/refine.hpp"
#include "perentie/test/gen_lts.hpp"

namespace perentie::lts {
namespace {

/// A random graph that is wide enough to be shared between workers, computed from its seed.
struct WideSystem {
  using State = std::uint32_t;

  std::uint32_t state_count = 1;
  std::uint32_t max_degree = 1;
  std::uint32_t label_count = 2;
  std::uint64_t seed = 0;
  State fails_at = 1'000'000'000;  ///< the state whose transitions cannot be computed

  State initial() const { return 0; }
  bool successors(State s, std::vector<Transition<State>>& out) const {
    if (s == fails_at) return false;
    std::uint64_t random = base::hash_mix(seed, s);
    for (std::uint64_t i = random % (max_degree + 1); i > 0; --i) {
      random = base::hash_mix(random, i);
      out.push_back({Label{static_cast<std::uint32_t>(random % label_count)},
                     static_cast<State>((random >> 20U) % state_count)});
    }
    return true;
  }
  // Many collisions, on purpose.
  std::uint64_t state_hash(State s) const { return base::hash_mix(0, s / 3); }
  std::shared_ptr<const LabelNames> label_names() const {
    LabelNames names{std::string(tau_name), std::string(tick_name)};
    while (names.size() < label_count) names.push_back("e" + std::to_string(names.size()));
    return std::make_shared<const LabelNames>(names);
  }
};
static_assert(SharedTransitionSystem<WideSystem>);

WideSystem arbitrary_wide_system() {
  WideSystem system;
  // Small graphs are computed by one worker anyway.
  system.state_count = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(1U, 20'000U));
  system.max_degree = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(2U, 9U));
  system.label_count = *rc::gen::inRange(2U, 5U);
  system.seed = *rc::gen::arbitrary<std::uint64_t>();
  if (*rc::gen::inRange(0, 8) == 0) system.fails_at = *rc::gen::inRange(0U, system.state_count);
  return system;
}

base::Limits arbitrary_limits(const WideSystem& system) {
  base::Limits limits;
  if (*rc::gen::inRange(0, 3) == 0)
    limits.max_states = *rc::gen::inRange(1U, system.state_count + 1);
  return limits;
}

RC_GTEST_PROP(WorkersPropertyTest, ExplorationDoesNotDependOnThem, ()) {
  WideSystem system = arbitrary_wide_system();
  base::Limits limits = arbitrary_limits(system);
  const auto alone = explore(system, {.limits = limits});
  RC_CLASSIFY(alone.states.size() > 1'000, "large");
  RC_CLASSIFY(alone.failed, "failed");
  RC_CLASSIFY(alone.limit.has_value(), "limited");
  limits.workers = *rc::gen::inRange(2U, 5U);
  const auto together = explore(system, {.limits = limits});
  RC_ASSERT(together.states == alone.states);
  RC_ASSERT(together.expanded == alone.expanded);
  RC_ASSERT(together.transitions_fired == alone.transitions_fired);
  RC_ASSERT(together.failed == alone.failed);
  RC_ASSERT(together.limit.has_value() == alone.limit.has_value());
  for (std::uint32_t s = 0; s < alone.states.size(); ++s) {
    RC_ASSERT(std::ranges::equal(together.lts.edges(State{s}), alone.lts.edges(State{s})));
  }
  const Count count_alone = count(system, {.limits = {.max_states = limits.max_states}});
  const Count counted = count(system, {.limits = limits});
  RC_ASSERT(counted.states == alone.states.size());
  RC_ASSERT(counted.transitions == alone.transitions_fired);
  RC_ASSERT(counted.plies == count_alone.plies);
}

// The first states say nothing about how many transitions come later.
TEST(WorkersPropertyTest, BlocksOfDenseStatesEndEarly) {
  struct Dense : WideSystem {
    bool successors(State s, std::vector<Transition<State>>& out) const {
      if (s < 2'000) {
        out.push_back({tau, 2 * s + 1});
        out.push_back({tau, 2 * s + 2});
        return true;
      }
      for (State i = 0; i < 3'000; ++i) out.push_back({tick, (s * 17 + i * 31) % 5'000});
      return true;
    }
  };
  Dense system;
  const Count alone = count(system);
  const Count together = count(system, {.limits = {.workers = 3}});
  EXPECT_EQ(alone.states, 5'000U);
  EXPECT_EQ(alone.transitions, 2 * 2'000U + 3'000U * 3'000U);
  EXPECT_EQ(together.states, alone.states);
  EXPECT_EQ(together.transitions, alone.transitions);
  EXPECT_EQ(together.plies, alone.plies);
}

RC_GTEST_PROP(WorkersPropertyTest, RefinementDoesNotDependOnThem, ()) {
  WideSystem system = arbitrary_wide_system();
  // A specification of a few nodes that allows most: the first differences are far away or absent.
  LtsBuilder builder(system.label_names());
  const auto nodes = *rc::gen::inRange(1U, 4U);
  builder.add_states(nodes + 1);
  for (std::uint32_t node = 0; node < nodes; ++node) {
    for (std::uint32_t label = 1; label < system.label_count; ++label) {
      if (*rc::gen::inRange(0, 40) != 0) {
        builder.add_edge(State{node}, Label{label}, State{*rc::gen::inRange(0U, nodes)});
      }
    }
    builder.add_edge(State{node}, tau, State{nodes});  // and may refuse all
    if (*rc::gen::inRange(0, 4) == 0) builder.add_edge(State{node}, tau, State{node});
  }
  const Lts specification = std::move(builder).finish(State{0});
  const Normalisation normalised = normalise(specification, {.acceptances = true});
  const NormalSpecification normal(normalised.normal);
  base::Limits limits = arbitrary_limits(system);
  for (const SemanticModel model :
       {SemanticModel::traces, SemanticModel::failures, SemanticModel::failures_divergences}) {
    limits.workers = 1;
    const auto alone = refine(normal, system, model, {.limits = limits});
    RC_CLASSIFY(alone.counterexample.has_value(), "refuted");
    RC_CLASSIFY(alone.complete() && !alone.counterexample && alone.counts.states > 1'000,
                "holds, large");
    limits.workers = *rc::gen::inRange(2U, 5U);
    const auto together = refine(normal, system, model, {.limits = limits});
    RC_ASSERT(together.counts.states == alone.counts.states);
    RC_ASSERT(together.counts.transitions == alone.counts.transitions);
    RC_ASSERT(together.counts.plys == alone.counts.plys);
    RC_ASSERT(together.failed == alone.failed);
    RC_ASSERT(together.limit.has_value() == alone.limit.has_value());
    RC_ASSERT(together.counterexample.has_value() == alone.counterexample.has_value());
    if (alone.counterexample) {
      RC_ASSERT(together.counterexample->kind == alone.counterexample->kind);
      RC_ASSERT(together.counterexample->trace == alone.counterexample->trace);
      RC_ASSERT(together.counterexample->states == alone.counterexample->states);
      RC_ASSERT(together.counterexample->event == alone.counterexample->event);
      RC_ASSERT(together.counterexample->offered == alone.counterexample->offered);
    }
  }
}

}  // namespace
}  // namespace perentie::lts

// Quotients by bisimulation on random graphs against the definitions.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "bisimulation_oracle.hpp"
#include "perentie/lts/bisimulation.hpp"
#include "perentie/test/gen_lts.hpp"
#include "perentie/test/lts_oracles.hpp"

namespace perentie::lts {
namespace {

using test::arbitrary_lts;
using test::Bisimilarity;

/// Whether two states have the same block iff they have the same class, as far as they have one.
bool agree(const std::vector<State>& blocks, const std::vector<std::uint32_t>& classes) {
  std::map<State, std::uint32_t> class_of;
  std::map<std::uint32_t, State> block_of;
  for (std::uint32_t s = 0; s < blocks.size(); ++s) {
    if (blocks[s].is_none()) continue;
    if (class_of.try_emplace(blocks[s], classes[s]).first->second != classes[s]) return false;
    if (block_of.try_emplace(classes[s], blocks[s]).first->second != blocks[s]) return false;
  }
  return true;
}

RC_GTEST_PROP(BisimulationPropertyTest, TheStrongQuotientMergesExactlyBisimilarStates, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 10, .events = {"a"}});
  const Quotient quotient = strong_bisimulation(lts);
  RC_ASSERT(agree(quotient.block_of, test::bisimilarity_classes(lts, Bisimilarity::strong)));
  RC_ASSERT(test::are_bisimilar(lts, quotient.lts, Bisimilarity::strong));
  RC_ASSERT(quotient.block_of[lts.initial().value] == quotient.lts.initial());
}

RC_GTEST_PROP(BisimulationPropertyTest, AnInitialPartitionIsRespected, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 10, .events = {"a"}});
  const auto classes = *rc::gen::container<std::vector<std::uint32_t>>(
      lts.state_count(), rc::gen::inRange<std::uint32_t>(0, 2));
  const Quotient quotient = strong_bisimulation(lts, classes);
  RC_ASSERT(
      agree(quotient.block_of, test::bisimilarity_classes(lts, Bisimilarity::strong, classes)));
}

RC_GTEST_PROP(BisimulationPropertyTest, TwoCopiesHaveTheQuotientOfOne, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 12});
  const Quotient one = strong_bisimulation(lts);
  const Quotient two = strong_bisimulation(test::side_by_side(lts, lts));
  RC_ASSERT(test::to_text(one.lts) == test::to_text(two.lts));
}

}  // namespace
}  // namespace perentie::lts

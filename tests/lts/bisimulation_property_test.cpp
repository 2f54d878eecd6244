// Quotients by bisimulation and the other compressions on random graphs against the definitions.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "bisimulation_oracle.hpp"
#include "perentie/lts/bisimulation.hpp"
#include "perentie/lts/compressions.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/lts/weak_bisimulation.hpp"
#include "perentie/test/gen_lts.hpp"
#include "perentie/test/lts_oracles.hpp"
#include "same_behaviour.hpp"

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

/// The quotient, held to the definition.
Lts checked(const Lts& lts, const Quotient& quotient, Bisimilarity kind) {
  RC_ASSERT(agree(quotient.block_of, test::bisimilarity_classes(lts, kind)));
  RC_ASSERT(test::are_bisimilar(lts, quotient.lts, kind));
  RC_ASSERT(quotient.block_of[lts.initial().value] == quotient.lts.initial());
  return quotient.lts;
}

Lts without_edge(const Lts& lts, std::uint32_t source, const Edge& left_out) {
  LtsBuilder builder(lts.shared_label_names());
  builder.add_states(static_cast<std::uint32_t>(lts.state_count()));
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const Edge& edge : lts.edges(State{s})) {
      if (s != source || edge != left_out) builder.add_edge(State{s}, edge.label, edge.target);
    }
  }
  return std::move(builder).finish(lts.initial());
}

/// A superfluous edge is one without which all states remain bisimilar to what they were.
bool has_superfluous_edge(const Lts& lts, Bisimilarity kind) {
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const Edge& edge : lts.edges(State{s})) {
      const auto classes =
          test::bisimilarity_classes(test::side_by_side(lts, without_edge(lts, s, edge)), kind);
      const auto half = static_cast<std::ptrdiff_t>(lts.state_count());
      if (std::equal(classes.begin(), classes.begin() + half, classes.begin() + half)) return true;
    }
  }
  return false;
}

const test::LtsShape tau_rich{.max_states = 9, .events = {"a", "b"}, .tau_weight = 3};

RC_GTEST_PROP(BisimulationPropertyTest, TheDelayQuotientIsWhatTheDefinitionSays, ()) {
  const Lts lts = *arbitrary_lts(tau_rich);
  const Lts small = checked(lts, std::get<Quotient>(delay_bisimulation(lts)), Bisimilarity::delay);
  RC_ASSERT(!has_superfluous_edge(small, Bisimilarity::delay));
}

RC_GTEST_PROP(BisimulationPropertyTest, TheWeakQuotientIsWhatTheDefinitionSays, ()) {
  const Lts lts = *arbitrary_lts(tau_rich);
  const Lts small = checked(lts, std::get<Quotient>(weak_bisimulation(lts)), Bisimilarity::weak);
  RC_ASSERT(!has_superfluous_edge(small, Bisimilarity::weak));
}

RC_GTEST_PROP(BisimulationPropertyTest, CompressionsKeepTracesFailuresAndDivergences, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 7, .events = {"a", "b"}, .tau_weight = 2});
  RC_ASSERT(test::wrong_in_compression(lts, strong_bisimulation(lts).lts, 5) == "");
  RC_ASSERT(test::wrong_in_compression(lts, tau_loop_factor(lts).lts, 5) == "");
  RC_ASSERT(test::wrong_in_compression(lts, std::get<Quotient>(delay_bisimulation(lts)).lts, 5) ==
            "");
  RC_ASSERT(test::wrong_in_compression(lts, std::get<Quotient>(weak_bisimulation(lts)).lts, 5) ==
            "");
  RC_ASSERT(test::wrong_in_compression(lts, std::get<GeneralisedLts>(diamond(lts)), 5) == "");
  RC_ASSERT(test::wrong_in_compression(lts, std::get<GeneralisedLts>(normal(lts)), 5) == "");
}

RC_GTEST_PROP(BisimulationPropertyTest, PlainGraphsSayWhatGeneralisedOnesDo, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 7, .events = {"a", "b"}, .tau_weight = 2});
  const Lts from_diamond = plain_lts(std::get<GeneralisedLts>(diamond(lts)));
  RC_ASSERT(test::wrong_in_compression(lts, from_diamond, 5) == "");
  const Lts from_normal = plain_lts(std::get<GeneralisedLts>(normal(lts)));
  RC_ASSERT(test::wrong_in_compression(lts, from_normal, 5) == "");
}

RC_GTEST_PROP(BisimulationPropertyTest, CompressionsDoNotEnlarge, ()) {
  const Lts lts = *arbitrary_lts(tau_rich);
  const std::size_t strong = strong_bisimulation(lts).lts.state_count();
  const std::size_t delay = std::get<Quotient>(delay_bisimulation(lts)).lts.state_count();
  const std::size_t weak = std::get<Quotient>(weak_bisimulation(lts)).lts.state_count();
  RC_ASSERT(weak <= delay);
  RC_ASSERT(delay <= strong);
  RC_ASSERT(strong <= lts.state_count());
  RC_ASSERT(std::get<GeneralisedLts>(diamond(lts)).lts.state_count() <= lts.state_count());
  const auto normal_form = std::get<GeneralisedLts>(normal(lts));
  RC_ASSERT(normal_form.lts.state_count() <= normalise(lts).normal.lts.state_count());
}

}  // namespace
}  // namespace perentie::lts

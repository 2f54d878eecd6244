// All graphs of 1 and 2 states over τ, a and ✓, and all graphs of 3 states over τ and a, against
// the definitions: nothing small is overlooked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bisimulation_oracle.hpp"
#include "compare_with_oracles.hpp"
#include "perentie/lts/compressions.hpp"
#include "perentie/lts/weak_bisimulation.hpp"
#include "perentie/test/lts_oracles.hpp"
#include "perentie/test/lts_text.hpp"
#include "same_behaviour.hpp"

namespace perentie::lts {
namespace {

/// Bit number (source * labels + label) * states + target of `code` says whether that edge is
/// there.
Lts decode(std::uint32_t code, std::uint32_t states, const std::vector<Label>& labels) {
  static const auto names = std::make_shared<const LabelNames>(
      LabelNames{std::string(tau_name), std::string(tick_name), "a"});
  LtsRowBuilder rows;
  for (std::uint32_t source = 0; source < states; ++source) {
    for (const Label label : labels) {
      for (std::uint32_t target = 0; target < states; ++target, code >>= 1U) {
        if ((code & 1U) != 0) rows.add_edge(label, State{target});
      }
    }
    rows.end_row();
  }
  return std::move(rows).finish(State{0}, states, names);
}

/// Whether exchanging states 1 and 2 gives a graph with a lower code: one of the two is enough.
bool has_lower_twin(std::uint32_t code, std::uint32_t labels) {
  const auto exchange = [](std::uint32_t state) { return state == 0 ? 0 : 3 - state; };
  std::uint32_t twin = 0;
  for (std::uint32_t source = 0; source < 3; ++source) {
    for (std::uint32_t label = 0; label < labels; ++label) {
      for (std::uint32_t target = 0; target < 3; ++target) {
        const std::uint32_t bit = (source * labels + label) * 3 + target;
        const std::uint32_t moved = (exchange(source) * labels + label) * 3 + exchange(target);
        twin |= ((code >> bit) & 1U) << moved;
      }
    }
  }
  return twin < code;
}

bool is_connected(const Lts& lts) {
  test::StateSet found = 1;
  for (std::size_t round = 0; round < lts.state_count(); ++round) {
    for (const Label label : {tau, tick, Label{2}}) found |= test::step(lts, found, label);
  }
  return found + 1 == test::StateSet{1} << lts.state_count();
}

std::string wrong_in_compressions(const Lts& lts, std::size_t depth) {
  using test::Bisimilarity;
  using test::wrong_in_compression;
  const auto in_quotient = [&](const Quotient& quotient, Bisimilarity kind) -> std::string {
    if (!test::are_bisimilar(lts, quotient.lts, kind)) return "not bisimilar";
    const auto classes = test::bisimilarity_classes(quotient.lts, kind);
    if (*std::ranges::max_element(classes) + 1 != classes.size()) return "not minimal";
    return wrong_in_compression(lts, quotient.lts, depth);
  };
  std::string wrong = in_quotient(strong_bisimulation(lts), Bisimilarity::strong);
  if (!wrong.empty()) return "strong: " + wrong;
  wrong = in_quotient(std::get<Quotient>(delay_bisimulation(lts)), Bisimilarity::delay);
  if (!wrong.empty()) return "delay: " + wrong;
  wrong = in_quotient(std::get<Quotient>(weak_bisimulation(lts)), Bisimilarity::weak);
  if (!wrong.empty()) return "weak: " + wrong;
  wrong = wrong_in_compression(lts, tau_loop_factor(lts).lts, depth);
  if (!wrong.empty()) return "tau_loop_factor: " + wrong;
  wrong = wrong_in_compression(lts, std::get<GeneralisedLts>(diamond(lts)), depth);
  if (!wrong.empty()) return "diamond: " + wrong;
  wrong = wrong_in_compression(lts, std::get<GeneralisedLts>(normal(lts)), depth);
  return wrong.empty() ? "" : "normal: " + wrong;
}

/// Traces of 2^states labels pass through every set of states, so longer ones show nothing new.
void check_all(std::uint32_t states, const std::vector<Label>& labels) {
  const std::size_t depth = std::size_t{1} << states;
  const std::size_t edges = states * labels.size() * states;
  for (std::uint32_t code = 0; code < (1U << edges); ++code) {
    if (states == 3 && has_lower_twin(code, static_cast<std::uint32_t>(labels.size()))) continue;
    const Lts lts = decode(code, states, labels);
    if (states == 3 && !is_connected(lts)) continue;  // it behaves as a smaller one
    ASSERT_EQ(test::wrong_in_divergence(lts), "") << test::to_text(lts);
    ASSERT_EQ(test::wrong_in_normal_form(lts, depth), "") << test::to_text(lts);
    for (const auto model : {DeterminismModel::failures, DeterminismModel::failures_divergences}) {
      ASSERT_EQ(test::wrong_in_determinism(lts, model, depth), "") << test::to_text(lts);
    }
    // Of the graphs of three states one in sixteen, for time.
    if (states == 3 && code % 16 != 5) continue;
    ASSERT_EQ(wrong_in_compressions(lts, depth), "") << test::to_text(lts);
  }
}

TEST(ExhaustiveTest, OneStateWithTauTickAndAnEvent) { check_all(1, {tau, tick, Label{2}}); }
TEST(ExhaustiveTest, TwoStatesWithTauTickAndAnEvent) { check_all(2, {tau, tick, Label{2}}); }
TEST(ExhaustiveTest, ThreeStatesWithTauAndAnEvent) { check_all(3, {tau, Label{2}}); }

}  // namespace
}  // namespace perentie::lts

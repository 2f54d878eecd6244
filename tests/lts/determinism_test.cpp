// The determinism check on hand-made graphs: verdicts of the reference, witnesses, limits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>

#include "perentie/lts/determinism.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;
using test::to_text;

/// "deterministic", "<trace> event" with both paths, or "<trace> diverges" with one.
std::string verdict(const Lts& lts, DeterminismModel model) {
  const DeterminismVerdict verdict = check_determinism(lts, model);
  if (std::holds_alternative<Deterministic>(verdict)) return "deterministic";
  const auto& found = std::get<Nondeterminism>(verdict);
  const auto path = [&](const Path& p) { return fmt::format(" ({})", to_text(lts, labels_of(p))); };
  const std::string trace = fmt::format("<{}>", to_text(lts, found.trace));
  if (!found.event) return trace + " diverges" + path(found.refusing);
  return trace + " " + std::string(lts.name(*found.event)) + path(found.refusing) +
         path(found.performing);
}

std::string in_f(std::string_view text) {
  return verdict(lts_from(text), DeterminismModel::failures);
}
std::string in_fd(std::string_view text) {
  return verdict(lts_from(text), DeterminismModel::failures_divergences);
}

TEST(DeterminismTest, SmallDeterministicProcesses) {
  for (const auto* text : {"0", "0 tick 1", "0 a 0", "0 a 1; 1 b 0; 1 tick 2", "0 tau 1; 1 a 0"}) {
    EXPECT_EQ(in_f(text), "deterministic") << text;
    EXPECT_EQ(in_fd(text), "deterministic") << text;
  }
}

TEST(DeterminismTest, TheReferencesFourProcesses) {
  // CSPM reference 5.3.10.
  EXPECT_EQ(in_f("0 a 1; 0 b 2; 1 b 3; 2 a 3"), "deterministic");
  EXPECT_EQ(in_f("0 tau 1; 0 b 2; 1 a 3; 2 tau 3"), "<> b (τ) (b)");
  EXPECT_EQ(in_f("0 tau 1; 0 tau 2; 1 a 3; 2 b 3"), "<> a (τ) (τ a)");
  EXPECT_EQ(in_f("0 c 1; 0 c 2; 1 a 3; 2 b 3"), "<c> a (c) (c a)");
}

TEST(DeterminismTest, LazicsExamples) {
  // CSPM reference 5.3.5: D, ND, ND2.
  EXPECT_EQ(in_f("0 a 0; 0 b 1; 1 a 2; 2 c 2; 2 d 3; 3 c 0"), "deterministic");
  EXPECT_EQ(in_f("0 a 0; 0 a 1; 1 a 2; 2 b 3; 3 a 0"), "<a a> a (a a) (a a a)");
  EXPECT_EQ(in_f("0 tau 1; 0 tau 2; 1 a 0; 2 b 3; 3 a 0"), "<> a (τ) (τ a)");
}

TEST(DeterminismTest, EqualChoicesAreNone) {
  EXPECT_EQ(in_f("0 a 1; 0 a 2; 1 b 0; 2 b 0"), "deterministic");
  EXPECT_EQ(in_fd("0 tau 1; 0 tau 2; 1 b 0; 2 b 0"), "deterministic");
}

TEST(DeterminismTest, WhatAnUnstableStateOffersCanBeRefused) {
  EXPECT_EQ(in_f("0 a 0; 0 tau 1"), "<> a (τ) (a)");
  EXPECT_EQ(in_f("0 a 0; 0 tau 1; 1 a 0"), "deterministic");
}

TEST(DeterminismTest, TickIsAnOrdinaryLabel) {
  EXPECT_EQ(in_f("0 a 1; 0 tick 1"), "deterministic") << "P [] SKIP is a choice of ✓ (4.1.3d)";
  EXPECT_EQ(in_f("0 tau 1; 0 tau 2; 1 tick 3; 2 a 3"), "<> ✓ (τ) (τ ✓)");
  EXPECT_EQ(in_f("0 a 1; 1 tick 2; 1 tick 3; 3 b 3"), "<a ✓> b (a ✓) (a ✓ b)");
}

TEST(DeterminismTest, DivergenceFailsOnlyInFailuresDivergences) {
  EXPECT_EQ(in_f("0 tau 0"), "deterministic");
  EXPECT_EQ(in_fd("0 tau 0"), "<> diverges ()");
  EXPECT_EQ(in_f("0 a 1; 1 tau 2; 2 tau 1; 2 b 0"), "deterministic");
  EXPECT_EQ(in_fd("0 a 1; 1 tau 2; 2 tau 1; 2 b 0"), "<a> diverges (a)");
  EXPECT_EQ(in_fd("0 a 1; 1 tau 2; 2 tau 3; 3 tau 3"), "<a> diverges (a)");
}

TEST(DeterminismTest, TheEventIsReportedWhereBothFail) {
  EXPECT_EQ(in_fd("0 tau 0; 0 tau 1; 0 a 0"), "<> a (τ) (a)");
}

TEST(DeterminismTest, TheShorterOfDivergenceAndRefusalWins) {
  EXPECT_EQ(in_fd("0 a 1; 1 tau 1; 0 b 2; 2 c 3; 2 c 4; 4 d 4"), "<a> diverges (a)");
  EXPECT_EQ(in_fd("0 a 1; 1 a 5; 5 tau 5; 0 b 2; 0 b 6; 6 d 2"), "<b> d (b) (b d)");
}

TEST(DeterminismTest, TheWitnessIsTheLeastOfTheShortest) {
  EXPECT_EQ(in_f("0 b 1; 0 b 2; 2 a 0; 0 a 3; 0 a 4; 4 c 0"), "<a> c (a) (a c)");
  EXPECT_EQ(in_f("0 tau 1; 0 tau 2; 1 a 0; 1 c 0; 2 a 0; 2 b 0"), "<> b (τ) (τ b)");
}

TEST(DeterminismTest, UnreachableNondeterminismDoesNotCount) {
  EXPECT_EQ(in_fd("-> 0; 0 a 0; 1 a 0; 1 a 2; 2 tau 2"), "deterministic");
}

TEST(DeterminismTest, LimitsGiveNoVerdict) {
  std::string text = "0 a 0; 0 b 0; 0 c 0; 0 a 1";
  for (std::uint32_t i = 1; i < 24; ++i) {
    for (const std::string event : {" a ", " b ", " c "}) {
      text += "; " + std::to_string(i) + event + std::to_string(i + 1);
    }
  }
  text += "; 24 a 24; 24 b 24; 24 c 24";
  const Lts lts = lts_from(text);  // RUN({a, b, c}) with an exponential normal form
  const auto limit = [&](const base::Limits& limits) {
    const auto verdict = check_determinism(lts, DeterminismModel::failures, limits);
    EXPECT_TRUE(std::holds_alternative<base::LimitReached>(verdict));
    return std::get<base::LimitReached>(verdict);
  };
  EXPECT_EQ(limit({.max_states = 1000}).kind, base::LimitKind::states);
  EXPECT_EQ(limit({.max_states = 1000}).limit, 1000U);
  EXPECT_EQ(limit({.max_memory_bytes = 100'000}).kind, base::LimitKind::memory);
  EXPECT_EQ(limit({.timeout = std::chrono::milliseconds(10)}).kind, base::LimitKind::time);
  const std::atomic<bool> cancelled = true;
  EXPECT_EQ(limit({.cancelled = &cancelled}).kind, base::LimitKind::cancelled);
}

TEST(DeterminismTest, AWitnessBeforeTheLimitIsAWitness) {
  const auto verdict = check_determinism(lts_from("0 a 1; 0 a 2; 1 b 0"),
                                         DeterminismModel::failures, {.max_states = 2});
  EXPECT_TRUE(std::holds_alternative<Nondeterminism>(verdict));
}

TEST(DeterminismTest, AWitnessAMillionStepsAway) {
  constexpr std::uint32_t count = 1'000'000;
  LtsRowBuilder rows;
  for (std::uint32_t s = 0; s < count; ++s) {
    rows.add_edge(Label{2}, State{s + 1});
    if (s + 1 == count) rows.add_edge(Label{2}, State{0});
    rows.end_row();
  }
  const Lts lts = std::move(rows).finish(State{0}, count + 1,
                                         std::make_shared<const LabelNames>(LabelNames{
                                             std::string(tau_name), std::string(tick_name), "a"}));
  const auto verdict = check_determinism(lts, DeterminismModel::failures_divergences);
  const auto& found = std::get<Nondeterminism>(verdict);
  EXPECT_EQ(found.trace.size(), count);
  EXPECT_EQ(found.event, Label{2});
  EXPECT_EQ(end_of(lts, found.refusing), State{count});
  EXPECT_EQ(end_of(lts, found.performing), State{1});
}

}  // namespace
}  // namespace perentie::lts

#include "perentie/lts/deterministic_extraction.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

std::string extracted(std::string_view text) {
  return test::to_text(deterministic_extraction(test::lts_from(text)));
}

TEST(DeterministicExtractionTest, DeterministicProcessesStayAsTheyAre) {
  for (const auto* text : {"0", "0 a 0", "0 a 1; 0 b 0; 1 b 0", "0 ✓ 1; 0 a 2; 1; 2 ✓ 1"}) {
    EXPECT_EQ(extracted(text), text);
  }
}

TEST(DeterministicExtractionTest, OneSuccessorOfEachEventIsKept) {
  EXPECT_EQ(extracted("0 a 1; 0 a 2; 0 b 2; 1 c 0; 2 d 0"), "0 a 1; 0 b 2; 1 c 0; 2 d 0");
  EXPECT_EQ(extracted("0 tick 1; 0 tick 2; 2 a 2"), "0 ✓ 1; 1");
}

TEST(DeterministicExtractionTest, OneTauIsFollowedBeforeAnythingElse) {
  EXPECT_EQ(extracted("0 tau 1; 0 tau 2; 0 c 0; 1 a 0; 2 b 0"), "0 a 0");
  EXPECT_EQ(extracted("0 a 3; 1 tau 2; 2 b 0; 3 tau 1"), "0 a 1; 1 b 0");
}

TEST(DeterministicExtractionTest, TauWithoutEndIsOneDivergentState) {
  EXPECT_EQ(extracted("0 tau 0; 0 a 1; 1 a 1"), "0 τ 0");
  EXPECT_EQ(extracted("0 a 1; 0 b 3; 1 tau 2; 2 tau 1; 2 b 0; 3 tau 3"), "0 a 1; 0 b 1; 1 τ 1");
  EXPECT_EQ(extracted("0 tau 1; 1 tau 2; 2 tau 1; 2 tau 3; 3 a 0"), "0 τ 0");
}

TEST(DeterministicExtractionTest, TheFirstTauDecidesAboutDivergence) {
  EXPECT_EQ(extracted("0 tau 1; 0 tau 0; 1 a 0"), "0 τ 0") << "the first τ is the loop";
  EXPECT_EQ(extracted("-> 1; 1 tau 0; 1 tau 1; 0 a 1"), "0 a 0") << "here it is the other";
}

TEST(DeterministicExtractionTest, AMillionTauInARow) {
  constexpr std::uint32_t count = 1'000'000;
  LtsRowBuilder rows;
  for (std::uint32_t s = 0; s + 1 < count; ++s) {
    rows.add_edge(tau, State{s + 1});
    rows.end_row();
  }
  rows.add_edge(Label{2}, State{0});
  rows.end_row();
  const Lts lts = std::move(rows).finish(State{0}, count,
                                         std::make_shared<const LabelNames>(LabelNames{
                                             std::string(tau_name), std::string(tick_name), "a"}));
  EXPECT_EQ(test::to_text(deterministic_extraction(lts)), "0 a 0");
}

}  // namespace
}  // namespace perentie::lts

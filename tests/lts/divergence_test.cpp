// Divergence on hand-made graphs, and the Boost view that it runs on.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/graph/graph_concepts.hpp>
#include <memory>
#include <string>

#include "graph.hpp"
#include "perentie/lts/divergence.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::lts {
namespace {

using test::lts_from;

BOOST_CONCEPT_ASSERT((boost::VertexListGraphConcept<TauGraph>));
BOOST_CONCEPT_ASSERT((boost::IncidenceGraphConcept<TauGraph>));
BOOST_CONCEPT_ASSERT(
    (boost::ReadablePropertyGraphConcept<TauGraph, std::uint32_t, boost::vertex_index_t>));

std::string divergent(const Lts& lts) {
  std::string states;
  const std::vector<bool> is_divergent = divergent_states(lts);
  for (std::size_t s = 0; s < is_divergent.size(); ++s) {
    if (is_divergent[s]) states += std::to_string(s);
  }
  return states;
}

TEST(TauGraphTest, ShowsOnlyTauEdges) {
  const Lts lts = lts_from("0 a 1; 0 tau 0; 0 tau 1; 1 a 0");
  const TauGraph graph{&lts};
  EXPECT_EQ(num_vertices(graph), 2U);
  EXPECT_EQ(out_degree(0, graph), 2U);
  EXPECT_EQ(out_degree(1, graph), 0U);
  const auto [first, last] = out_edges(0, graph);
  ASSERT_EQ(last - first, 2);
  EXPECT_EQ(source(first[1], graph), 0U);
  EXPECT_EQ(target(first[1], graph), 1U);
}

TEST(DivergenceTest, NeedsATauCycle) {
  EXPECT_EQ(divergent(lts_from("0")), "");
  EXPECT_EQ(divergent(lts_from("0 a 0; 0 tick 0")), "") << "visible loops do not diverge";
  EXPECT_EQ(divergent(lts_from("0 tau 1; 1 tau 2; 2 a 0")), "");
  EXPECT_EQ(divergent(lts_from("0 tau 0")), "0");
  EXPECT_EQ(divergent(lts_from("0 tau 1; 1 tau 2; 2 tau 0")), "012");
}

TEST(DivergenceTest, SpreadsBackAlongTauOnly) {
  EXPECT_EQ(divergent(lts_from("0 tau 1; 1 tau 2; 2 tau 1; 3 a 1; 4 tau 0; 2 tau 5")), "0124");
  EXPECT_EQ(divergent(lts_from("0 a 1; 1 tau 1; 2 tau 2")), "12")
      << "unreachable states have an answer too";
}

TEST(DivergenceTest, TheLoopNeedNotBeReachedFirst) {
  EXPECT_EQ(divergent(lts_from("3 tau 2; 2 tau 1; 1 tau 0; 0 tau 0")), "0123");
  EXPECT_EQ(divergent(lts_from("0 tau 1; 0 tau 2; 1 tau 3; 2 tau 3; 3 tau 4; 4 tau 4; 5 tau 6")),
            "01234");
}

TEST(DivergenceTest, AChainOfAMillionStatesDoesNotRecurse) {
  constexpr std::uint32_t count = 1'000'000;
  LtsRowBuilder rows;
  for (std::uint32_t s = 0; s < count; ++s) {
    rows.add_edge(tau, State{s + 1 < count ? s + 1 : s});
    rows.end_row();
  }
  const Lts lts = std::move(rows).finish(State{0}, count,
                                         std::make_shared<const LabelNames>(LabelNames{
                                             std::string(tau_name), std::string(tick_name)}));
  const std::vector<bool> result = divergent_states(lts);
  EXPECT_EQ(std::count(result.begin(), result.end(), true), count);
}

}  // namespace
}  // namespace perentie::lts

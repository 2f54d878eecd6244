// Exploration, hiding and shortest paths on random graphs against the definitions.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "perentie/lts/explore.hpp"
#include "perentie/lts/hide.hpp"
#include "perentie/lts/lts_system.hpp"
#include "perentie/lts/trace.hpp"
#include "perentie/test/gen_lts.hpp"
#include "perentie/test/lts_oracles.hpp"

namespace perentie::lts {
namespace {

using test::arbitrary_lts;
using Triple = std::tuple<std::uint32_t, Label, std::uint32_t>;

std::set<Triple> triples(const Lts& lts) {
  std::set<Triple> result;
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const Edge& edge : lts.edges(State{s})) result.insert({s, edge.label, edge.target.value});
  }
  return result;
}

Lts relabel(const Lts& lts, const std::vector<Label>& image) {
  LtsBuilder builder(lts.shared_label_names());
  builder.add_states(static_cast<std::uint32_t>(lts.state_count()));
  for (const auto& [s, label, t] : triples(lts)) {
    builder.add_edge(State{s}, image[label.value], State{t});
  }
  return std::move(builder).finish(lts.initial());
}

std::vector<bool> arbitrary_events(const Lts& lts) {
  auto chosen =
      *rc::gen::container<std::vector<bool>>(lts.label_names().size(), rc::gen::arbitrary<bool>());
  chosen[tau.value] = chosen[tick.value] = false;
  return chosen;
}

test::StateSet reachable(const Lts& lts) {
  test::StateSet set = test::StateSet{1} << lts.initial().value;
  for (std::size_t round = 0; round < lts.state_count(); ++round) {
    for (std::uint32_t l = 0; l < lts.label_names().size(); ++l) {
      set |= test::step(lts, set, Label{l});
    }
  }
  return set;
}

RC_GTEST_PROP(GraphPropertyTest, ExploringAnLtsGivesItsReachablePart, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 10});
  LtsSystem system(lts);
  const auto result = explore(system);
  RC_ASSERT(result.complete());
  RC_ASSERT(result.transitions_fired == result.lts.edge_count());

  test::StateSet found = 0;
  for (const State s : result.states) {
    RC_ASSERT(!test::contains(found, s.value));
    found |= test::StateSet{1} << s.value;
  }
  RC_ASSERT(found == reachable(lts));
  std::set<Triple> mapped;
  for (const auto& [s, label, t] : triples(result.lts)) {
    mapped.insert({result.states[s].value, label, result.states[t].value});
  }
  std::set<Triple> expected = triples(lts);
  std::erase_if(expected, [&](const Triple& e) { return !test::contains(found, std::get<0>(e)); });
  RC_ASSERT(mapped == expected);
}

RC_GTEST_PROP(GraphPropertyTest, ALimitedExplorationIsAPrefixOfTheWhole, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 10});
  LtsSystem system(lts);
  const auto whole = explore(system);
  const auto max_states = *rc::gen::inRange<std::uint64_t>(1, whole.states.size() + 1);
  const auto part = explore(system, {.limits = {.max_states = max_states}});
  RC_ASSERT(part.complete() == (max_states == whole.states.size()));
  RC_ASSERT(part.limit.has_value() == !part.complete());
  RC_ASSERT(part.states.size() == max_states);
  for (std::uint32_t s = 0; s < max_states; ++s) {
    RC_ASSERT(part.states[s] == whole.states[s]);
    const auto edges = part.lts.edges(State{s});
    if (s < part.expanded) {
      RC_ASSERT(std::ranges::equal(edges, whole.lts.edges(State{s})));
    } else {
      RC_ASSERT(edges.empty());
    }
  }
}

RC_GTEST_PROP(GraphPropertyTest, HidingChangesExactlyTheHiddenLabels, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 8, .events = {"a", "b", "c"}});
  const std::vector<bool> is_hidden = arbitrary_events(lts);
  std::vector<Label> hidden;
  std::vector<Label> kept;
  for (std::uint32_t l = 0; l < is_hidden.size(); ++l) {
    (is_hidden[l] ? hidden : kept).push_back(Label{l});
  }
  std::set<Triple> expected;
  for (const auto& [s, label, t] : triples(lts)) {
    expected.insert({s, is_hidden[label.value] ? tau : label, t});
  }
  RC_ASSERT(triples(hide(lts, hidden)) == expected);
  RC_ASSERT(triples(project(lts, kept)) == expected);
  RC_ASSERT(hide(lts, hidden).initial() == lts.initial());
}

RC_GTEST_PROP(GraphPropertyTest, HidingCommutesWithRelabelling, ()) {
  // P[[f]] \ A = (P \ f^-1(A))[[f]]; CSPM reference 4.2.
  const Lts lts = *arbitrary_lts({.max_states = 8, .events = {"a", "b", "c"}});
  const std::vector<bool> is_hidden = arbitrary_events(lts);
  std::vector<Label> image{tau, tick};
  for (std::uint32_t l = 2; l < is_hidden.size(); ++l) {
    image.push_back(
        Label{*rc::gen::inRange<std::uint32_t>(2, static_cast<std::uint32_t>(is_hidden.size()))});
  }
  const Lts left = hide_if(relabel(lts, image), [&](Label l) { return is_hidden[l.value]; });
  const Lts right =
      relabel(hide_if(lts, [&](Label l) { return is_hidden[image[l.value].value]; }), image);
  RC_ASSERT(test::traces(left, 4) == test::traces(right, 4));
  RC_ASSERT(triples(left) == triples(right));
}

RC_GTEST_PROP(GraphPropertyTest, HiddenTracesAreTheTracesWithoutHiddenEvents, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 5});
  const std::vector<bool> is_hidden = arbitrary_events(lts);
  const Lts hidden = hide_if(lts, [&](Label l) { return is_hidden[l.value]; });
  for (test::Word trace : test::traces(lts, 4)) {
    const test::StateSet states = test::after(lts, trace);
    std::erase_if(trace, [&](Label l) { return is_hidden[l.value]; });
    RC_ASSERT((test::after(hidden, trace) & states) == states);
  }
}

/// The number of edges on a shortest path to `goal`, by trying lengths; nothing beyond `max`.
std::optional<std::size_t> distance(const Lts& lts, std::uint32_t goal, std::size_t max) {
  test::StateSet at = test::StateSet{1} << lts.initial().value;
  for (std::size_t length = 0; length <= max; ++length) {
    if (test::contains(at, goal)) return length;
    test::StateSet next = 0;
    for (std::uint32_t l = 0; l < lts.label_names().size(); ++l) {
      next |= test::step(lts, at, Label{l});
    }
    at = next;
  }
  return std::nullopt;
}

bool is_path(const Lts& lts, const Path& path) {
  State at = lts.initial();
  for (const Edge& edge : path) {
    if (!triples(lts).contains({at.value, edge.label, edge.target.value})) return false;
    at = edge.target;
  }
  return true;
}

RC_GTEST_PROP(GraphPropertyTest, ShortestPathsAreShortestPaths, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 8});
  for (std::uint32_t goal = 0; goal < lts.state_count(); ++goal) {
    const auto path = shortest_path(lts, [&](State s) { return s.value == goal; });
    const auto expected = distance(lts, goal, lts.state_count());
    RC_ASSERT(path.has_value() == expected.has_value());
    if (!path) continue;
    RC_ASSERT(path->size() == *expected);
    RC_ASSERT(is_path(lts, *path));
    RC_ASSERT(end_of(lts, *path).value == goal);
  }
}

RC_GTEST_PROP(GraphPropertyTest, PathsAlongATraceExistIffTheStateIsThereAfterIt, ()) {
  const Lts lts = *arbitrary_lts({.max_states = 5});
  for (const test::Word& trace : test::traces(lts, 3)) {
    const test::StateSet states = test::after(lts, trace);
    for (std::uint32_t goal = 0; goal < lts.state_count(); ++goal) {
      const auto path = shortest_path(
          lts, [&](State s) { return s.value == goal; }, trace);
      RC_ASSERT(path.has_value() == test::contains(states, goal));
      if (!path) continue;
      RC_ASSERT(is_path(lts, *path));
      RC_ASSERT(trace_of(*path) == trace);
      RC_ASSERT(end_of(lts, *path).value == goal);
    }
  }
}

}  // namespace
}  // namespace perentie::lts

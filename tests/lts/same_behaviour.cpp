#include "same_behaviour.hpp"

#include <algorithm>
#include <set>

#include "perentie/test/lts_oracles.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::test {

namespace {

using lts::GeneralisedLts;
using lts::Lts;
using lts::State;

bool any_diverges(const Lts& lts, StateSet set) {
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (contains(set, s) && diverges(lts, s)) return true;
  }
  return false;
}

bool any_diverges(const GeneralisedLts& result, StateSet set) {
  for (std::uint32_t s = 0; s < result.lts.state_count(); ++s) {
    if (contains(set, s) && result.divergent[s]) return true;
  }
  return false;
}

std::set<LabelSet> acceptances_after(const GeneralisedLts& result, StateSet set) {
  std::set<LabelSet> all;
  for (std::uint32_t s = 0; s < result.lts.state_count(); ++s) {
    if (!contains(set, s)) continue;
    for (const lts::AcceptanceId id : result.acceptances.of(State{s})) {
      const auto labels = result.acceptances.labels(id);
      all.insert(LabelSet(labels.begin(), labels.end()));
    }
  }
  std::set<LabelSet> minimal;
  for (const LabelSet& candidate : all) {
    const bool is_minimal = std::all_of(all.begin(), all.end(), [&](const LabelSet& other) {
      return other == candidate ||
             !std::includes(candidate.begin(), candidate.end(), other.begin(), other.end());
    });
    if (is_minimal) minimal.insert(candidate);
  }
  return minimal;
}

std::set<LabelSet> acceptances_after(const Lts& lts, StateSet set) {
  return minimal_acceptances(lts, set);
}

const Lts& graph_of(const Lts& lts) { return lts; }
const Lts& graph_of(const GeneralisedLts& result) { return result.lts; }

template <class Result>
std::string wrong(const Lts& original, const Result& result, std::size_t depth) {
  const Lts& graph = graph_of(result);
  const auto expected = traces_and_states(original, depth);
  const auto found = traces_and_states(graph, depth);
  if (expected.size() != found.size()) return "the traces";
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::string after = " after <" + to_text(original, expected[i].trace) + ">";
    if (expected[i].trace != found[i].trace) return "the traces" + after;
    if (any_diverges(original, expected[i].states) != any_diverges(result, found[i].states)) {
      return "divergence" + after;
    }
    if (minimal_acceptances(original, expected[i].states) !=
        acceptances_after(result, found[i].states)) {
      return "acceptances" + after;
    }
  }
  return {};
}

}  // namespace

std::string wrong_in_compression(const Lts& original, const Lts& result, std::size_t depth) {
  return wrong(original, result, depth);
}

std::string wrong_in_compression(const Lts& original, const GeneralisedLts& result,
                                 std::size_t depth) {
  for (std::uint32_t s = 0; s < result.lts.state_count(); ++s) {
    if (!is_stable(result.lts, s)) return "a τ is left";
  }
  return wrong(original, result, depth);
}

}  // namespace perentie::test

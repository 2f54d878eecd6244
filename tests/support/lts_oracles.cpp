#include "perentie/test/lts_oracles.hpp"

#include <algorithm>

#include "perentie/base/check.hpp"

namespace perentie::test {

namespace {

bool includes(const LabelSet& larger, const LabelSet& smaller) {
  return std::includes(larger.begin(), larger.end(), smaller.begin(), smaller.end());
}

}  // namespace

StateSet step(const lts::Lts& lts, StateSet from, lts::Label label) {
  PERENTIE_CHECK(lts.state_count() <= 64, "the oracles are for at most 64 states");
  StateSet to = 0;
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (!contains(from, s)) continue;
    for (const lts::Edge& edge : lts.edges(lts::State{s})) {
      if (edge.label == label) to |= StateSet{1} << edge.target.value;
    }
  }
  return to;
}

StateSet tau_closure(const lts::Lts& lts, StateSet set) {
  while (true) {
    const StateSet more = set | step(lts, set, lts::tau);
    if (more == set) return set;
    set = more;
  }
}

StateSet after(const lts::Lts& lts, const Word& trace) {
  StateSet set = tau_closure(lts, StateSet{1} << lts.initial().value);
  for (const lts::Label label : trace) set = tau_closure(lts, step(lts, set, label));
  return set;
}

std::vector<TraceAndStates> traces_and_states(const lts::Lts& lts, std::size_t depth) {
  std::vector<TraceAndStates> found{{{}, after(lts, {})}};
  for (std::size_t i = 0; i < found.size() && found[i].trace.size() < depth; ++i) {
    for (std::uint32_t l = lts::tick.value; l < lts.label_names().size(); ++l) {
      const StateSet states = tau_closure(lts, step(lts, found[i].states, lts::Label{l}));
      if (states == 0) continue;
      Word longer = found[i].trace;
      longer.push_back(lts::Label{l});
      found.push_back({std::move(longer), states});
    }
  }
  return found;
}

std::vector<Word> traces(const lts::Lts& lts, std::size_t depth) {
  std::vector<Word> words;
  for (TraceAndStates& found : traces_and_states(lts, depth)) {
    words.push_back(std::move(found.trace));
  }
  return words;
}

bool is_stable(const lts::Lts& lts, std::uint32_t state) {
  return step(lts, StateSet{1} << state, lts::tau) == 0;
}

LabelSet initials(const lts::Lts& lts, std::uint32_t state) {
  LabelSet labels;
  for (const lts::Edge& edge : lts.edges(lts::State{state})) labels.insert(edge.label);
  return labels;
}

bool diverges(const lts::Lts& lts, std::uint32_t state) {
  StateSet set = StateSet{1} << state;
  for (std::size_t i = 0; i < lts.state_count(); ++i) set = step(lts, set, lts::tau);
  return set != 0;
}

std::set<LabelSet> minimal_acceptances(const lts::Lts& lts, StateSet set) {
  std::set<LabelSet> all;
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (contains(set, s) && is_stable(lts, s)) all.insert(initials(lts, s));
  }
  std::set<LabelSet> minimal;
  for (const LabelSet& candidate : all) {
    const bool is_minimal = std::all_of(all.begin(), all.end(), [&](const LabelSet& other) {
      return other == candidate || !includes(candidate, other);
    });
    if (is_minimal) minimal.insert(candidate);
  }
  return minimal;
}

std::optional<NaiveNondeterminism> first_nondeterminism(const lts::Lts& lts, bool with_divergence,
                                                        std::size_t depth) {
  for (const auto& [trace, states] : traces_and_states(lts, depth)) {
    for (std::uint32_t l = lts::tick.value; l < lts.label_names().size(); ++l) {
      bool performed = false;
      bool refused = false;
      for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
        if (!contains(states, s)) continue;
        const bool performs = step(lts, StateSet{1} << s, lts::Label{l}) != 0;
        performed = performed || performs;
        refused = refused || (is_stable(lts, s) && !performs);
      }
      if (performed && refused) return NaiveNondeterminism{trace, lts::Label{l}};
    }
    for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
      if (with_divergence && contains(states, s) && diverges(lts, s)) {
        return NaiveNondeterminism{trace, std::nullopt};
      }
    }
  }
  return std::nullopt;
}

}  // namespace perentie::test

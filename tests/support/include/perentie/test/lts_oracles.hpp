// What LTS algorithms must compute, by definition and without cleverness, for graphs of at most 64
// states: the second opinion of the property tests.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "perentie/lts/lts.hpp"

namespace perentie::test {

using StateSet = std::uint64_t;  ///< bit s: state s is in the set
using Word = std::vector<lts::Label>;
using LabelSet = std::set<lts::Label>;

constexpr bool contains(StateSet set, std::uint32_t state) { return ((set >> state) & 1U) != 0; }

/// The states that one edge with this label leads to.
StateSet step(const lts::Lts& lts, StateSet from, lts::Label label);
/// With everything that τ leads to.
StateSet tau_closure(const lts::Lts& lts, StateSet set);
/// The states that the process may be in after a trace, ✓ included; empty: it is no trace.
StateSet after(const lts::Lts& lts, const Word& trace);
/// All traces of at most `depth` labels, shorter ones first and otherwise in label order.
std::vector<Word> traces(const lts::Lts& lts, std::size_t depth);

struct TraceAndStates {
  Word trace;
  StateSet states;  ///< `after(lts, trace)`
};
std::vector<TraceAndStates> traces_and_states(const lts::Lts& lts, std::size_t depth);

bool is_stable(const lts::Lts& lts, std::uint32_t state);
LabelSet initials(const lts::Lts& lts, std::uint32_t state);
/// A state diverges iff it can make as many τ steps as there are states.
bool diverges(const lts::Lts& lts, std::uint32_t state);
/// The acceptances of the stable states of a set that include no other.
std::set<LabelSet> minimal_acceptances(const lts::Lts& lts, StateSet set);

struct NaiveNondeterminism {
  Word trace;
  std::optional<lts::Label> event;  ///< none: divergence
};
/// The first trace of at most `depth` labels, in the order of `traces`, after which some label can
/// be performed and refused (the least is given) or, if asked for, the process can diverge.
std::optional<NaiveNondeterminism> first_nondeterminism(const lts::Lts& lts, bool with_divergence,
                                                        std::size_t depth);

}  // namespace perentie::test

// GeneralisedLts: an Lts whose states carry what their edges alone no longer say.
//
// A compression that removes τ has to remember which failures and divergences were behind it: each
// state has minimal acceptances and a divergence mark (CSPM reference 4.7.1).
#pragma once

#include <vector>

#include "perentie/lts/acceptances.hpp"
#include "perentie/lts/lts.hpp"

namespace perentie::lts {

/// The failures of a state are those that its acceptances allow; that a state has no τ says nothing
/// of its own. `divergent` and `acceptances` are by state.
struct GeneralisedLts {
  Lts lts;
  std::vector<bool> divergent;
  Acceptances acceptances;
};

/// An Lts with the same traces, failures and divergences, in which edges say everything: a state
/// that diverges has a τ to itself, and one that may refuse some of its labels has for each
/// acceptance a τ to a stable state that offers just that.
Lts plain_lts(const GeneralisedLts& generalised);

/// Whether every τ of a state, but one to itself, leads to a stable state that has no edge that the
/// state has not. Such a τ only chooses an acceptance: in T, F and FD the state is one of a
/// generalised LTS. True of all states that `plain_lts` makes.
bool only_chooses_acceptances(const Lts& lts, State state);

}  // namespace perentie::lts

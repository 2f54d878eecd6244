// Divergence-respecting delay and weak bisimulation: `dbisim` and `wbisim`.
//
// Bisimilar states match a visible step a by τ* a (delay) or τ* a τ* (weak), a τ by τ*, and both or
// neither diverge (CSPM reference 4.7.5). The quotient has no superfluous transitions; a divergence
// is a τ loop. Both keep traces, failures and divergences. Boulgakov, Gibson-Robinson & Roscoe,
// *Computing maximal weak and other bisimulations*, Formal Aspects of Computing 28 (2016): states
// are signed in topological order of τ, and only those whose signature may have changed.
#pragma once

#include <variant>

#include "perentie/base/limits.hpp"
#include "perentie/lts/bisimulation.hpp"

namespace perentie::lts {

using QuotientResult = std::variant<Quotient, base::LimitReached>;

/// A signature is the set of steps behind τ*, so time and memory may grow with the square of the
/// number of states, for graphs with long runs of τ that do not reduce. `max_states` does not
/// matter: no states are made.
QuotientResult delay_bisimulation(const Lts& lts, const base::Limits& limits = {});
QuotientResult weak_bisimulation(const Lts& lts, const base::Limits& limits = {});

}  // namespace perentie::lts

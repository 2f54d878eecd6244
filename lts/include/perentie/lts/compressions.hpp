// FDR's compressions as functions on explicit graphs, besides the bisimulations (CSPM reference
// 4.7). All keep traces, failures and divergences; those that remove τ give a generalised Lts.
//
// `explicate` and `lazyenumerate` have nothing to do here: an Lts is explicit.
#pragma once

#include <variant>

#include "perentie/base/limits.hpp"
#include "perentie/lts/bisimulation.hpp"
#include "perentie/lts/generalised_lts.hpp"

namespace perentie::lts {

/// Every strongly connected component of τ edges becomes one state, with a τ loop if it had a τ
/// edge inside (CSPM reference 4.7.3). O(states + edges).
Quotient tau_loop_factor(const Lts& lts);

using GeneralisedResult = std::variant<GeneralisedLts, base::LimitReached>;

/// The states that visible steps lead to, each with the visible steps, minimal acceptances and
/// divergence that τ leads it to; no τ is left. A step to a state that τ leads to from another
/// target of the same step is left out. Never more states than `lts` has (CSPM reference 4.7.6).
GeneralisedResult diamond(const Lts& lts, const base::Limits& limits = {});

/// The normal form with its minimal acceptances and divergence, reduced by strong bisimulation
/// (CSPM reference 4.7.7). The graph is reduced by delay bisimulation before: the subset
/// construction meets far fewer states in τ-rich graphs and gives the same. `max_states` counts the
/// nodes before the reduction.
GeneralisedResult normal(const Lts& lts, const base::Limits& limits = {});

}  // namespace perentie::lts

// Divergence: which states can perform an infinite run of τ.
#pragma once

#include <vector>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

/// By state: whether an infinite sequence of τ begins there, that is, whether τ edges lead from it
/// to a cycle of τ edges (the states of a finite graph have no other infinite τ runs). O(states +
/// edges).
std::vector<bool> divergent_states(const Lts& lts);

}  // namespace perentie::lts

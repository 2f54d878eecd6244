// Whether a machine may perform τ for ever, by its leaves and rules alone.
//
// In a cycle of τ every leaf comes back to where it was. So a rule takes part in one only if each
// of its leaves has the rule's event on a cycle of edges whose events are those of such rules, too.
// Rules are crossed out until that holds of those that are left; if none is, nothing diverges. The
// idea is that of static livelock analysis (Ouaknine, Palikareva, Roscoe and Worrell, LMCS 2013),
// with the leaves as graphs instead of syntax.
#pragma once

#include <vector>

#include "machine/leaf.hpp"
#include "machine/rules.hpp"

namespace perentie::semantics {

/// False: certainly not. `leaves` are those that the rules speak of.
bool may_diverge(const std::vector<const LeafGraph*>& leaves, const RuleBuilder& builder,
                 const RuleBuilder::Rules& rules);

}  // namespace perentie::semantics

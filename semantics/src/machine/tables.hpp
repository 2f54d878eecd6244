// Rules over leaf LTSs to the tables of a machine.
//
// Each rule is led by the leaf that can take part in the fewest of its states: only what the leader
// can do is looked at, the other leaves are asked. Events of a leaf that no rule has are dropped.
// ✓ is one rule of all leaves, which sends each into a state of its own, so that a terminated whole
// is one state (CSPM reference 4.1.2). In a machine that is a leaf, ✓ leads where it does there.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "machine/leaf.hpp"
#include "machine/rules.hpp"
#include "perentie/semantics/machine.hpp"

namespace perentie::semantics {

enum class Termination : std::uint8_t {
  of_leaf,    ///< the machine is a leaf, and has a rule for its ✓
  passed_on,  ///< no operator has several operands
  joined,     ///< some operator waits for the ✓ of its operands
};

/// `leaves` points to the graph of each leaf; none may be null. Nothing: the states are too wide.
std::optional<CompiledMachine> make_tables(const std::vector<const LeafGraph*>& leaves,
                                           const RuleBuilder& builder,
                                           const RuleBuilder::Rules& rules,
                                           Termination termination);

}  // namespace perentie::semantics

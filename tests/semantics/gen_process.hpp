// Random processes as CSPM text, for properties: every operator, three events, a few states.
//
// Only to be called inside a rapidcheck property.
#pragma once

#include <string>

namespace perentie::semantics::test {

/// What stands before all definitions.
inline constexpr const char* header =
    "external prioritise\n"
    "transparent sbisim, dbisim, wbisim, tau_loop_factor, diamond, normal\n"
    "channel a, b, c\n";

/// A number in [0, end).
int pick(int end);
std::string some_event();
std::string some_compression();
/// A process that is a leaf of a machine. `may_recur`: it may lead to P0, P1 and P2.
std::string some_sequential(int depth, bool may_recur);
/// A process over P0, P1 and P2 with the operators that machines have rules for.
std::string some_process(int depth);
/// The header and definitions of P0, P1 and P2.
std::string some_definitions();

}  // namespace perentie::semantics::test

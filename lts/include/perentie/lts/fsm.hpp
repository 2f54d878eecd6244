// FSM output of an Lts, the format of mCRL2: no parameters, a line a state, then the transitions.
//
// States are numbered from 1 and the first is the initial one, so an initial state that is not 0
// changes places with 0. τ is `tau` and ✓ is `tick`, as in .aut files. Format: mCRL2 user manual,
// "FSM file format".
#pragma once

#include <iosfwd>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

/// Errors are those of the stream. The format has no escapes: a quote in a name becomes `'`, and a
/// line end a blank.
void write_fsm(std::ostream& out, const Lts& lts);

}  // namespace perentie::lts

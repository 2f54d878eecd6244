// Watchdogs: specifications as processes that run beside an implementation and give the alarm.
//
// A watchdog W of a specification follows what the implementation does: they run in parallel and
// synchronise on A, the alphabet of the implementation (CSPM reference 4.6.2, 4.6.3; Goldsmith,
// Moffat, Roscoe, Whitworth and Zakiuddin, *Watchdog Transformations for Property-Oriented
// Model-Checking*, FME 2003). Where the specification allows a set I of events, W offers I and A,
// and an event of A that is not in I leads to a state that can perform `bark` alone, and then
// stops:
//
//     Spec [T= Impl  iff  STOP [T= (trace_watchdog(Spec, A, bark) [|A|] Impl) \ A
//     Spec [F= Impl  iff  failure_watchdog(Spec, A, bark) [|A|] Impl :[deadlock free [F]]
//
// The first part is FDR's. How FDR's failure watchdog lays out its states is not known; ours is
// made from the property. Implementations that refuse too much are those that refuse a set which
// has an event of each minimal acceptance of the specification: a node has a τ to one state for
// each smallest such set (its minimal hitting sets, found as by Berge, *Hypergraphs*, chapter 2),
// which offers this set alone. Where the specification may refuse everything there is no such set,
// and a τ from the node to itself keeps the watchdog from being the reason of a deadlock. That τ is
// a divergence, so the property is one of the stable failures model alone.
//
// The properties hold for processes that do not terminate; the second also needs A to hold the
// events of the specification, and an implementation that does not diverge after an event that is
// not allowed. ✓ is a label like any other, but never in A: W offers it where the specification
// does, and stops after it; an implementation that terminates against the specification is held up
// and not barked at.
#pragma once

#include <span>
#include <variant>

#include "perentie/base/limits.hpp"
#include "perentie/lts/lts.hpp"

namespace perentie::lts {

using WatchdogResult = std::variant<Lts, base::LimitReached>;

/// `events` and `bark` must have names in the label table. The specification is normalised:
/// `max_states` counts the nodes.
WatchdogResult trace_watchdog(const Lts& specification, std::span<const Label> events, Label bark,
                              const base::Limits& limits = {});

/// The same. `max_states` also counts the states of the result, and there are at most 100,000
/// hitting sets.
WatchdogResult failure_watchdog(const Lts& specification, std::span<const Label> events, Label bark,
                                const base::Limits& limits = {});

}  // namespace perentie::lts

// Refusal testing as refinement of traces: what a stable state offers becomes an event.
//
// An observer who sees refusals between the events of a trace tells more processes apart than one
// who sees them at its end (Roscoe, "Understanding Concurrent Systems", 2010, chapters 11 and 12).
// Each stable state gets an edge, labelled with what is offered there, to a copy of itself that can
// only perform its events. The implementation has the one edge of its own offer; the specification
// has an edge for every such offer that includes its own, as it then refuses at least as much.
// Trace refinement of these graphs is refinement in R; with divergence as in FD, in RD.
#pragma once

#include <span>
#include <vector>

#include "perentie/lts/lts.hpp"
#include "perentie/lts/runs.hpp"

namespace perentie::lts {

/// A graph with observations; its first states and labels are those of the original.
struct ObservedLts {
  Lts lts;
  std::vector<State> origins;  ///< by state: of which state it is the copy, or itself
};

struct RefusalTest {
  ObservedLts specification;
  ObservedLts implementation;
  /// Labels from here on are observations: what is offered, ascending.
  Label first_observation;
  Runs<Label> observations;

  bool is_observation(Label label) const { return label.value >= first_observation.value; }
  std::span<const Label> observation(Label label) const {
    return observations[label.value - first_observation.value];
  }
};

/// The labels of both graphs must mean the same, as far as both have them.
RefusalTest test_refusals(const Lts& specification, const Lts& implementation);

}  // namespace perentie::lts

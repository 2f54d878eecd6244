// Refinement in the stable-revivals model: what a stable state offers, not only what it refuses.
//
// After a trace, a stable state of the implementation that offers nothing needs one of the
// specification that offers nothing; and each event that it offers must be offered by a stable
// state of the specification that offers nothing else than the implementation does. Roscoe,
// "Revivals, stuckness and the hierarchy of CSP models", 2009. ✓ is an event like any other (CSPM
// reference 4.1.3), as in the failures model here.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "perentie/lts/runs.hpp"
#include "perentie/lts/specifications.hpp"

namespace perentie::lts {

/// The acceptances of all stable states of each node, not the minimal ones only. `normal` is the
/// normal form of `original`.
class StableOffers {
 public:
  StableOffers(const NormalLts& normal, const Lts& original);

  std::span<const AcceptanceId> of(State node) const { return of_node_[node.value]; }
  std::span<const Label> labels(AcceptanceId id) const { return sets_[id]; }

 private:
  UniqueRuns<AcceptanceId, Label> sets_;
  Runs<AcceptanceId> of_node_;
};

/// A `Specification` for `refine` in the models F (for V) and FD (for VD). Keeps references.
class RevivalSpecification {
 public:
  RevivalSpecification(const NormalLts& normal, const StableOffers& offers)
      : edges_(normal), offers_(&offers) {}

  State next(State node, Label label) const { return edges_.next(node, label); }
  bool accepts(State node, std::span<const Label> offered) const;
  bool allows_divergence(State node) const { return edges_.allows_divergence(node); }

 private:
  NormalSpecification edges_;
  const StableOffers* offers_;
};

}  // namespace perentie::lts

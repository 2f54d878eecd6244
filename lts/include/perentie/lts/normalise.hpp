// normalise: an Lts to its normal form, by τ-closure and subset construction.
//
// The normal form is deterministic and has no τ; ✓ is a label like any other (CSPM
// reference 4.1.3). It has the traces of the original, and its nodes say what failures and
// divergences need: which states the original may then be in, whether one of them diverges, and the
// minimal acceptances (CSPM reference 4.7.7, 5.1.2). It can be exponentially larger than the
// original. Roscoe, *The Theory and Practice of Concurrency*, appendix C.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "perentie/base/limits.hpp"
#include "perentie/lts/acceptances.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/lts/runs.hpp"

namespace perentie::lts {

/// The nodes are the states of `lts`, numbered breadth first with labels ascending.
struct NormalLts {
  Lts lts;              ///< at most one edge a node and label, no τ; the label table is shared
  Runs<State> members;  ///< by node: the states of the original, ascending
  std::vector<bool> divergent;             ///< by node: some member diverges
  std::optional<Acceptances> acceptances;  ///< by node, if they were asked for
};

struct NormaliseOptions {
  /// `max_states` counts nodes; node 0 is always kept.
  base::Limits limits = {};
  bool acceptances = false;
};

struct Normalisation {
  NormalLts normal;
  /// The first `expanded` nodes have all their edges and acceptances, the others neither.
  std::size_t expanded = 0;
  std::optional<base::LimitReached> limit;  ///< the budget that ran out, if one did

  bool complete() const { return expanded == normal.lts.state_count(); }
};

Normalisation normalise(const Lts& lts, const NormaliseOptions& options = {});

}  // namespace perentie::lts

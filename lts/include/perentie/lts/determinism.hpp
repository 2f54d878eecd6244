// check_determinism: whether an Lts is deterministic in the failures or failures-divergences model.
//
// A process is nondeterministic iff after some trace it may both perform and refuse some label a:
// tr^<a> is a trace and (tr, {a}) a failure (CSPM reference 5.3.6). Failures come from stable
// states only; in failures-divergences a divergence fails as well. ✓ is a label like any other
// (4.1.3). The search goes through the subset construction breadth first, so the witness is the
// shortest, and among the shortest the least in label order.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "perentie/base/limits.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/lts/trace.hpp"

namespace perentie::lts {

enum class DeterminismModel : std::uint8_t { failures, failures_divergences };

struct Deterministic {};

/// The two behaviours after `trace` that together show nondeterminism (CSPM reference 5.3.7).
struct Nondeterminism {
  std::vector<Label> trace;    ///< without τ
  std::optional<Label> event;  ///< performed and refused after `trace`; none: a divergence
  /// Shows `trace` and ends in a stable state without `event`, or in a divergent state.
  Path refusing;
  /// Shows `trace` and then performs `event`. Empty for a divergence.
  Path performing;
};

using DeterminismVerdict = std::variant<Deterministic, Nondeterminism, base::LimitReached>;

/// `max_states` counts the sets of states looked at. Where one trace shows both a refused event and
/// a divergence, the event is reported.
DeterminismVerdict check_determinism(const Lts& lts, DeterminismModel model,
                                     const base::Limits& limits = {});

}  // namespace perentie::lts

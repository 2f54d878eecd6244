// Refinement by definition, for graphs of at most 64 states: the second opinion on `lts::refine`.
//
// A process is what can be observed of it: after every trace the set of states that it may be in.
// The specification refuses or diverges iff one of these states does (CSPM reference 5.1.2, 5.2.2).
// Both graphs must share their label table.
#pragma once

#include <cstdint>
#include <optional>

#include "perentie/test/lts_oracles.hpp"

namespace perentie::test {

enum class Semantics : std::uint8_t { traces, failures, failures_divergences };

/// A behaviour of the implementation that the specification does not have.
struct NaiveRefutation {
  enum class Kind : std::uint8_t { event, acceptance, divergence };

  Kind kind;
  Word trace;  ///< without τ; of kind `event`, without the event
};

/// Whether every behaviour of `implementation` is one of `specification`: nothing, or a behaviour
/// with the shortest trace that is not. Goes through pairs of sets of states, so it is exact.
std::optional<NaiveRefutation> naive_refutation(const lts::Lts& specification,
                                                const lts::Lts& implementation,
                                                Semantics semantics);

/// The same question asked of single states of the implementation, level by level, as FDR counts
/// (CSPM reference 6.3.1 - 6.3.3).
struct NaiveCounts {
  std::uint64_t states = 0;
  std::uint64_t transitions = 1;
  std::uint64_t plys = 0;
  bool holds = true;
};
NaiveCounts naive_counts(const lts::Lts& specification, const lts::Lts& implementation,
                         Semantics semantics);

/// What is wrong with the state `state` of the implementation where the specification may be in
/// `after`: the first that applies of event, acceptance and divergence.
std::optional<NaiveRefutation::Kind> naive_violation(const lts::Lts& specification, StateSet after,
                                                     const lts::Lts& implementation,
                                                     std::uint32_t state, Semantics semantics);

/// Whether one of the states diverges.
bool any_diverges(const lts::Lts& lts, StateSet set);

}  // namespace perentie::test

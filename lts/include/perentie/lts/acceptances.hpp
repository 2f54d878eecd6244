// Minimal acceptances: what failures say of a state, in the form in which checks need them.
//
// The acceptance of a stable state is the set of labels that it offers, ✓ included (CSPM reference
// 5.1.3); a state with τ has none. Of a set of states only the acceptances matter that are minimal
// under inclusion: a refusal is possible iff it avoids one of them. Each distinct set is kept once.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "perentie/base/id.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/lts/runs.hpp"

namespace perentie::lts {

using AcceptanceId = base::Id<struct AcceptanceTag>;

/// The minimal acceptances of the states of some graph.
class Acceptances {
 public:
  Acceptances(Runs<Label> sets, Runs<AcceptanceId> of_state)
      : sets_(std::move(sets)), of_state_(std::move(of_state)) {}

  /// The minimal acceptances of a state, ascending; none: no stable state is behind it, it has no
  /// failures but those of divergence.
  std::span<const AcceptanceId> of(State state) const { return of_state_[state.value]; }
  /// The labels of an acceptance, ascending.
  std::span<const Label> labels(AcceptanceId id) const { return sets_[id.value]; }

  /// Those of some states, which get new numbers in that order.
  Acceptances of_states(std::span<const State> states) &&;

  std::size_t state_count() const { return of_state_.size(); }
  std::size_t set_count() const { return sets_.size(); }

 private:
  Runs<Label> sets_;
  Runs<AcceptanceId> of_state_;
};

/// Finds the minimal acceptances of sets of states of one Lts, one set after the other.
class AcceptanceBuilder {
 public:
  /// Keeps a reference: the Lts must outlive the builder.
  explicit AcceptanceBuilder(const Lts& lts) : lts_(lts), initials_(lts.state_count()) {}

  /// Adds what the next set of states accepts.
  void add(std::span<const State> states);
  /// The same of a state together with sets that were added before, by their numbers.
  void add(State state, std::span<const State> before);
  Acceptances finish() &&;

  std::uint64_t peak_bytes() const { return sets_.peak_bytes(0) + minimal_.peak_bytes(0); }

 private:
  AcceptanceId acceptance(State stable);
  void add_found();

  const Lts& lts_;
  std::vector<AcceptanceId> initials_;  // by state, once asked for
  UniqueRuns<AcceptanceId, Label> sets_;
  Runs<AcceptanceId> minimal_;
  std::vector<AcceptanceId> found_;  // scratch
};

}  // namespace perentie::lts

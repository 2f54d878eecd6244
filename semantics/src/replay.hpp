// Runs of a process: paths through its transitions that have a given trace and end as asked for.
//
// The search is breadth first over pairs of a place in the trace and a state, so the run is a
// shortest one and the same on every call.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "perentie/base/limits.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::semantics {

using Step = lts::Transition<ProcId>;

struct Run {
  std::vector<ProcId> states;      ///< one more than the labels
  std::vector<lts::Label> labels;  ///< none: not involved
};

/// A transition system that answers by names, as counterexamples are written.
class NamedTerms {
 public:
  explicit NamedTerms(TermSystem terms) : terms_(std::move(terms)) {}

  TermSystem& terms() { return terms_; }
  /// Empty also where the transitions cannot be computed.
  std::vector<Step> steps(ProcId state);
  const std::string& name(lts::Label label);
  /// What a state offers without τ, each event once, in the order of the labels. Nothing: the state
  /// is not stable.
  std::optional<std::vector<lts::Label>> offers(ProcId state);

 private:
  TermSystem terms_;
  std::shared_ptr<const lts::LabelNames> names_;
};

struct RunSearch {
  std::vector<std::string> trace;
  bool skips_tau = false;  ///< τ may stand between the events of the trace
  std::function<bool(ProcId)> ends_well;
  base::Limits limits = {};
};

/// Nothing: there is no such run, or a budget ran out.
std::optional<Run> find_run(NamedTerms& system, const RunSearch& search);

/// A run of τ that comes back to one of its states: `labels` are all τ, the last state is also the
/// one at `loop_start`.
struct TauLoop {
  Run run;
  std::size_t loop_start = 0;
};
std::optional<TauLoop> find_tau_loop(NamedTerms& system, ProcId start, const base::Limits& limits);

}  // namespace perentie::semantics

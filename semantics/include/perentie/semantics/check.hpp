// Checking the assertions of a script (CSPM reference 2.6, 5).
//
// The specification is explored and normalised, the implementation compared with it on the fly,
// both by the fastest machine. A budget that runs out leaves an assertion open: it is then neither
// true nor false.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/lts/refine.hpp"
#include "perentie/semantics/assertions.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::semantics {

/// The behaviour that refutes a claim, in words. Of a negated assertion it shows that it holds.
struct Witness {
  enum class Kind : std::uint8_t {
    event,           ///< after the trace, `event` is performed, which the specification does not
    acceptance,      ///< after the trace, only `offered` is offered, which is not enough
    divergence,      ///< after the trace, τ is performed for ever
    deadlock,        ///< after the trace, nothing is offered
    nondeterminism,  ///< after the trace, `event` may be performed and may be refused
    missing_event,   ///< after the trace, `event` cannot be performed, or may be refused
  };

  Kind kind;
  std::vector<std::string> trace;  ///< with τ
  std::string event = {};
  std::vector<std::string> offered = {};
  bool is_refused = false;  ///< of a missing event: it may be refused, and only `offered` offered
  /// What the specification allows after the trace: its events, or each of its minimal acceptances.
  std::vector<std::vector<std::string>> allowed = {};
  bool is_exact = false;  ///< in V and R: `allowed` is all that stable states offer
  /// In R: what was offered on the way, after so many events of the trace.
  struct Observation {
    std::size_t place;
    std::vector<std::string> offered;
  };
  std::vector<Observation> observed = {};
  std::string state = {};  ///< the process after the trace
};

struct CheckResult {
  enum class Outcome : std::uint8_t {
    holds,
    fails,
    inconclusive,  ///< `limit` says which budget ran out
    error,         ///< reported as diagnostics
  };

  Outcome outcome;
  lts::RefineCounts counts = {};
  double seconds = 0;
  std::optional<Witness> witness = {};
  std::optional<base::LimitReached> limit = {};
};

/// As reports and recorded results name them: `inconclusive`, `missing event`.
std::string_view name_of(CheckResult::Outcome outcome);
std::string_view name_of(Witness::Kind kind);

CheckResult check(Script& script, const ScriptAssertion& assertion,
                  const lts::ExploreOptions& options, base::Diagnostics& diagnostics);

}  // namespace perentie::semantics

// Varanus's determinism gate: whether hiding what the system does not show keeps the model
// deterministic.
//
// Varanus refuses to monitor a model that hiding makes nondeterministic. Perentie does not need the
// gate, because its monitors follow all states that the model may be in; it is a check of its own
// for those who rely on it. The rule is that of Varanus 0.9.6: with A the channels of the model and
// C those that the system shows, nothing is checked if C ⊇ A; if A ⊋ C, the model with A \ C hidden
// must be deterministic (in failures-divergences, as FDR's `:[deterministic]`); if neither contains
// the other, Varanus aborts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "perentie/base/limits.hpp"
#include "perentie/lts/lts.hpp"

namespace perentie::monitor {

struct DeterminismGate {
  enum class Outcome : std::uint8_t {
    not_needed,        ///< the system shows every channel of the model
    deterministic,     ///< the check was made and holds
    nondeterministic,  ///< the check was made and fails
    incomparable,      ///< each side has channels that the other lacks: there is no rule
    inconclusive,      ///< a budget ran out during the check
  };

  Outcome outcome;
  std::vector<std::string> hidden;  ///< A \ C, sorted
  std::vector<std::string> extra;   ///< C \ A, sorted
  /// If nondeterministic: after this trace the model may perform `event` and may refuse it; with no
  /// event, it may diverge.
  std::vector<std::string> trace;
  std::optional<std::string> event;
  std::optional<base::LimitReached> limit;

  /// Whether Varanus would go on to monitor.
  bool passes() const {
    return outcome == Outcome::not_needed || outcome == Outcome::deterministic;
  }
};

/// `process` is the model with nothing hidden; `alphabet` (A) and `common_alphabet` (C) are
/// channels in the model's terms.
DeterminismGate check_determinism_gate(const lts::Lts& process,
                                       std::span<const std::string> alphabet,
                                       std::span<const std::string> common_alphabet,
                                       const base::Limits& limits = {});

/// One sentence without final period.
std::string explain(const DeterminismGate& gate);

}  // namespace perentie::monitor

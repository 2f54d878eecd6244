// explain: what the process and its components do in a counterexample.
//
// The counterexample of a check is replayed by the step rules. The run that is found is divided at
// the operators that stay in place from its first state to its last, so each component has a
// behaviour of its own, aligned with that of the whole: the same place of all traces is the same
// moment (CSPM reference 7.3.5-7.3.7, 8.7).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "perentie/base/source.hpp"
#include "perentie/semantics/check.hpp"

namespace perentie::semantics {

/// What one process does. Traces contain τ; an empty word says that it is not involved.
struct Behaviour {
  enum class Kind : std::uint8_t {
    trace,       ///< after the trace, `event` is performed; if that is empty, nothing of interest
    acceptance,  ///< after the trace, it is stable and offers `acceptance` only
    loop,        ///< from `loop_start` on, the trace repeats for ever
    irrelevant,  ///< the other behaviour alone is the counterexample
  };
  struct State {
    std::string term;  ///< cut if it is long
    bool is_named = false;
  };

  Kind kind = Kind::trace;
  std::string name = {};  ///< of the process; empty: it has none
  std::vector<std::string> trace = {};
  std::vector<State> states = {};  ///< one more than the trace; empty if they are not known
  std::string event = {};
  std::vector<std::string> acceptance = {};
  std::size_t loop_start = 0;
  std::optional<base::Span> definition = {};  ///< of the last state that is a name
  std::vector<Behaviour> components = {};
};

/// An event that a component offers after the trace and others prevent.
struct Blocked {
  std::string event;  ///< as the components name it
  std::string ready;  ///< who offers it
  /// Who should take part and does not. Empty: the event is outside the alphabet of `ready`.
  std::vector<std::string> refusing;
};

struct Explanation {
  Behaviour implementation;
  /// Of a refinement, what the specification does; of determinism, the second behaviour of the
  /// process, which performs what the first refuses.
  std::optional<Behaviour> specification;
  /// The trace of the implementation with the events that were hidden in place of τ.
  std::vector<std::string> revealed_trace;
  std::vector<Blocked> blocked;
};

struct ExplainOptions {
  base::Limits limits = {};
  bool with_components = true;
};

/// Nothing: a budget ran out before the counterexample was found again.
std::optional<Explanation> explain(Script& script, const ScriptAssertion& assertion,
                                   const Witness& witness, const ExplainOptions& options);

}  // namespace perentie::semantics

// How an instruction says that it cannot be done. Thrown and caught inside the evaluator only: the
// machine turns a failure into a diagnostic at the instruction's place.
#pragma once

#include <string>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/semantics/symbols.hpp"

namespace perentie::semantics {

/// The script is wrong.
struct EvaluationFailure {
  const base::DiagnosticCode* code;
  std::string message;
};

/// The declared fields of a channel or constructor are needed first; then the instruction is
/// repeated.
struct NeedFields {
  SymbolId symbol;
};

/// A budget ran out.
struct EvaluationLimit {
  base::LimitReached reached;
};

[[noreturn]] inline void fail(const base::DiagnosticCode& code, std::string message) {
  throw EvaluationFailure{&code, std::move(message)};
}

}  // namespace perentie::semantics

// Counterexamples in the terms of FDR's reports (CSPM reference 7.3.5-7.3.8).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check_run.hpp"

namespace perentie::cli {

struct FdrCounterexample {
  std::string_view type;   ///< in documents: `refinement_divergence`
  std::string_view title;  ///< in text: `Divergence Counterexample`
  semantics::Behaviour implementation;
  /// Of refinement, determinism and traces.
  std::optional<semantics::Behaviour> specification;
  std::vector<std::string> revealed_trace;  ///< of the implementation
};

/// Nothing: the assertion has no counterexample. Without an explanation the states are unknown.
std::optional<FdrCounterexample> fdr_counterexample(const CheckedAssertion& checked);

/// `min_acceptance`, `Failure Behaviour`.
std::string_view fdr_type(semantics::Behaviour::Kind kind);
std::string_view fdr_title(semantics::Behaviour::Kind kind);

/// `file:line:column-column:` and the message below, as FDR's front end reports errors.
std::string fdr_message(const base::Diagnostic& diagnostic, const base::SourceMap& sources);
std::vector<std::string> fdr_messages(const base::Diagnostics& diagnostics, base::Severity severity,
                                      const base::SourceMap& sources);
/// `file:line:column-column`, or over several lines `file:line:column-line:column`; the end is the
/// place behind the last character.
std::string fdr_location(base::Span span, const base::SourceMap& sources);
/// Why an assertion or print has no result; empty: it has one.
std::vector<std::string> fdr_errors(const CheckedAssertion& checked,
                                    const base::SourceMap& sources);
std::vector<std::string> fdr_errors(const PrintedValue& printed, const base::SourceMap& sources);

}  // namespace perentie::cli

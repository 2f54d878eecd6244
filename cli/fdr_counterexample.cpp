#include "fdr_counterexample.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "perentie/base/overload.hpp"

namespace perentie::cli {
namespace {

using semantics::Behaviour;
using semantics::CheckResult;
using semantics::Witness;

// The type and the title.
using Kind = std::pair<std::string_view, std::string_view>;

Kind kind_of_refinement(const Witness& w) {
  switch (w.kind) {
    case Witness::Kind::divergence:
      return {"refinement_divergence", "Divergence Counterexample"};
    case Witness::Kind::acceptance:
      return {"failure", "Acceptance Counterexample"};
    case Witness::Kind::missing_event:
      return w.is_refused ? Kind{"failure", "Acceptance Counterexample"}
                          : Kind{"trace", "Trace Counterexample"};
    default:
      return {"trace", "Trace Counterexample"};
  }
}

Kind kind_of(const parser::Assertion& assertion, const Witness& w) {
  const auto* claim = std::get_if<parser::PropertyAssertion>(&assertion.claim);
  if (claim == nullptr) return kind_of_refinement(w);
  switch (claim->property) {
    case parser::Property::deadlock_free:
      return {"deadlock", "Deadlock Counterexample"};
    case parser::Property::divergence_free:
      return {"divergence", "Divergence Counterexample"};
    case parser::Property::deterministic:
      return {"determinism", "Determinism Counterexample"};
  }
  return {};
}

// What the witness alone tells, if a budget ran out before it was explained.
Behaviour unexplained(const Witness& w) {
  Behaviour b{.trace = w.trace, .event = w.event, .acceptance = w.offered};
  switch (w.kind) {
    case Witness::Kind::acceptance:
    case Witness::Kind::deadlock:
    case Witness::Kind::nondeterminism:
      b.kind = Behaviour::Kind::acceptance;
      break;
    case Witness::Kind::divergence:
      b.kind = Behaviour::Kind::loop;
      b.loop_start = b.trace.size();
      b.trace.emplace_back(lts::tau_name);
      break;
    case Witness::Kind::missing_event:
      if (w.is_refused) b.kind = Behaviour::Kind::acceptance;
      b.event.clear();
      break;
    case Witness::Kind::event:
      break;
  }
  return b;
}

std::string inconclusive(const base::LimitReached& limit) {
  return "inconclusive: " + base::describe(limit);
}

}  // namespace

std::string_view fdr_type(Behaviour::Kind kind) {
  switch (kind) {
    case Behaviour::Kind::trace:
      return "trace";
    case Behaviour::Kind::acceptance:
      return "min_acceptance";
    case Behaviour::Kind::loop:
      return "loop";
    case Behaviour::Kind::irrelevant:
      return "irrelevant";
  }
  return {};
}

std::string_view fdr_title(Behaviour::Kind kind) {
  switch (kind) {
    case Behaviour::Kind::trace:
      return "Trace Behaviour";
    case Behaviour::Kind::acceptance:
      return "Failure Behaviour";
    case Behaviour::Kind::loop:
      return "Repeat Behaviour";
    case Behaviour::Kind::irrelevant:
      return "Irrelevant Behaviour";
  }
  return {};
}

std::optional<FdrCounterexample> fdr_counterexample(const CheckedAssertion& checked) {
  if (!checked.result.witness) return std::nullopt;
  const Witness& w = *checked.result.witness;
  const auto [type, title] = kind_of(checked.assertion->assertion, w);
  FdrCounterexample found{type, title, {}, {}, {}};
  if (checked.explanation) {
    found.implementation = checked.explanation->implementation;
    found.specification = checked.explanation->specification;
    found.revealed_trace = checked.explanation->revealed_trace;
  } else {
    found.implementation = unexplained(w);
    found.revealed_trace = w.trace;
    const bool has_two =
        !std::holds_alternative<parser::PropertyAssertion>(checked.assertion->assertion.claim) ||
        type == "determinism";
    if (has_two) {
      found.specification = Behaviour{.kind = Behaviour::Kind::irrelevant};
      found.specification->trace.resize(found.implementation.trace.size());
    }
  }
  return found;
}

std::string fdr_location(base::Span span, const base::SourceMap& sources) {
  const base::Position begin = sources.position(span.begin);
  const base::Position end = sources.position(std::max(span.begin, span.end));
  if (span.end <= span.begin) return fmt::format("{}:{}:{}", begin.path, begin.line, begin.column);
  if (begin.line == end.line) {
    return fmt::format("{}:{}:{}-{}", begin.path, begin.line, begin.column, end.column);
  }
  return fmt::format("{}:{}:{}-{}:{}", begin.path, begin.line, begin.column, end.line, end.column);
}

std::string fdr_message(const base::Diagnostic& diagnostic, const base::SourceMap& sources) {
  std::string text =
      diagnostic.span ? fdr_location(*diagnostic.span, sources) : std::string("<unknown location>");
  text += ":\n    " + diagnostic.message;
  for (const base::Note& note : diagnostic.notes) {
    text += "\n    " + note.message;
    if (note.span) text += fmt::format(" ({})", fdr_location(*note.span, sources));
  }
  return text;
}

std::vector<std::string> fdr_messages(const base::Diagnostics& diagnostics, base::Severity severity,
                                      const base::SourceMap& sources) {
  std::vector<std::string> messages;
  for (const base::Diagnostic& d : diagnostics.all()) {
    if (d.code->severity == severity) messages.push_back(fdr_message(d, sources));
  }
  return messages;
}

std::vector<std::string> fdr_errors(const CheckedAssertion& checked,
                                    const base::SourceMap& sources) {
  using Outcome = CheckResult::Outcome;
  const bool is_decided =
      checked.result.outcome == Outcome::holds || checked.result.outcome == Outcome::fails;
  if (is_decided) return {};
  std::vector<std::string> errors =
      fdr_messages(checked.diagnostics, base::Severity::error, sources);
  if (checked.result.limit) errors.push_back(inconclusive(*checked.result.limit));
  if (errors.empty()) errors.emplace_back("the assertion cannot be checked");
  return errors;
}

std::vector<std::string> fdr_errors(const PrintedValue& printed, const base::SourceMap& sources) {
  if (printed.value) return {};
  std::vector<std::string> errors =
      fdr_messages(printed.diagnostics, base::Severity::error, sources);
  if (printed.limit) errors.push_back(inconclusive(*printed.limit));
  if (errors.empty()) errors.emplace_back("the text cannot be parsed");
  return errors;
}

}  // namespace perentie::cli

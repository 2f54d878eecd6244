#include <fmt/format.h>

#include "fdr_report.hpp"
#include "perentie/base/text.hpp"
#include "witness_text.hpp"

namespace perentie::cli {
namespace {

using semantics::Behaviour;
using semantics::CheckResult;

constexpr std::size_t line_width = 100;

std::string indented(std::size_t columns, const std::string& text) {
  std::string lines(columns, ' ');
  for (const char c : text) {
    lines += c;
    if (c == '\n') lines.append(columns, ' ');
  }
  return lines + '\n';
}

// `Trace: <a, b, c>`, with further lines below its first word.
std::string trace_lines(std::size_t columns, const std::string& title,
                        const std::vector<std::string>& trace) {
  std::string text(columns, ' ');
  text += title + "<";
  std::size_t width = text.size();
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const std::string word =
        (trace[i].empty() ? "-" : trace[i]) + (i + 1 < trace.size() ? ", " : "");
    if (width + word.size() > line_width && i > 0) {
      text.erase(text.find_last_not_of(' ') + 1);
      text += '\n' + std::string(columns, ' ');
      width = columns;
    }
    text += word;
    width += word.size();
  }
  return text + ">\n";
}

// Recursion is as deep as the components nest, which is bounded.
std::string behaviour_lines(std::size_t columns, const Behaviour& b, const FdrLayout& layout,
                            const std::vector<std::string>* revealed) {
  std::string text = indented(
      columns, fmt::format("{} ({}):", b.name.empty() ? "<unnamed>" : b.name, fdr_title(b.kind)));
  const std::size_t inner = columns + 4;
  const bool repeats = b.kind == Behaviour::Kind::loop;
  const auto loop =
      b.trace.begin() + static_cast<std::ptrdiff_t>(repeats ? b.loop_start : b.trace.size());
  text += trace_lines(inner, "Trace: ", {b.trace.begin(), loop});
  if (repeats) text += trace_lines(inner, "Repeats the trace: ", {loop, b.trace.end()});
  if (!b.event.empty()) text += indented(inner, "Error Event: " + b.event);
  if (b.kind == Behaviour::Kind::acceptance) {
    text += indented(inner, "Min Acceptance: " + set_of(b.acceptance));
  }
  if (revealed != nullptr) text += trace_lines(inner, "Unhidden trace: ", *revealed);
  if (layout.divide && !b.components.empty()) {
    text += indented(inner, "Component Behaviours:");
    for (const Behaviour& component : b.components) {
      text += behaviour_lines(inner + 4, component, layout, nullptr);
    }
  }
  return text;
}

std::string counterexample_lines(const FdrCounterexample& found, const FdrLayout& layout) {
  std::string text = indented(8, fmt::format("Counterexample ({})", found.title));
  const auto* revealed = layout.reveal_taus ? &found.revealed_trace : nullptr;
  if (found.specification) {
    text += indented(12, "Specification Debug:");
    text += behaviour_lines(16, *found.specification, layout, nullptr);
    text += indented(12, "Implementation Debug:");
  } else {
    text += indented(12, "Machine Debug:");
  }
  return text + behaviour_lines(16, found.implementation, layout, revealed);
}

std::string_view word_of(CheckResult::Outcome outcome) {
  switch (outcome) {
    case CheckResult::Outcome::holds:
      return "Passed";
    case CheckResult::Outcome::fails:
      return "Failed";
    case CheckResult::Outcome::inconclusive:
      return "Inconclusive";
    case CheckResult::Outcome::error:
      return "Error";
  }
  return {};
}

std::string coloured(CheckResult::Outcome outcome, const FdrLayout& layout) {
  const std::string_view word = word_of(outcome);
  if (!layout.colour) return std::string(word);
  const int colour = outcome == CheckResult::Outcome::holds   ? 32
                     : outcome == CheckResult::Outcome::fails ? 31
                                                              : 33;
  return fmt::format("\033[{}m{}\033[m", colour, word);
}

}  // namespace

std::string fdr_text(const CheckedAssertion& checked, const FdrLayout& layout,
                     const base::SourceMap& sources) {
  const CheckResult& result = checked.result;
  const std::vector<std::string> errors = fdr_errors(checked, sources);
  std::string text;
  if (layout.brief) {
    text = fmt::format("{}: {}\n", checked.assertion->text, coloured(result.outcome, layout));
    return text;
  }
  text = fmt::format("{}:\n    Log:\n", checked.assertion->text);
  if (!layout.quiet && errors.empty()) text += "        Finished\n";
  text += indented(layout.quiet ? 8 : 4, "Result: " + coloured(result.outcome, layout));
  for (const std::string& error : errors) text += indented(8, error);
  if (!errors.empty()) return text;
  text += indented(8, "Visited States: " + base::with_thousands(result.counts.states));
  text += indented(8, "Visited Transitions: " + base::with_thousands(result.counts.transitions));
  text += indented(8, "Visited Plys: " + base::with_thousands(result.counts.plys));
  const auto found = layout.counterexamples ? fdr_counterexample(checked) : std::nullopt;
  if (found) text += counterexample_lines(*found, layout);
  return text;
}

std::string fdr_text(const PrintedValue& printed, const FdrLayout& layout,
                     const base::SourceMap& sources) {
  if (layout.brief && printed.value) {
    return fmt::format("{}: {}\n", printed.print->text, *printed.value);
  }
  std::string text = fmt::format("{}:\n", printed.print->text);
  if (printed.value) text += indented(4, "Result: " + *printed.value);
  for (const std::string& error : fdr_errors(printed, sources)) text += indented(4, error);
  return text;
}

}  // namespace perentie::cli

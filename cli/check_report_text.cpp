// Text and Markdown.
#include <fmt/format.h>

#include "check_report.hpp"
#include "perentie/base/text.hpp"
#include "witness_text.hpp"

namespace perentie::cli {
namespace {

using semantics::Behaviour;
using semantics::CheckResult;
using semantics::Explanation;
using semantics::Witness;

// A word that a shell reads as it is.
std::string quoted(const std::string& word) {
  const bool is_plain = word.find_first_not_of(
                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                            "_-./+,:@%=") == std::string::npos &&
                        !word.empty();
  if (is_plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::vector<const Behaviour*> leaves_of(const Behaviour& whole) {
  std::vector<const Behaviour*> leaves;
  std::vector<const Behaviour*> stack{&whole};
  while (!stack.empty()) {
    const Behaviour* b = stack.back();
    stack.pop_back();
    if (b->components.empty()) leaves.push_back(b);
    for (auto it = b->components.rbegin(); it != b->components.rend(); ++it) stack.push_back(&*it);
  }
  return leaves;
}

// The events that a part of the system took part in.
std::vector<std::string> own_events_of(const Behaviour& part) {
  std::vector<std::string> events;
  for (const std::string& event : part.trace) {
    if (!event.empty()) events.push_back(event);
  }
  return events;
}

std::string step_word(const Explanation& explanation, std::size_t i) {
  const std::string& word = explanation.implementation.trace[i];
  const std::string hidden =
      i < explanation.revealed_trace.size() ? explanation.revealed_trace[i] : word;
  return hidden == word ? word : fmt::format("{} (hidden {})", word, hidden);
}

std::string steps_of(const Explanation& explanation) {
  const Behaviour& whole = explanation.implementation;
  if (whole.states.empty()) return {};
  std::string text = fmt::format("   step by step, from {}\n", whole.states[0].term);
  const std::vector<const Behaviour*> leaves = leaves_of(whole);
  std::size_t number = 0;
  for (std::size_t i = 0; i < whole.trace.size(); ++i) {
    if (whole.trace[i].empty()) continue;
    if (whole.kind == Behaviour::Kind::loop && i == whole.loop_start) {
      text += "     and from here again and again:\n";
    }
    text += fmt::format("     {}. {}\n", ++number, step_word(explanation, i));
    for (const Behaviour* leaf : leaves) {
      if (leaf->trace[i].empty()) continue;
      const std::string who = leaf == &whole ? "" : leaf->name + " is now ";
      text += fmt::format("        {}{}\n", who, leaf->states[i + 1].term);
    }
  }
  return text;
}

// Of nondeterminism: how the event is performed that may be refused.
std::string other_run_of(const Explanation& explanation) {
  if (!explanation.specification || explanation.specification->event.empty() ||
      explanation.specification->states.empty()) {
    return {};
  }
  const Behaviour& other = *explanation.specification;
  return fmt::format("   but after {} it may perform {}, in the state {}\n",
                     trace_of(own_events_of(other)), other.event, other.states.back().term);
}

std::string components_of(const Explanation& explanation, const base::SourceMap& sources) {
  const std::vector<const Behaviour*> leaves = leaves_of(explanation.implementation);
  if (leaves.size() < 2) return {};
  std::string text = "   components\n";
  for (const Behaviour* leaf : leaves) {
    text += fmt::format("     {} after {}", leaf->name, trace_of(own_events_of(*leaf)));
    if (!leaf->event.empty()) text += fmt::format(" performs {}", leaf->event);
    if (leaf->kind == Behaviour::Kind::acceptance) {
      text += fmt::format(" offers {}", set_of(leaf->acceptance));
    }
    if (leaf->definition) {
      const base::Position at = sources.position(leaf->definition->begin);
      text += fmt::format("  [{}:{}:{}]", at.path, at.line, at.column);
    }
    text += '\n';
  }
  for (const semantics::Blocked& blocked : explanation.blocked) {
    text += blocked.refusing.empty()
                ? fmt::format("     {} is offered by {}, outside its alphabet\n", blocked.event,
                              blocked.ready)
                : fmt::format("     {} is offered by {}, refused by {}\n", blocked.event,
                              blocked.ready, fmt::join(blocked.refusing, " and "));
  }
  return text;
}

std::string termination_note(const Witness& w) {
  return w.kind == Witness::Kind::deadlock && !w.trace.empty() && w.trace.back() == lts::tick_name
             ? "   note: it ends in ✓. FDR counts termination as a deadlock; to tell them apart, "
               "check\n   `P ; RUN({c})` with an event c that P does not use\n"
             : "";
}

// Text in a cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '\\' || c == '`' || c == '*' || c == '_' || c == '<' || c == '[') {
      escaped += '\\';
    }
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

}  // namespace

std::string replay_command(const CheckedAssertion& checked, const CheckReport& report) {
  return fmt::format("perentie check {} -a {} --explain", quoted(report.file), checked.number);
}

std::string print_as_text(const PrintedValue& printed) {
  return fmt::format("print {}: {}\n", printed.print->text, *printed.value);
}

std::string assertion_as_text(const CheckedAssertion& checked, const CheckReport& report) {
  const CheckResult& result = checked.result;
  std::string text =
      fmt::format("{}. {}: {}  (line {}; {} states, {} transitions, {:.2f} s)\n", checked.number,
                  checked.assertion->text, semantics::name_of(result.outcome),
                  report.sources.position(checked.assertion->span.begin).line,
                  base::with_thousands(result.counts.states),
                  base::with_thousands(result.counts.transitions), result.seconds);
  if (result.limit) text += fmt::format("   {}\n", base::describe(*result.limit));
  if (!result.witness) return text;
  const Witness& w = *result.witness;
  text += fmt::format("   after {}\n", trace_of(w.trace));
  for (const std::string& line : observations_of(w)) text += fmt::format("   {}\n", line);
  text += fmt::format("   {}\n", behaviour_of(w));
  if (const std::string allowed = expectation_of(w); !allowed.empty()) {
    text += fmt::format("   {}\n", allowed);
  }
  if (!w.state.empty()) text += fmt::format("   in the state {}\n", w.state);
  if (!report.explained) return text;
  if (checked.explanation) {
    text += steps_of(*checked.explanation);
    text += other_run_of(*checked.explanation);
    text += components_of(*checked.explanation, report.sources);
  } else {
    text += "   a budget ran out before the counterexample was found again by the step rules\n";
  }
  text += termination_note(w);
  text += fmt::format("   again: {}\n", replay_command(checked, report));
  return text;
}

std::string as_markdown(const CheckReport& report) {
  std::string text = fmt::format("## {}\n\n", cell(report.file));
  if (report.load_errors.has_errors()) {
    text += "The script could not be loaded.\n\n```\n";
    for (const base::Diagnostic& d : report.load_errors.all()) {
      text += base::render(d, report.sources);
    }
    return text + "```\n";
  }
  text += "| # | line | assertion | outcome | states | transitions |\n|---|---|---|---|---|---|\n";
  for (const CheckedAssertion& checked : report.assertions) {
    const CheckResult& result = checked.result;
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", checked.number,
                        report.sources.position(checked.assertion->span.begin).line,
                        cell(checked.assertion->text), semantics::name_of(result.outcome),
                        base::with_thousands(result.counts.states),
                        base::with_thousands(result.counts.transitions));
  }
  for (const CheckedAssertion& checked : report.assertions) {
    const bool is_worth_telling =
        checked.result.witness || checked.result.limit || checked.diagnostics.has_errors();
    if (!is_worth_telling) continue;
    text += fmt::format("\n<details><summary>Assertion {}</summary>\n\n```\n", checked.number);
    text += assertion_as_text(checked, report);
    for (const base::Diagnostic& d : checked.diagnostics.all()) {
      text += base::render(d, report.sources);
    }
    text += "```\n</details>\n";
  }
  return text;
}

}  // namespace perentie::cli

#include "replay.hpp"

#include <algorithm>
#include <set>

#include "perentie/base/diagnostic.hpp"
#include "perentie/semantics/compression.hpp"

namespace perentie::test {
namespace {

using semantics::ProcId;
using semantics::ScriptAssertion;
using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;
using States = std::set<ProcId>;
using Events = std::vector<std::string>;

const std::string tau(lts::tau_name);

// A process by the names of its events. As in our behaviours, it is the process itself and not what
// compressions make of it.
class Process {
 public:
  Process(semantics::Script& script, parser::ExprId expr, const ScriptAssertion& assertion)
      : terms_(uncompressed(script, expr, assertion, sink_)) {}

  States initial() const { return {terms_.initial()}; }

  States after_event(const States& states, const std::string& event) {
    States next;
    for (const ProcId state : states) {
      for (const auto& step : steps(state)) {
        if (name(step.label) == event) next.insert(step.target);
      }
    }
    return next;
  }

  States after(States states, const Events& trace) {
    for (const std::string& event : trace) states = after_event(states, event);
    return states;
  }

  // With everything that τ leads to.
  States closed(States states) {
    std::vector<ProcId> stack(states.begin(), states.end());
    while (!stack.empty()) {
      const States next = after_event({stack.back()}, tau);
      stack.pop_back();
      for (const ProcId state : next) {
        if (states.insert(state).second) stack.push_back(state);
      }
    }
    return states;
  }

  // The states that are possible after each prefix of a trace without τ.
  std::vector<States> after_prefixes(const Events& trace) {
    std::vector<States> found{closed(initial())};
    for (const std::string& event : trace) {
      found.push_back(closed(after_event(found.back(), event)));
    }
    return found;
  }

  Events offers(ProcId state) {
    std::set<std::string> names;
    for (const auto& step : steps(state)) names.insert(name(step.label));
    return {names.begin(), names.end()};
  }

  // A τ-closed set diverges if one of its states comes back to itself by τ.
  bool diverges(const States& closed_states) {
    return std::ranges::any_of(closed_states, [&](ProcId state) {
      return closed(after_event({state}, tau)).contains(state);
    });
  }

 private:
  static semantics::TermSystem uncompressed(semantics::Script& script, parser::ExprId expr,
                                            const ScriptAssertion& assertion,
                                            base::Diagnostics& sink) {
    const semantics::Preserved before = script.preserved();
    script.set_preserved(semantics::Preserved::identity);
    auto terms = script.terms(script.process(expr, assertion, sink).value(), sink);
    script.set_preserved(before);
    return terms;
  }

  std::vector<lts::Transition<ProcId>> steps(ProcId state) {
    std::vector<lts::Transition<ProcId>> steps;
    EXPECT_TRUE(terms_.successors(state, steps));
    return steps;
  }
  const std::string& name(lts::Label label) {
    if (!names_ || label.value >= names_->size()) names_ = terms_.label_names();
    return (*names_)[label.value];
  }

  base::Diagnostics sink_;
  semantics::TermSystem terms_;
  std::shared_ptr<const lts::LabelNames> names_;
};

bool contains(const Events& events, const std::string& event) {
  return std::ranges::find(events, event) != events.end();
}

struct Parts {
  Events trace;  // without gaps, with τ
  Events visible;
  std::string type;
  std::string event;
  Events acceptance;  // sorted
  std::size_t loop_start = 0;
};

Parts parts_of(const Json& behaviour, const Json& document) {
  Parts parts;
  parts.type = behaviour.at("type");
  const Events trace = names_of(behaviour.at("trace"), document);
  parts.loop_start = behaviour.value("loop_start", std::size_t{0});
  for (std::size_t i = 0; i < trace.size(); ++i) {
    if (trace[i].empty()) {
      if (parts.type == "loop" && i < behaviour["loop_start"]) --parts.loop_start;
      continue;
    }
    parts.trace.push_back(trace[i]);
    if (trace[i] != tau) parts.visible.push_back(trace[i]);
  }
  if (behaviour.contains("error_event")) {
    parts.event = names_of(Json::array({behaviour["error_event"]}), document)[0];
  }
  parts.acceptance = names_of(behaviour.value("acceptance", Json::array()), document);
  std::ranges::sort(parts.acceptance);
  return parts;
}

// The process has the trace, τ where it stands, and then does what the behaviour says.
AssertionResult can_do(Process& process, const Parts& parts) {
  if (parts.type == "loop") {
    const auto loop = parts.trace.begin() + static_cast<std::ptrdiff_t>(parts.loop_start);
    const States states = process.after(process.initial(), {parts.trace.begin(), loop});
    const Events round(loop, parts.trace.end());
    if (round.empty()) return AssertionFailure() << "the loop is empty";
    const bool returns = std::ranges::any_of(
        states, [&](ProcId state) { return process.after({state}, round).contains(state); });
    return returns ? AssertionSuccess() : AssertionFailure() << "the loop does not come back";
  }
  const States states = process.after(process.initial(), parts.trace);
  if (states.empty()) return AssertionFailure() << "the trace is impossible";
  const bool done = std::ranges::any_of(states, [&](ProcId state) {
    const Events offered = process.offers(state);
    if (parts.type == "min_acceptance") return offered == parts.acceptance;
    return parts.event.empty() || contains(offered, parts.event);
  });
  return done ? AssertionSuccess() : AssertionFailure() << "it does not end as it says";
}

// No stable state offers nothing, or some event of the acceptance without others beyond it.
AssertionResult lacks_revival(Process& process, const States& states, const Events& acceptance) {
  std::set<std::string> revived;
  bool offers_nothing = false;
  for (const ProcId state : states) {
    const Events offered = process.offers(state);
    if (contains(offered, tau) || !std::ranges::includes(acceptance, offered)) continue;
    offers_nothing = offers_nothing || offered.empty();
    revived.insert(offered.begin(), offered.end());
  }
  const bool has_all = acceptance.empty() ? offers_nothing : revived.size() == acceptance.size();
  return has_all ? AssertionFailure() << "it has all the revivals" : AssertionSuccess();
}

// The specification lacks a behaviour in the model of the refinement.
AssertionResult cannot_do(Process& process, const Parts& parts, parser::Model model) {
  const std::vector<States> prefixes = process.after_prefixes(parts.visible);
  const bool is_strict =
      model == parser::Model::failures_divergences || model == parser::Model::revivals_divergences;
  if (is_strict) {
    for (const States& states : prefixes) {
      if (process.diverges(states)) return AssertionFailure() << "the specification diverges";
    }
  }
  if (parts.type == "loop") return AssertionSuccess();
  // What was refused on the way is not in FDR's documents.
  const bool tests_refusals = model == parser::Model::refusal_testing ||
                              model == parser::Model::refusal_testing_divergences;
  if (tests_refusals) return AssertionSuccess();
  const bool tells_revivals =
      model == parser::Model::revivals || model == parser::Model::revivals_divergences;
  if (tells_revivals && parts.type == "min_acceptance") {
    return lacks_revival(process, prefixes.back(), parts.acceptance);
  }
  for (const ProcId state : prefixes.back()) {
    const Events offered = process.offers(state);
    if (parts.type == "trace") {
      if (contains(offered, parts.event)) return AssertionFailure() << "it performs the event";
    } else if (!contains(offered, tau) && std::ranges::includes(parts.acceptance, offered)) {
      return AssertionFailure() << "it refuses as much";
    }
  }
  return AssertionSuccess();
}

AssertionResult refutes(semantics::Script& script, const ScriptAssertion& assertion,
                        const parser::RefinementAssertion& claim, const Parts& own,
                        const Json& counterexample, const Json& document) {
  Process specification(script, claim.specification, assertion);
  const Parts other = parts_of(counterexample.at("specification_behaviour"), document);
  if (other.visible != own.visible) return AssertionFailure() << "the traces differ";
  return cannot_do(specification, own, claim.model);
}

AssertionResult refutes(semantics::Script& script, const ScriptAssertion& assertion,
                        const parser::PropertyAssertion& claim, const Parts& own,
                        const Json& counterexample, const Json& document) {
  switch (claim.property) {
    case parser::Property::deadlock_free:
      return own.type == "loop" || own.acceptance.empty()
                 ? AssertionSuccess()
                 : AssertionFailure() << "it is not deadlocked";
    case parser::Property::divergence_free:
      return own.type == "loop" ? AssertionSuccess() : AssertionFailure() << "there is no loop";
    case parser::Property::deterministic:
      break;
  }
  if (own.type == "loop") return AssertionSuccess();
  Process process(script, claim.process, assertion);
  const Parts other = parts_of(counterexample.at("specification_behaviour"), document);
  if (other.visible != own.visible) return AssertionFailure() << "the traces differ";
  if (contains(own.acceptance, other.event)) return AssertionFailure() << "it is not refused";
  return can_do(process, other);
}

AssertionResult refutes(semantics::Script& script, const ScriptAssertion& assertion,
                        const parser::HasTraceAssertion& claim, const Parts& own,
                        const Json& counterexample, const Json& document) {
  if (own.type == "loop") return AssertionSuccess();
  base::Diagnostics sink;
  Events trace;
  for (const parser::ExprId event : script.tree().list(claim.trace)) {
    trace.push_back(script.evaluate(event, sink).value());
  }
  Events tried = own.visible;
  tried.push_back(parts_of(counterexample.at("specification_behaviour"), document).event);
  if (tried.size() > trace.size() || !std::equal(tried.begin(), tried.end(), trace.begin())) {
    return AssertionFailure() << "it is another trace";
  }
  if (own.type == "min_acceptance") {
    return contains(own.acceptance, tried.back()) ? AssertionFailure() << "it is not refused"
                                                  : AssertionSuccess();
  }
  Process process(script, claim.process, assertion);
  return process.after_prefixes(tried).back().empty() ? AssertionSuccess()
                                                      : AssertionFailure() << "it has the trace";
}

}  // namespace

AssertionResult replays(semantics::Script& script, const ScriptAssertion& assertion,
                        const Json& result, const Json& document) {
  for (const Json& counterexample : result.at("counterexamples")) {
    const Parts own = parts_of(counterexample.at("implementation_behaviour"), document);
    const auto both = std::visit(
        [&](const auto& claim) -> AssertionResult {
          parser::ExprId implementation;
          if constexpr (requires { claim.implementation; }) {
            implementation = claim.implementation;
          } else {
            implementation = claim.process;
          }
          Process process(script, implementation, assertion);
          const auto possible = can_do(process, own);
          if (!possible) return AssertionResult(possible) << " of the implementation";
          return refutes(script, assertion, claim, own, counterexample, document);
        },
        assertion.assertion.claim);
    if (!both) return AssertionResult(both) << ": " << counterexample;
  }
  return AssertionSuccess();
}

}  // namespace perentie::test

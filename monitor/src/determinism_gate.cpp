#include "perentie/monitor/determinism_gate.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <variant>

#include <fmt/format.h>

#include "perentie/base/overload.hpp"
#include "perentie/lts/determinism.hpp"
#include "perentie/lts/hide.hpp"
#include "perentie/monitor/visible_channels.hpp"

namespace perentie::monitor {
namespace {

std::vector<std::string> difference(const std::set<std::string>& a,
                                    const std::set<std::string>& b) {
  std::vector<std::string> result;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

}  // namespace

DeterminismGate check_determinism_gate(const lts::Lts& process,
                                       std::span<const std::string> alphabet,
                                       std::span<const std::string> common_alphabet,
                                       const base::Limits& limits) {
  const std::set<std::string> model(alphabet.begin(), alphabet.end());
  const std::set<std::string> shown(common_alphabet.begin(), common_alphabet.end());
  DeterminismGate gate;
  gate.hidden = difference(model, shown);
  gate.extra = difference(shown, model);
  if (gate.hidden.empty() || !gate.extra.empty()) {
    gate.outcome = gate.hidden.empty() ? DeterminismGate::Outcome::not_needed
                                       : DeterminismGate::Outcome::incomparable;
    return gate;
  }
  const lts::Lts visible =
      lts::hide(process, labels_of_channels(process.label_names(), gate.hidden));
  const lts::DeterminismVerdict verdict =
      lts::check_determinism(visible, lts::DeterminismModel::failures_divergences, limits);
  std::visit(base::overload{[&](const lts::Deterministic&) {
                              gate.outcome = DeterminismGate::Outcome::deterministic;
                            },
                            [&](const lts::Nondeterminism& witness) {
                              gate.outcome = DeterminismGate::Outcome::nondeterministic;
                              for (const lts::Label label : witness.trace) {
                                gate.trace.emplace_back(visible.name(label));
                              }
                              if (witness.event)
                                gate.event = std::string(visible.name(*witness.event));
                            },
                            [&](const base::LimitReached& limit) {
                              gate.outcome = DeterminismGate::Outcome::inconclusive;
                              gate.limit = limit;
                            }},
             verdict);
  return gate;
}

std::string explain(const DeterminismGate& gate) {
  const std::string hidden = fmt::format("{{|{}|}}", fmt::join(gate.hidden, ", "));
  switch (gate.outcome) {
    case DeterminismGate::Outcome::not_needed:
      return "the system shows every channel of the model's alphabet, so nothing is hidden";
    case DeterminismGate::Outcome::deterministic:
      return fmt::format("the model is deterministic with {} hidden", hidden);
    case DeterminismGate::Outcome::nondeterministic:
      return fmt::format("with {} hidden the model is nondeterministic: after <{}> it {}", hidden,
                         fmt::join(gate.trace, ", "),
                         gate.event ? fmt::format("may perform `{}` and may refuse it", *gate.event)
                                    : "may perform hidden events for ever");
    case DeterminismGate::Outcome::incomparable:
      return fmt::format(
          "the alphabets cannot be compared: only the model has {}, only the system has {{|{}|}}",
          hidden, fmt::join(gate.extra, ", "));
    case DeterminismGate::Outcome::inconclusive:
      return fmt::format("with {} hidden it is not known whether the model is deterministic: {}",
                         hidden, base::describe(*gate.limit));
  }
  return {};
}

}  // namespace perentie::monitor

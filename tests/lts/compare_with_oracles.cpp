#include "compare_with_oracles.hpp"

#include <algorithm>

#include "perentie/lts/divergence.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/lts/trace.hpp"
#include "perentie/test/lts_oracles.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::test {

namespace {

using lts::Edge;
using lts::Label;
using lts::Lts;
using lts::State;

std::string wrong_in_node(const Lts& lts, const lts::NormalLts& normal, State node,
                          StateSet expected) {
  StateSet members = 0;
  for (const State s : normal.members[node.value]) members |= StateSet{1} << s.value;
  if (members != expected) return "members";
  if (!std::ranges::is_sorted(normal.members[node.value])) return "order of members";

  bool divergent = false;
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    divergent = divergent || (contains(expected, s) && diverges(lts, s));
  }
  if (normal.divergent[node.value] != divergent) return "divergence";

  std::set<LabelSet> acceptances;
  for (const lts::AcceptanceId id : normal.acceptances->of(node)) {
    const auto labels = normal.acceptances->labels(id);
    acceptances.insert(LabelSet(labels.begin(), labels.end()));
  }
  if (acceptances.size() != normal.acceptances->of(node).size()) return "repeated acceptances";
  if (acceptances != minimal_acceptances(lts, expected)) return "acceptances";
  return {};
}

/// The node after a trace; nothing if the normal form does not have the trace.
std::optional<State> node_after(const lts::NormalLts& normal, const Word& trace) {
  State node = normal.lts.initial();
  for (const Label label : trace) {
    const auto edges = normal.lts.edges(node, label);
    if (edges.empty()) return std::nullopt;
    node = edges.front().target;
  }
  return node;
}

std::string wrong_in_path(const Lts& lts, const lts::Path& path, const Word& trace) {
  State at = lts.initial();
  for (const Edge& edge : path) {
    const auto edges = lts.edges(at);
    if (std::find(edges.begin(), edges.end(), edge) == edges.end()) return "a path takes no edge";
    at = edge.target;
  }
  return lts::trace_of(path) == trace ? "" : "a path shows another trace";
}

std::string wrong_in_witness(const Lts& lts, const lts::Nondeterminism& found) {
  if (std::string wrong = wrong_in_path(lts, found.refusing, found.trace); !wrong.empty()) {
    return wrong;
  }
  const std::uint32_t refusing = lts::end_of(lts, found.refusing).value;
  if (!found.event) return diverges(lts, refusing) ? "" : "the end does not diverge";
  Word extended = found.trace;
  extended.push_back(*found.event);
  if (!is_stable(lts, refusing)) return "an unstable state refuses nothing";
  if (initials(lts, refusing).contains(*found.event)) return "the event is not refused";
  return wrong_in_path(lts, found.performing, extended);
}

}  // namespace

std::string wrong_in_normal_form(const Lts& lts, std::size_t depth) {
  const lts::Normalisation result = lts::normalise(lts, {.limits = {}, .acceptances = true});
  const lts::NormalLts& normal = result.normal;
  if (!result.complete() || result.limit) return "not complete";
  for (std::uint32_t n = 0; n < normal.lts.state_count(); ++n) {
    const auto edges = normal.lts.edges(State{n});
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (edges[i].label == lts::tau) return "a τ is left";
      if (i > 0 && edges[i - 1].label == edges[i].label) return "not deterministic";
    }
  }
  std::size_t count = 0;
  for (const auto& [trace, states] : traces_and_states(lts, depth)) {
    const auto node = node_after(normal, trace);
    if (!node) return "a trace is lost: <" + to_text(lts, trace) + ">";
    if (std::string wrong = wrong_in_node(lts, normal, *node, states); !wrong.empty()) {
      return wrong + " after <" + to_text(lts, trace) + ">";
    }
    ++count;
  }
  return count == traces(normal.lts, depth).size() ? "" : "a trace is invented";
}

std::string wrong_in_determinism(const Lts& lts, lts::DeterminismModel model, std::size_t depth) {
  const bool with_divergence = model == lts::DeterminismModel::failures_divergences;
  const auto expected = first_nondeterminism(lts, with_divergence, depth);
  const lts::DeterminismVerdict verdict = lts::check_determinism(lts, model);
  if (std::holds_alternative<lts::Deterministic>(verdict)) {
    return expected ? "nondeterminism overlooked" : "";
  }
  const auto& found = std::get<lts::Nondeterminism>(verdict);
  if (!expected) {
    if (found.trace.size() <= depth) return "nondeterminism invented";
    return wrong_in_witness(lts, found);
  }
  if (found.trace != expected->trace) return "not the least trace";
  if (found.event != expected->event) return "not the least event";
  return wrong_in_witness(lts, found);
}

std::string wrong_in_divergence(const Lts& lts) {
  const std::vector<bool> divergent = lts::divergent_states(lts);
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (divergent[s] != diverges(lts, s)) return "state " + std::to_string(s);
  }
  return {};
}

}  // namespace perentie::test

#include <algorithm>
#include <map>
#include <utility>

#include "perentie/base/check.hpp"
#include "perentie/lts/compressions.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/lts/weak_bisimulation.hpp"

namespace perentie::lts {

namespace {

/// Merges the nodes that have the same acceptances, divergence and successors. Nodes say the same
/// iff their minimal acceptances are the same sets, and each set has one number.
GeneralisedLts reduce(NormalLts normal) {
  const Acceptances& acceptances = *normal.acceptances;
  const auto nodes = static_cast<std::uint32_t>(normal.lts.state_count());
  std::map<std::pair<bool, std::vector<AcceptanceId>>, std::uint32_t> numbers;
  std::vector<std::uint32_t> classes(nodes);
  for (std::uint32_t n = 0; n < nodes; ++n) {
    const auto of_node = acceptances.of(State{n});
    const auto next = static_cast<std::uint32_t>(numbers.size());
    const std::vector<AcceptanceId> ids(of_node.begin(), of_node.end());
    classes[n] = numbers.try_emplace({normal.divergent[n], ids}, next).first->second;
  }
  Quotient quotient = strong_bisimulation(normal.lts, classes);

  std::vector<State> member(quotient.lts.state_count());
  for (std::uint32_t n = 0; n < nodes; ++n) member[quotient.block_of[n].value] = State{n};
  std::vector<bool> divergent;
  for (const State node : member) divergent.push_back(normal.divergent[node.value]);
  return {std::move(quotient.lts), std::move(divergent),
          std::move(*normal.acceptances).of_states(member)};
}

}  // namespace

GeneralisedResult normal(const Lts& lts, const base::Limits& limits) {
  const QuotientResult quotient = delay_bisimulation(lts, limits);
  if (const auto* limit = std::get_if<base::LimitReached>(&quotient)) return *limit;
  const Lts& small = std::get<Quotient>(quotient).lts;
  Normalisation result = normalise(small, {.limits = limits, .acceptances = true});
  if (result.limit) return *result.limit;
  PERENTIE_CHECK(result.complete(), "a normal form without a limit is not complete");
  return reduce(std::move(result.normal));
}

}  // namespace perentie::lts

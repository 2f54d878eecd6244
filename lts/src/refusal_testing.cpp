#include "perentie/lts/refusal_testing.hpp"

#include <algorithm>
#include <memory>
#include <string>

namespace perentie::lts {
namespace {

using ObservationId = base::Id<struct ObservationTag>;
using Offers = UniqueRuns<ObservationId, Label>;

// Adds the copies of stable states; `observe(offer, add)` calls `add` with each observation.
template <class Observe>
ObservedLts observed(const Lts& lts, const std::shared_ptr<const LabelNames>& names,
                     Observe observe) {
  LtsBuilder builder(names);
  std::vector<State> origins;
  builder.add_states(static_cast<std::uint32_t>(lts.state_count()));
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    origins.push_back(State{s});
    for (const Edge& edge : lts.edges(State{s})) {
      builder.add_edge(State{s}, edge.label, edge.target);
    }
  }
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    const State state{s};
    if (!lts.is_stable(state)) continue;
    const State copy = builder.add_state();
    origins.push_back(state);
    for (const Edge& edge : lts.edges(state)) builder.add_edge(copy, edge.label, edge.target);
    observe(labels_on(lts.edges(state)),
            [&](Label label) { builder.add_edge(state, label, copy); });
  }
  return {std::move(builder).finish(lts.initial()), std::move(origins)};
}

}  // namespace

RefusalTest test_refusals(const Lts& specification, const Lts& implementation) {
  Offers offers;
  for (std::uint32_t s = 0; s < implementation.state_count(); ++s) {
    if (implementation.is_stable(State{s})) offers.add(labels_on(implementation.edges(State{s})));
  }
  const bool longer = implementation.label_names().size() >= specification.label_names().size();
  LabelNames names = longer ? implementation.label_names() : specification.label_names();
  const Label first{static_cast<std::uint32_t>(names.size())};
  for (std::uint32_t i = 0; i < offers.size(); ++i) names.push_back("?" + std::to_string(i));
  const auto shared = std::make_shared<const LabelNames>(std::move(names));

  ObservedLts own = observed(implementation, shared, [&](const auto& offer, auto add) {
    add(Label{first.value + offers.add(offer).value});
  });
  ObservedLts other = observed(specification, shared, [&](const auto& offer, auto add) {
    for (std::uint32_t i = 0; i < offers.size(); ++i) {
      if (std::ranges::includes(offers[ObservationId{i}], offer)) add(Label{first.value + i});
    }
  });
  return {std::move(other), std::move(own), first, std::move(offers).take()};
}

}  // namespace perentie::lts

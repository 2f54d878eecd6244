#include "bisimulation_oracle.hpp"

#include <map>
#include <set>
#include <utility>

#include "perentie/test/lts_oracles.hpp"

namespace perentie::test {

namespace {

using lts::Label;
using lts::Lts;
using Signature = std::set<std::pair<Label, std::uint32_t>>;

StateSet matching_steps(const Lts& lts, std::uint32_t state, Label label, Bisimilarity kind) {
  const StateSet here = StateSet{1} << state;
  if (kind == Bisimilarity::strong) return step(lts, here, label);
  const StateSet before = tau_closure(lts, here);
  if (label == lts::tau) return before;
  const StateSet after = step(lts, before, label);
  return kind == Bisimilarity::delay ? after : tau_closure(lts, after);
}

}  // namespace

std::vector<std::uint32_t> bisimilarity_classes(const Lts& lts, Bisimilarity kind,
                                                std::vector<std::uint32_t> classes) {
  const std::size_t states = lts.state_count();
  classes.resize(states, 0);
  const auto split = [&](const auto& signature_of) {
    std::map<std::pair<std::uint32_t, Signature>, std::uint32_t> numbers;
    std::vector<std::uint32_t> finer(states);
    for (std::uint32_t s = 0; s < states; ++s) {
      const auto next = static_cast<std::uint32_t>(numbers.size());
      finer[s] = numbers.try_emplace({classes[s], signature_of(s)}, next).first->second;
    }
    classes = std::move(finer);
    return numbers.size();
  };
  const auto divergence = [&](std::uint32_t s) {
    return kind != Bisimilarity::strong && diverges(lts, s) ? Signature{{lts::tau, 0}}
                                                            : Signature{};
  };
  const auto steps = [&](std::uint32_t s) {
    Signature signature;
    for (std::uint32_t l = 0; l < lts.label_names().size(); ++l) {
      const StateSet targets = matching_steps(lts, s, Label{l}, kind);
      for (std::uint32_t t = 0; t < states; ++t) {
        if (contains(targets, t)) signature.insert({Label{l}, classes[t]});
      }
    }
    return signature;
  };
  for (std::size_t count = split(divergence), before = 0; count != before;) {
    before = count;
    count = split(steps);
  }
  return classes;
}

Lts side_by_side(const Lts& a, const Lts& b) {
  lts::LtsBuilder builder(a.shared_label_names());
  for (const Lts* lts : {&a, &b}) {
    const std::uint32_t first = builder.state_count();
    builder.add_states(static_cast<std::uint32_t>(lts->state_count()));
    for (std::uint32_t s = 0; s < lts->state_count(); ++s) {
      for (const lts::Edge& edge : lts->edges(lts::State{s})) {
        builder.add_edge(lts::State{first + s}, edge.label, lts::State{first + edge.target.value});
      }
    }
  }
  return std::move(builder).finish(a.initial());
}

bool are_bisimilar(const Lts& a, const Lts& b, Bisimilarity kind) {
  const auto classes = bisimilarity_classes(side_by_side(a, b), kind);
  return classes[a.initial().value] == classes[a.state_count() + b.initial().value];
}

}  // namespace perentie::test

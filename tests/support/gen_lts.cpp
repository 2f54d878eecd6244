#include "perentie/test/gen_lts.hpp"

#include <memory>
#include <tuple>
#include <utility>

namespace perentie::test {

namespace {

using RawEdge = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // source, label, target
using RawLts = std::pair<std::uint32_t, std::vector<RawEdge>>;            // last state, edges

std::vector<lts::Label> weighted_labels(const LtsShape& shape) {
  std::vector<lts::Label> labels;
  for (std::uint32_t i = 0; i < shape.events.size(); ++i) labels.push_back(lts::Label{i + 2});
  labels.insert(labels.end(), shape.tick_weight, lts::tick);
  labels.insert(labels.end(), shape.tau_weight, lts::tau);
  return labels;
}

lts::Lts build(const LtsShape& shape, const std::vector<lts::Label>& labels, const RawLts& raw) {
  lts::LabelNames names{std::string(lts::tau_name), std::string(lts::tick_name)};
  names.insert(names.end(), shape.events.begin(), shape.events.end());
  lts::LtsBuilder builder(std::make_shared<const lts::LabelNames>(std::move(names)));
  const std::uint32_t states = raw.first + 1;
  builder.add_states(states);
  for (const auto& [source, label, target] : raw.second) {
    builder.add_edge(lts::State{source % states}, labels[label], lts::State{target % states});
  }
  return std::move(builder).finish(lts::State{0});
}

}  // namespace

rc::Gen<lts::Lts> arbitrary_lts(LtsShape shape) {
  // Without `resize` small sizes would draw only small numbers: state 0 and the first label.
  const auto below = [](std::uint32_t end) {
    return rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::uint32_t>(0, end));
  };
  const std::vector<lts::Label> labels = weighted_labels(shape);
  const auto state = below(shape.max_states);
  const auto label = below(static_cast<std::uint32_t>(labels.size()));
  const auto edges = rc::gen::mapcat(below(2 * shape.max_states + 1), [=](std::uint32_t count) {
    return rc::gen::container<std::vector<RawEdge>>(count, rc::gen::tuple(state, label, state));
  });
  const auto last_state = below(shape.max_states);
  return rc::gen::map(rc::gen::pair(last_state, edges),
                      [shape = std::move(shape), labels](const RawLts& drawn) {
                        return build(shape, labels, drawn);
                      });
}

}  // namespace perentie::test

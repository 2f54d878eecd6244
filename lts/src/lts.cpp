#include "perentie/lts/lts.hpp"

#include <algorithm>

#include "perentie/base/check.hpp"

namespace perentie::lts {

std::span<const Edge> Lts::edges(State state, Label label) const {
  const std::span<const Edge> all = edges(state);
  const auto by_label = [](const Edge& a, const Edge& b) { return a.label < b.label; };
  const auto [first, last] = std::equal_range(all.begin(), all.end(), Edge{label, State{0}}, by_label);
  return {first, last};
}

std::optional<Label> Lts::find_label(std::string_view name) const {
  const auto found = std::find(label_names_->begin(), label_names_->end(), name);
  if (found == label_names_->end()) return std::nullopt;
  return Label{static_cast<std::uint32_t>(found - label_names_->begin())};
}

std::vector<Label> Lts::alphabet() const {
  std::vector<bool> occurs(label_names_->size(), false);
  for (const Edge& edge : edges_) occurs[edge.label.value] = true;
  std::vector<Label> labels;
  for (std::uint32_t i = tick.value + 1; i < occurs.size(); ++i) {
    if (occurs[i]) labels.push_back(Label{i});
  }
  return labels;
}

void LtsBuilder::add_edge(State source, Label label, State target) {
  edges_.push_back({source, {label, target}});
}

Lts LtsBuilder::finish(State initial) && {
  PERENTIE_CHECK(initial.value < state_count_, "the initial state is not a state");
  Lts lts;
  lts.initial_ = initial;
  lts.label_names_ = std::move(label_names_);

  // Counting sort by source, then each row on its own.
  std::vector<std::uint64_t> ends(state_count_ + 1, 0);
  for (const SourcedEdge& e : edges_) {
    PERENTIE_CHECK(e.source.value < state_count_ && e.edge.target.value < state_count_,
                   "an edge names a state that does not exist");
    ++ends[e.source.value + 1];
  }
  for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
  std::vector<Edge> sorted(edges_.size());
  std::vector<std::uint64_t> next(ends.begin(), ends.end() - 1);
  for (const SourcedEdge& e : edges_) sorted[next[e.source.value]++] = e.edge;
  edges_.clear();
  edges_.shrink_to_fit();

  lts.rows_.reserve(state_count_ + 1);
  lts.rows_.push_back(0);
  auto write = sorted.begin();
  for (std::uint32_t s = 0; s < state_count_; ++s) {
    const auto first = sorted.begin() + static_cast<std::ptrdiff_t>(ends[s]);
    const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(ends[s + 1]);
    std::sort(first, last);
    write = std::copy(first, std::unique(first, last), write);
    lts.rows_.push_back(static_cast<std::uint64_t>(write - sorted.begin()));
  }
  sorted.erase(write, sorted.end());
  lts.edges_ = std::move(sorted);
  return lts;
}

}  // namespace perentie::lts

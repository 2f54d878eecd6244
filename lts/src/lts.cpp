#include "perentie/lts/lts.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "perentie/base/check.hpp"
#include "perentie/lts/memory.hpp"

namespace perentie::lts {

namespace {

/// Sorts a row and moves its duplicates behind the returned end.
Edge* sort_row(Edge* first, Edge* last) {
  if (!std::is_sorted(first, last)) std::sort(first, last);
  return std::unique(first, last);
}

}  // namespace

std::vector<Label> labels_on(std::span<const Edge> edges) {
  std::vector<Label> labels;
  for (const Edge& edge : edges) {
    if (labels.empty() || labels.back() != edge.label) labels.push_back(edge.label);
  }
  return labels;
}

bool has_tau(const Lts& lts) {
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (!lts.is_stable(State{s})) return true;
  }
  return false;
}

Lts::Lts(base::GrowingArray<std::uint64_t> rows, base::GrowingArray<Edge> edges, State initial,
         std::shared_ptr<const LabelNames> label_names)
    : rows_(std::move(rows)),
      edges_(std::move(edges)),
      initial_(initial),
      label_names_(std::move(label_names)) {
  PERENTIE_CHECK(label_names_->size() >= 2 && name(tau) == tau_name && name(tick) == tick_name,
                 "the label names do not begin with τ and ✓");
  PERENTIE_CHECK(initial_.value < state_count(), "the initial state is not a state");
  for (const Edge& edge : edges_) {
    PERENTIE_CHECK(edge.target.value < state_count(),
                   "an edge leads to a state that does not exist");
    PERENTIE_CHECK(edge.label.value < label_names_->size(), "an edge has a label without a name");
  }
}

std::span<const Edge> Lts::edges(State state, Label label) const {
  const std::span<const Edge> all = edges(state);
  const auto by_label = [](const Edge& a, const Edge& b) { return a.label < b.label; };
  const auto [first, last] =
      std::equal_range(all.begin(), all.end(), Edge{label, State{0}}, by_label);
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
  // Counting sort by source, then each row on its own.
  base::GrowingArray<std::uint64_t> ends;
  ends.resize(state_count_ + std::size_t{1});
  for (const SourcedEdge& e : edges_) {
    PERENTIE_CHECK(e.source.value < state_count_, "an edge leaves a state that does not exist");
    ++ends[e.source.value + std::size_t{1}];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  base::GrowingArray<Edge> sorted;
  sorted.resize(edges_.size());
  std::vector<std::uint64_t> next(ends.begin(), ends.end() - 1);
  for (const SourcedEdge& e : edges_) sorted[next[e.source.value]++] = e.edge;
  edges_.clear();
  edges_.shrink_to_fit();

  Edge* write = sorted.begin();
  Edge* first = sorted.begin();
  for (std::uint32_t s = 0; s < state_count_; ++s) {
    Edge* const last = sorted.begin() + ends[s + std::size_t{1}];
    write = std::move(first, sort_row(first, last), write);
    first = last;
    ends[s + std::size_t{1}] = static_cast<std::uint64_t>(write - sorted.begin());
  }
  sorted.resize(static_cast<std::size_t>(write - sorted.begin()));
  return Lts(std::move(ends), std::move(sorted), initial, std::move(label_names_));
}

void LtsRowBuilder::end_row() {
  Edge* const end = sort_row(edges_.begin() + rows_.back(), edges_.end());
  edges_.resize(static_cast<std::size_t>(end - edges_.begin()));
  rows_.push_back(edges_.size());
}

void LtsRowBuilder::add_row(std::span<const Edge> edges) {
  edges_.append(edges);
  end_row();
}

std::uint64_t LtsRowBuilder::peak_bytes(std::size_t edges) const {
  return lts::peak_bytes(rows_, 1) + lts::peak_bytes(edges_, edges);
}

Lts LtsRowBuilder::finish(State initial, std::size_t state_count,
                          std::shared_ptr<const LabelNames> names) && {
  PERENTIE_CHECK(row_count() <= state_count, "a row belongs to a state that does not exist");
  drop_row();
  rows_.resize(state_count + 1, rows_.back());
  return Lts(std::move(rows_), std::move(edges_), initial, std::move(names));
}

}  // namespace perentie::lts

#include "subsets.hpp"

#include <algorithm>

namespace perentie::lts {

Subsets::Subsets(const Lts& lts, const base::Limits& limits)
    : lts_(lts),
      watch_(limits),
      max_nodes_(std::clamp<std::uint64_t>(limits.max_states.value_or(State::none_value), 1,
                                           State::none_value)),
      closure_(lts) {
  set_.push_back(lts.initial());
  close();
  nodes_.add(set_);
}

/// Adds to the set in hand what τ leads to from it, and sorts it.
void Subsets::close() {
  closure_.close(set_);
  std::ranges::sort(set_);
}

std::span<const Edge> Subsets::visible_edges(State node) {
  gathered_.clear();
  const std::span<const State> states = members(node);
  for (const State state : states) {
    for (const Edge& edge : lts_.edges(state)) {
      if (edge.label != tau) gathered_.push_back(edge);
    }
  }
  if (states.size() > 1) {
    std::ranges::sort(gathered_);
    gathered_.erase(std::unique(gathered_.begin(), gathered_.end()), gathered_.end());
  }
  return gathered_;
}

std::optional<base::LimitReached> Subsets::successors(std::span<const Edge> visible_edges,
                                                      std::uint64_t other_bytes,
                                                      std::vector<Edge>& out) {
  const base::Budget& budget = watch_.budget();
  for (auto edge = visible_edges.begin(); edge != visible_edges.end();) {
    if (watch_.due()) {
      if (const auto limit = watch_.look()) return limit;
    }
    const Label label = edge->label;
    set_.clear();
    bool closed = true;
    for (; edge != visible_edges.end() && edge->label == label; ++edge) {
      set_.push_back(edge->target);
      closed = closed && lts_.is_stable(edge->target);
    }
    if (!closed) close();

    if (const auto limit = budget.check_memory(nodes_.peak_bytes(set_.size()) + other_bytes)) {
      return limit;
    }
    const State node = nodes_.add(set_, max_nodes_);
    if (node.is_none()) return base::LimitReached{base::LimitKind::states, max_nodes_};
    out.push_back({label, node});
  }
  return std::nullopt;
}

}  // namespace perentie::lts

#include <algorithm>

#include "discovery.hpp"
#include "perentie/lts/compressions.hpp"
#include "perentie/lts/divergence.hpp"
#include "perentie/lts/memory.hpp"
#include "perentie/lts/watch.hpp"

namespace perentie::lts {

namespace {

/// What τ leads to, in a graph whose τ edges have no cycles but loops.
class TauReach {
 public:
  explicit TauReach(const Lts& lts) : lts_(lts), put_in_(lts.state_count(), 0) {}

  /// `from` and all that τ leads to from it. Valid until the next call.
  std::span<const State> closure(State from) {
    begin();
    put(from);
    grow();
    return found_;
  }
  /// Removes from `targets` those that τ leads to from another of them.
  void keep_first(std::vector<State>& targets) {
    if (targets.size() < 2) return;
    begin();
    for (const State target : targets) {
      for (const Edge& edge : lts_.edges(target, tau)) {
        if (edge.target != target) put(edge.target);
      }
    }
    grow();
    std::erase_if(targets, [&](State target) { return put_in_[target.value] == run_; });
  }

 private:
  void begin() {
    found_.clear();
    if (++run_ == 0) {  // after 2^32 runs the numbers begin again
      std::ranges::fill(put_in_, 0);
      run_ = 1;
    }
  }
  void put(State state) {
    if (put_in_[state.value] == run_) return;
    put_in_[state.value] = run_;
    found_.push_back(state);
  }
  void grow() {
    for (std::size_t i = 0; i < found_.size(); ++i) {
      for (const Edge& edge : lts_.edges(found_[i], tau)) put(edge.target);
    }
  }

  const Lts& lts_;
  std::vector<State> found_;
  std::vector<std::uint32_t> put_in_;  // by state: the last run that found it
  std::uint32_t run_ = 0;
};

}  // namespace

GeneralisedResult diamond(const Lts& original, const base::Limits& limits) {
  const Quotient factored = tau_loop_factor(original);
  const Lts& lts = factored.lts;
  const std::vector<bool> diverges = divergent_states(lts);
  Watch watch(limits);
  TauReach reach(lts);
  AcceptanceBuilder acceptances(lts);
  LtsRowBuilder rows;
  std::vector<bool> divergent;
  Discovery kept(lts.state_count());
  const auto visit = [&](State s) { return kept.find(s.value, s); };

  std::vector<Edge> visible;
  std::vector<State> targets;
  visit(lts.initial());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (watch.due()) {
      if (const auto limit = watch.look()) return *limit;
      const std::uint64_t bytes = rows.peak_bytes(visible.size()) + acceptances.peak_bytes();
      if (const auto limit = watch.budget().check_memory(bytes)) return *limit;
    }
    const std::span<const State> behind = reach.closure(kept[i]);
    visible.clear();
    for (const State s : behind) {
      for (const Edge& edge : lts.edges(s)) {
        if (edge.label != tau) visible.push_back(edge);
      }
    }
    acceptances.add(behind);
    divergent.push_back(diverges[kept[i].value]);
    std::ranges::sort(visible);
    visible.erase(std::unique(visible.begin(), visible.end()), visible.end());
    for (auto edge = visible.begin(); edge != visible.end();) {
      const Label label = edge->label;
      targets.clear();
      for (; edge != visible.end() && edge->label == label; ++edge) targets.push_back(edge->target);
      reach.keep_first(targets);
      for (const State target : targets) rows.add_edge(label, visit(target));
    }
    rows.end_row();
  }
  return GeneralisedLts{std::move(rows).finish(State{0}, kept.size(), lts.shared_label_names()),
                        std::move(divergent), std::move(acceptances).finish()};
}

}  // namespace perentie::lts

// What a state can do after τ is found from what those can do that τ leads to, so each τ is looked
// at once.
#include <algorithm>

#include "discovery.hpp"
#include "perentie/lts/compressions.hpp"
#include "perentie/lts/divergence.hpp"
#include "perentie/lts/memory.hpp"
#include "perentie/lts/watch.hpp"
#include "tau_components.hpp"

namespace perentie::lts {

namespace {

using TargetsId = base::Id<struct TargetsTag>;

/// Sets of states without those that τ leads to from another one of the set. τ has no cycles but
/// loops.
class FirstTargets {
 public:
  FirstTargets(const Lts& lts, const TauComponents& order)
      : lts_(lts), order_(order), reached_in_(lts.state_count(), 0) {}

  /// Of a set in any order, which is used up.
  TargetsId of(std::vector<State>& targets) {
    std::ranges::sort(targets);
    targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
    const TargetsId all = sets_.add(targets);
    if (all.value < first_.size()) return first_[all.value];
    first_.push_back(all);
    if (targets.size() < 2 || !keep_first(targets)) return all;
    const TargetsId kept = sets_.add(targets);
    if (kept.value == first_.size()) first_.push_back(kept);
    first_[all.value] = kept;
    return kept;
  }

  std::span<const State> operator[](TargetsId id) const { return sets_[id]; }
  std::uint64_t peak_bytes() const { return sets_.peak_bytes(0) + lts::peak_bytes(first_, 1); }

 private:
  // False: all are. τ leads from a state to lower ones only.
  bool keep_first(std::vector<State>& targets) {
    ++searches_;
    std::uint32_t lowest = order_.of[targets.front().value];
    for (const State t : targets) lowest = std::min(lowest, order_.of[t.value]);
    unfinished_.assign(targets.begin(), targets.end());
    while (!unfinished_.empty()) {
      const State from = unfinished_.back();
      unfinished_.pop_back();
      for (const Edge& edge : lts_.edges(from, tau)) {
        std::uint64_t& reached = reached_in_[edge.target.value];
        if (edge.target == from || reached == searches_) continue;
        if (order_.of[edge.target.value] < lowest) continue;
        reached = searches_;
        unfinished_.push_back(edge.target);
      }
    }
    return std::erase_if(targets, [&](State t) { return reached_in_[t.value] == searches_; }) > 0;
  }

  const Lts& lts_;
  const TauComponents& order_;
  UniqueRuns<TargetsId, State> sets_;
  std::vector<TargetsId> first_;           // by set
  std::vector<std::uint64_t> reached_in_;  // by state: the last search that came to it
  std::uint64_t searches_ = 0;
  std::vector<State> unfinished_;
};

/// What a state can do after any number of τ.
struct Moves {
  Label label;
  TargetsId targets;

  friend constexpr auto operator<=>(const Moves&, const Moves&) = default;
};

/// The edges of a state and those of the states that τ leads to, as far as they are known.
void gather(const Lts& lts, State state, const TauComponents& order, const Runs<Moves>& known,
            FirstTargets& first, std::vector<Moves>& out) {
  out.clear();
  std::vector<State> targets;
  const auto edges = lts.edges(state);
  for (auto edge = edges.begin(); edge != edges.end();) {
    if (edge->label == tau) {
      if (edge->target != state) {
        const auto behind = known[order.of[edge->target.value]];
        out.insert(out.end(), behind.begin(), behind.end());
      }
      ++edge;
      continue;
    }
    const Label label = edge->label;
    targets.clear();
    for (; edge != edges.end() && edge->label == label; ++edge) targets.push_back(edge->target);
    out.push_back({label, first.of(targets)});
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

/// Unites the targets of each label.
void unite(FirstTargets& first, std::vector<Moves>& moves) {
  std::vector<State> targets;
  auto united = moves.begin();
  for (auto move = moves.begin(); move != moves.end(); ++united) {
    Moves whole = *move++;
    if (move != moves.end() && move->label == whole.label) {
      const auto some = first[whole.targets];
      targets.assign(some.begin(), some.end());
      for (; move != moves.end() && move->label == whole.label; ++move) {
        const auto more = first[move->targets];
        targets.insert(targets.end(), more.begin(), more.end());
      }
      whole.targets = first.of(targets);
    }
    *united = whole;
  }
  moves.erase(united, moves.end());
}

}  // namespace

GeneralisedResult diamond(const Lts& original, const base::Limits& limits) {
  const Quotient factored = tau_loop_factor(original);
  const Lts& lts = factored.lts;
  const std::vector<bool> diverges = divergent_states(lts);
  const TauComponents order = tau_components(lts);
  Watch watch(limits);
  FirstTargets first(lts, order);
  AcceptanceBuilder acceptances(lts);
  Runs<Moves> moves;  // these and acceptances in the order of components, each of which is a state
  std::vector<Moves> row;
  std::vector<State> behind;
  for (const std::uint32_t s : order.states) {
    if (watch.due()) {
      if (const auto limit = watch.look()) return *limit;
      const std::uint64_t bytes =
          first.peak_bytes() + moves.peak_bytes(row.size()) + acceptances.peak_bytes();
      if (const auto limit = watch.budget().check_memory(bytes)) return *limit;
    }
    gather(lts, State{s}, order, moves, first, row);
    unite(first, row);
    moves.add(row);
    behind.clear();
    for (const Edge& edge : lts.edges(State{s}, tau)) {
      if (edge.target != State{s}) behind.push_back(State{order.of[edge.target.value]});
    }
    acceptances.add(State{s}, behind);
  }

  LtsRowBuilder rows;
  std::vector<bool> divergent;
  std::vector<State> kept_in_order;
  Discovery kept(lts.state_count());
  const auto visit = [&](State s) { return kept.find(s.value, s); };
  visit(lts.initial());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const State component{order.of[kept[i].value]};
    for (const Moves& move : moves[component.value]) {
      for (const State target : first[move.targets]) rows.add_edge(move.label, visit(target));
    }
    rows.end_row();
    divergent.push_back(diverges[kept[i].value]);
    kept_in_order.push_back(component);
  }
  return GeneralisedLts{std::move(rows).finish(State{0}, kept.size(), lts.shared_label_names()),
                        std::move(divergent),
                        std::move(acceptances).finish().of_states(kept_in_order)};
}

}  // namespace perentie::lts

// The signature of a state is the set of pairs (label, block) of its steps behind τ*, and (τ,
// block) for the blocks of τ*. Without τ cycles it is the union of the signatures of the τ
// successors and the state's own pairs, so it is computed from them; unions that were made before
// are looked up. Weak bisimulation is delay bisimulation of the graph in which a visible step goes
// on to wherever τ leads after it.
#include "perentie/lts/weak_bisimulation.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

#include "discovery.hpp"
#include "partition.hpp"
#include "perentie/base/check.hpp"
#include "perentie/lts/compressions.hpp"
#include "perentie/lts/divergence.hpp"
#include "perentie/lts/runs.hpp"
#include "perentie/lts/watch.hpp"
#include "tau_closure.hpp"
#include "tau_components.hpp"

namespace perentie::lts {

namespace {

constexpr std::uint64_t pair_of(Label label, std::uint32_t block) {
  return (std::uint64_t{label.value} << 32U) | block;
}

/// Refines a partition of an Lts whose τ edges have no cycles but loops.
class DelayRefinement {
 public:
  DelayRefinement(const Lts& lts, const base::Limits& limits)
      : lts_(lts),
        watch_(limits),
        diverges_(divergent_states(lts)),
        is_due_(lts.state_count(), 0),
        signature_(lts.state_count()),
        key_(lts.state_count(), 0),
        partition_(static_cast<std::uint32_t>(lts.state_count())) {
    TauComponents components = tau_components(lts);
    PERENTIE_CHECK(components.count() == lts.state_count(), "τ leads round a cycle of states");
    rank_ = std::move(components.of);
    by_rank_ = std::move(components.states);
    take_predecessors();
  }

  std::optional<base::LimitReached> run() {
    std::vector<Partition::Split> splits;
    part_divergent(splits);
    for (std::uint32_t rank = 0; rank < by_rank_.size(); ++rank) make_due(by_rank_[rank]);
    while (!due_.empty()) {
      if (const auto limit = sign()) return limit;
      splits.clear();
      partition_.split(changed_, key_, splits);
      changed_.clear();
      for (const Partition::Split& split : splits) {
        for (const std::uint32_t s : partition_.members(split.block)) {
          make_due(s);
          for (const Predecessor& p : predecessors(s)) make_due(p.state);
        }
      }
    }
    return std::nullopt;
  }

  const Partition& partition() const { return partition_; }
  bool diverges(State s) const { return diverges_[s.value]; }
  /// The steps behind τ* of a state, sorted.
  std::span<const std::uint64_t> steps(State s) const { return signatures_[signature_[s.value]]; }
  /// The member of a block from which τ leads to no other member.
  State bottom(std::uint32_t block) const {
    return State{
        std::ranges::min(partition_.members(block), {}, [&](std::uint32_t s) { return rank_[s]; })};
  }

 private:
  using KeyId = base::Id<struct KeyTag>;
  using SignatureId = base::Id<struct SignatureTag>;

  static constexpr std::uint64_t signature_word = std::uint64_t{~std::uint32_t{0}} << 32U;

  struct Predecessor {
    std::uint32_t state;
    bool by_tau;
  };

  void take_predecessors() {
    rows_.assign(rank_.size() + 1, 0);
    for (std::uint32_t s = 0; s < rank_.size(); ++s) {
      for (const Edge& edge : lts_.edges(State{s})) ++rows_[edge.target.value + std::size_t{1}];
    }
    std::partial_sum(rows_.begin(), rows_.end(), rows_.begin());
    predecessors_.resize(lts_.edge_count());
    std::vector<std::uint64_t> next(rows_.begin(), rows_.end() - 1);
    for (std::uint32_t s = 0; s < rank_.size(); ++s) {
      for (const Edge& edge : lts_.edges(State{s})) {
        predecessors_[next[edge.target.value]++] = {s, edge.label == tau};
      }
    }
  }

  std::span<const Predecessor> predecessors(std::uint32_t s) const {
    return std::span(predecessors_).subspan(rows_[s], rows_[s + std::size_t{1}] - rows_[s]);
  }

  void part_divergent(std::vector<Partition::Split>& splits) {
    for (std::size_t s = 0; s < key_.size(); ++s) key_[s] = diverges_[s] ? 1 : 0;
    partition_.split(by_rank_, key_, splits);
  }

  void make_due(std::uint32_t s) {
    if (is_due_[s] != 0) return;
    is_due_[s] = 1;
    due_.push_back(rank_[s]);
    std::ranges::push_heap(due_, std::greater<>());
  }

  /// Signs the states that are due, τ successors first.
  std::optional<base::LimitReached> sign() {
    while (!due_.empty()) {
      if (watch_.due()) {
        if (const auto limit = watch_.look()) return limit;
        const std::uint64_t bytes = keys_.peak_bytes(key_words_.size()) +
                                    signatures_.peak_bytes(union_.size()) +
                                    signature_of_key_.capacity() * sizeof(SignatureId);
        if (const auto limit = watch_.budget().check_memory(bytes)) return limit;
      }
      std::ranges::pop_heap(due_, std::greater<>());
      const std::uint32_t s = by_rank_[due_.back()];
      due_.pop_back();
      is_due_[s] = 0;
      const SignatureId signature = sign(s);
      if (signature == signature_[s]) continue;
      signature_[s] = signature;
      key_[s] = signature.value;
      changed_.push_back(s);
      for (const Predecessor& p : predecessors(s)) {
        if (p.by_tau && p.state != s) make_due(p.state);
      }
    }
    return std::nullopt;
  }

  SignatureId sign(std::uint32_t s) {
    key_words_.clear();
    key_words_.push_back(pair_of(tau, partition_.block_of(s)));
    for (const Edge& edge : lts_.edges(State{s})) {
      if (edge.label != tau) {
        key_words_.push_back(pair_of(edge.label, partition_.block_of(edge.target.value)));
      } else if (edge.target.value != s) {
        key_words_.push_back(signature_word | signature_[edge.target.value].value);
      }
    }
    std::ranges::sort(key_words_);
    key_words_.erase(std::unique(key_words_.begin(), key_words_.end()), key_words_.end());
    if (key_words_.back() < signature_word) return signatures_.add(key_words_);  // no τ
    const KeyId key = keys_.add(key_words_);
    if (key.value == signature_of_key_.size()) signature_of_key_.push_back(unite(key_words_));
    return signature_of_key_[key.value];
  }

  SignatureId unite(std::span<const std::uint64_t> words) {
    union_.clear();
    for (const std::uint64_t word : words) {
      if (word < signature_word) {
        union_.push_back(word);
      } else {
        const auto part = signatures_[SignatureId{static_cast<std::uint32_t>(word)}];
        union_.insert(union_.end(), part.begin(), part.end());
      }
    }
    std::ranges::sort(union_);
    union_.erase(std::unique(union_.begin(), union_.end()), union_.end());
    return signatures_.add(union_);
  }

  const Lts& lts_;
  Watch watch_;
  std::vector<bool> diverges_;
  std::vector<std::uint32_t> rank_;  // by state; τ leads to lower ranks
  std::vector<std::uint32_t> by_rank_;
  std::vector<std::uint64_t> rows_;
  std::vector<Predecessor> predecessors_;
  std::vector<std::uint32_t> due_;  // a heap of ranks, the lowest on top
  std::vector<std::uint8_t> is_due_;
  std::vector<std::uint32_t> changed_;     // states whose signature is new; in a round each once
  UniqueRuns<KeyId, std::uint64_t> keys_;  // own pairs, and the signatures of τ successors
  std::vector<SignatureId> signature_of_key_;
  UniqueRuns<SignatureId, std::uint64_t> signatures_;
  std::vector<SignatureId> signature_;  // by state
  std::vector<std::uint64_t> key_;      // the same for the partition
  Partition partition_;
  std::vector<std::uint64_t> key_words_;
  std::vector<std::uint64_t> union_;
};

/// The quotient of `lts` by a partition whose signatures `refinement` knows. Leaves out what a τ
/// successor can do as well and, if τ may follow a visible step, what follows another one.
Quotient quotient(const Lts& lts, const DelayRefinement& refinement, bool tau_follows) {
  const Partition& partition = refinement.partition();
  const auto block_of = [&](State s) { return partition.block_of(s.value); };
  const auto has = [&](State s, std::uint64_t pair) {
    return std::ranges::binary_search(refinement.steps(s), pair);
  };
  const auto is_superfluous = [&](const Edge& edge, std::span<const Edge> row, State source) {
    const std::uint32_t target = block_of(edge.target);
    if (target == block_of(source) && edge.label == tau) {  // a divergence
      return std::ranges::any_of(row, [&](const Edge& other) {
        return other.label == tau && block_of(other.target) != target &&
               refinement.diverges(other.target);
      });
    }
    return std::ranges::any_of(row, [&](const Edge& other) {
      if (other.label == tau) {
        return block_of(other.target) != block_of(source) &&
               !(edge.label == tau && block_of(other.target) == target) &&
               has(other.target, pair_of(edge.label, target));
      }
      return tau_follows && other.label == edge.label && block_of(other.target) != target &&
             has(other.target, pair_of(tau, target));
    });
  };

  return quotient_by(lts, partition.block_count(), block_of, [&](State member, auto add) {
    const State source = refinement.bottom(block_of(member));
    const std::span<const Edge> row = lts.edges(source);
    for (const Edge& edge : row) {
      if (!is_superfluous(edge, row, source)) add(edge.label, edge.target);
    }
  });
}

/// Makes the visible steps of each state go on to all that τ leads to after them.
std::variant<Lts, base::LimitReached> follow_with_tau(const Lts& lts, const base::Limits& limits) {
  Watch watch(limits);
  LtsRowBuilder rows;
  std::vector<State> reached;
  TauClosure closure(lts);
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    if (watch.due()) {
      if (const auto limit = watch.look()) return *limit;
      if (const auto limit = watch.budget().check_memory(rows.peak_bytes(0))) return *limit;
    }
    const std::span<const Edge> row = lts.edges(State{s});
    for (auto edge = row.begin(); edge != row.end();) {
      const Label label = edge->label;
      reached.clear();
      for (; edge != row.end() && edge->label == label; ++edge) reached.push_back(edge->target);
      if (label != tau) closure.close(reached);
      for (const State t : reached) rows.add_edge(label, t);
    }
    rows.end_row();
  }
  return std::move(rows).finish(lts.initial(), lts.state_count(), lts.shared_label_names());
}

/// First `inner`, then `outer`, a quotient of its result.
Quotient compose(const Quotient& inner, Quotient outer) {
  std::vector<State> block_of(inner.block_of.size());
  for (std::size_t s = 0; s < block_of.size(); ++s) {
    const State block = inner.block_of[s];
    if (!block.is_none()) block_of[s] = outer.block_of[block.value];
  }
  return {std::move(outer.lts), std::move(block_of)};
}

}  // namespace

QuotientResult delay_bisimulation(const Lts& lts, const base::Limits& limits) {
  const Quotient factored = tau_loop_factor(lts);
  Quotient small = compose(factored, strong_bisimulation(factored.lts));
  if (!has_tau(small.lts)) return small;
  DelayRefinement refinement(small.lts, limits);
  if (const auto limit = refinement.run()) return *limit;
  return compose(small, quotient(small.lts, refinement, false));
}

QuotientResult weak_bisimulation(const Lts& lts, const base::Limits& limits) {
  QuotientResult delay = delay_bisimulation(lts, limits);
  if (std::holds_alternative<base::LimitReached>(delay)) return delay;
  const Quotient& small = std::get<Quotient>(delay);
  const auto followed = follow_with_tau(small.lts, limits);
  if (const auto* limit = std::get_if<base::LimitReached>(&followed)) return *limit;
  DelayRefinement refinement(std::get<Lts>(followed), limits);
  if (const auto limit = refinement.run()) return *limit;
  return compose(small, quotient(small.lts, refinement, true));
}

}  // namespace perentie::lts

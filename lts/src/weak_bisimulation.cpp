// The signature of a state is the set of pairs (label, block) of its steps behind τ*, and (τ,
// block) for the blocks of τ*. Without τ cycles it is the union of the signatures of the τ
// successors and the state's own pairs, so it is computed from them; unions that were made before
// are looked up. Weak bisimulation is delay bisimulation of the graph in which a visible step goes
// on to wherever τ leads after it.
#include "perentie/lts/weak_bisimulation.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "discovery.hpp"
#include "number_set.hpp"
#include "partition.hpp"
#include "perentie/base/check.hpp"
#include "perentie/base/growing_array.hpp"
#include "perentie/lts/runs.hpp"
#include "perentie/lts/watch.hpp"
#include "tau_closure.hpp"
#include "tau_components.hpp"

namespace perentie::lts {

namespace {

/// Refines a partition of an Lts in τ order: τ leads to lower states, or to the same. `Word` has
/// room for a pair of a label and a state, and one bit more.
template <class Word>
class DelayRefinement {
 public:
  DelayRefinement(const Lts& lts, const base::Limits& limits)
      : lts_(lts),
        watch_(limits),
        due_(static_cast<std::uint32_t>(lts.state_count())),
        signature_(lts.state_count()),
        key_(lts.state_count(), 0),
        partition_(static_cast<std::uint32_t>(lts.state_count())) {
    take_divergence();
    take_predecessors();
  }

  std::optional<base::LimitReached> run() {
    std::vector<Partition::Split> splits;
    part_divergent(splits);
    for (std::uint32_t s = 0; s < key_.size(); ++s) due_.insert(s);
    while (!due_.empty()) {
      if (const auto limit = sign()) return limit;
      splits.clear();
      partition_.split(changed_, key_, splits);
      changed_.clear();
      for (const Partition::Split& split : splits) {
        for (const std::uint32_t s : partition_.members(split.block)) {
          due_.insert(s);
          for (const Predecessor& p : predecessors(s)) due_.insert(p.state);
        }
      }
      forget();
    }
    return std::nullopt;
  }

  const Partition& partition() const { return partition_; }
  /// What stands for a label and a block in steps.
  Word pair_of(Label label, std::uint32_t block) const {
    return static_cast<Word>(label.value * static_cast<Word>(lts_.state_count()) + block);
  }
  bool diverges(State s) const { return diverges_[s.value]; }
  /// The steps behind τ* of a state, sorted.
  std::span<const Word> steps(State s) const { return signatures_[signature_[s.value]]; }
  /// The member of a block from which τ leads to no other member.
  State bottom(std::uint32_t block) const {
    return State{std::ranges::min(partition_.members(block))};
  }

 private:
  using KeyId = base::Id<struct KeyTag>;
  using SignatureId = base::Id<struct SignatureTag>;
  using Signatures = UniqueRuns<SignatureId, Word>;

  static constexpr Word signature_word = Word{1} << (8 * sizeof(Word) - 1);

  struct Predecessor {
    std::uint32_t state;
    bool by_tau;
  };

  void take_divergence() {
    diverges_.resize(lts_.state_count());
    for (std::uint32_t s = 0; s < diverges_.size(); ++s) {
      for (const Edge& edge : lts_.edges(State{s}, tau)) {
        PERENTIE_CHECK(edge.target.value <= s, "an Lts is not in τ order");
        if (edge.target.value == s || diverges_[edge.target.value]) diverges_[s] = true;
      }
    }
  }

  void take_predecessors() {
    rows_.resize(lts_.state_count() + 1);
    for (std::uint32_t s = 0; s < lts_.state_count(); ++s) {
      for (const Edge& edge : lts_.edges(State{s})) ++rows_[edge.target.value + std::size_t{1}];
    }
    std::partial_sum(rows_.begin(), rows_.end(), rows_.begin());
    predecessors_.resize_for_overwrite(lts_.edge_count());
    std::vector<std::uint64_t> next(rows_.begin(), rows_.end() - 1);
    for (std::uint32_t s = 0; s < lts_.state_count(); ++s) {
      for (const Edge& edge : lts_.edges(State{s})) {
        predecessors_[next[edge.target.value]++] = {s, edge.label == tau};
      }
    }
  }

  std::span<const Predecessor> predecessors(std::uint32_t s) const {
    return {predecessors_.begin() + rows_[s], predecessors_.begin() + rows_[s + std::size_t{1}]};
  }

  void part_divergent(std::vector<Partition::Split>& splits) {
    std::vector<std::uint32_t> all(key_.size());
    std::iota(all.begin(), all.end(), 0U);
    for (std::size_t s = 0; s < key_.size(); ++s) key_[s] = diverges_[s] ? 1 : 0;
    partition_.split(all, key_, splits);
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
      const std::uint32_t s = due_.take_least();
      const SignatureId signature = sign(s);
      if (signature == signature_[s]) continue;
      signature_[s] = signature;
      key_[s] = signature.value;
      changed_.push_back(s);
      for (const Predecessor& p : predecessors(s)) {
        if (p.by_tau && p.state != s) due_.insert(p.state);
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

  /// The union of the pairs in a key and of the signatures in it.
  SignatureId unite(std::span<const Word> words) {
    const auto pairs_end = std::ranges::lower_bound(words, signature_word);
    union_.assign(words.begin(), pairs_end);
    for (const Word word : std::span(pairs_end, words.end())) {
      const auto part = signatures_[SignatureId{static_cast<std::uint32_t>(word - signature_word)}];
      united_.clear();
      std::ranges::set_union(union_, part, std::back_inserter(united_));
      std::swap(union_, united_);
    }
    return signatures_.add(union_);
  }

  /// Drops what only earlier rounds needed: all keys and, once they are many, the signatures that
  /// no state has any more.
  void forget() {
    keys_ = {};
    signature_of_key_.clear();
    if (signatures_.size() < signature_.size() + signature_.size() / 2) return;
    Signatures kept;
    std::vector<SignatureId> number(signatures_.size());
    for (std::size_t s = 0; s < signature_.size(); ++s) {
      SignatureId& kept_as = number[signature_[s].value];
      if (kept_as.is_none()) kept_as = kept.add(signatures_[signature_[s]]);
      signature_[s] = kept_as;
      key_[s] = kept_as.value;
    }
    signatures_ = std::move(kept);
  }

  const Lts& lts_;
  Watch watch_;
  std::vector<bool> diverges_;
  base::GrowingArray<std::uint64_t> rows_;
  base::GrowingArray<Predecessor> predecessors_;
  NumberSet due_;
  std::vector<std::uint32_t> changed_;  // states whose signature is new; in a round each once
  UniqueRuns<KeyId, Word> keys_;        // own pairs, and the signatures of τ successors
  std::vector<SignatureId> signature_of_key_;
  Signatures signatures_;
  std::vector<SignatureId> signature_;  // by state
  std::vector<std::uint64_t> key_;      // the same for the partition
  Partition partition_;
  std::vector<Word> key_words_;
  std::vector<Word> union_;
  std::vector<Word> united_;
};

/// The quotient of `lts` by a partition whose signatures `refinement` knows. Leaves out what a τ
/// successor can do as well and, if τ may follow a visible step, what follows another one.
template <class Word>
Quotient quotient(const Lts& lts, const DelayRefinement<Word>& refinement, bool tau_follows) {
  const Partition& partition = refinement.partition();
  const auto block_of = [&](State s) { return partition.block_of(s.value); };
  const auto has = [&](State s, Label label, std::uint32_t block) {
    return std::ranges::binary_search(refinement.steps(s), refinement.pair_of(label, block));
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
               has(other.target, edge.label, target);
      }
      return tau_follows && other.label == edge.label && block_of(other.target) != target &&
             has(other.target, tau, target);
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

template <class Word>
QuotientResult reduce(const Lts& lts, const base::Limits& limits, bool tau_follows) {
  DelayRefinement<Word> refinement(lts, limits);
  if (const auto limit = refinement.run()) return *limit;
  return quotient(lts, refinement, tau_follows);
}

/// The quotient of an Lts in τ order by delay bisimulation.
QuotientResult reduce(const Lts& lts, const base::Limits& limits, bool tau_follows) {
  // Signatures are numbered below 2.5 times the number of states.
  const bool fits = lts.label_names().size() * lts.state_count() < std::size_t{1} << 30U;
  return fits ? reduce<std::uint32_t>(lts, limits, tau_follows)
              : reduce<std::uint64_t>(lts, limits, tau_follows);
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

/// The strongly connected components of τ as states in τ order.
Quotient factor_in_tau_order(const Lts& lts) {
  const TauComponents components = tau_components(lts);
  const auto component = [&](State s) { return State{components.of[s.value]}; };
  LtsRowBuilder rows;
  for (std::uint32_t c = 0; c < components.count(); ++c) {
    for (const std::uint32_t s : components.members(c)) {
      for (const Edge& edge : lts.edges(State{s}))
        rows.add_edge(edge.label, component(edge.target));
    }
    rows.end_row();
  }
  std::vector<State> block_of(lts.state_count());
  for (std::uint32_t s = 0; s < block_of.size(); ++s) block_of[s] = component(State{s});
  return {std::move(rows).finish(component(lts.initial()), components.count(),
                                 lts.shared_label_names()),
          std::move(block_of)};
}

/// First `inner`, then `outer`, a quotient of its result, unless that met a limit.
QuotientResult compose(const Quotient& inner, QuotientResult result) {
  auto* const outer = std::get_if<Quotient>(&result);
  if (outer == nullptr) return result;
  std::vector<State> block_of(inner.block_of.size());
  for (std::size_t s = 0; s < block_of.size(); ++s) {
    const State block = inner.block_of[s];
    if (!block.is_none()) block_of[s] = outer->block_of[block.value];
  }
  return Quotient{std::move(outer->lts), std::move(block_of)};
}

}  // namespace

QuotientResult delay_bisimulation(const Lts& lts, const base::Limits& limits) {
  if (!has_tau(lts)) return strong_bisimulation(lts);
  const Quotient factored = factor_in_tau_order(lts);
  return compose(factored, reduce(factored.lts, limits, false));
}

QuotientResult weak_bisimulation(const Lts& lts, const base::Limits& limits) {
  QuotientResult delay = delay_bisimulation(lts, limits);
  const auto* const small = std::get_if<Quotient>(&delay);
  if (small == nullptr || !has_tau(small->lts)) return delay;
  const Quotient sorted = factor_in_tau_order(small->lts);
  const auto followed = follow_with_tau(sorted.lts, limits);
  if (const auto* limit = std::get_if<base::LimitReached>(&followed)) return *limit;
  return compose(*small, compose(sorted, reduce(std::get<Lts>(followed), limits, true)));
}

}  // namespace perentie::lts

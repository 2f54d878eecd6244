// The signature of a state is the set of pairs (label, block) that its edges lead to, kept as the
// sum of the pairs' hashes. A group counts the edges of one state with one label into one block, so
// that the signature changes exactly when a pair appears or vanishes (Paige and Tarjan's counts).
// When a block is split, only edges into the smaller parts are looked at. Hashes may collide, and
// then too little is split: the partition is checked in the end, and made again in that case.
#include <algorithm>
#include <array>

#include "discovery.hpp"
#include "partition.hpp"
#include "perentie/base/check.hpp"
#include "perentie/base/growing_array.hpp"
#include "perentie/base/hash.hpp"
#include "perentie/lts/bisimulation.hpp"
#include "stable_partition.hpp"

namespace perentie::lts {

namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

class Refinement {
 public:
  Refinement(const Lts& lts, std::span<const std::uint32_t> classes, std::uint64_t seed)
      : seed_(seed),
        is_changed_(lts.state_count(), 0),
        partition_(static_cast<std::uint32_t>(lts.state_count())) {
    signatures_.resize(lts.state_count(), 0);
    take_edges(lts);
    changed_.resize(lts.state_count());
    for (std::uint32_t s = 0; s < changed_.size(); ++s) {
      changed_[s] = s;
      if (!classes.empty()) signatures_[s] += base::hash_mix(~seed_, classes[s]);
    }
  }

  Partition run() && {
    std::vector<Partition::Split> splits;
    while (!changed_.empty()) {
      splits.clear();
      partition_.split(changed_, signatures_, splits);
      for (const std::uint32_t s : changed_) is_changed_[s] = 0;
      changed_.clear();
      move_edges(splits);
    }
    return std::move(partition_);
  }

 private:
  struct InEdge {
    std::uint32_t source;
    std::uint32_t label;
    std::uint32_t group;
  };
  /// The edges of one state with one label into one block.
  struct Group {
    std::uint32_t count;
    std::uint32_t moved_into;  // the last new block that some of its edges turned out to lead into
    std::uint32_t moved_to;    // and the group of those edges
  };
  struct MovedState {
    std::uint32_t state;
    Partition::Split split;
  };
  struct MovedEdge {
    InEdge* edge;
    Partition::Split split;
  };

  std::uint64_t hash(std::uint32_t label, std::uint32_t block) const {
    return base::hash_mix(seed_, (std::uint64_t{label} << 32U) | block);
  }

  /// Sorts the edges by target, and groups them, all states being in block 0.
  void take_edges(const Lts& lts) {
    PERENTIE_CHECK(lts.edge_count() < none, "an Lts has 2^32 edges or more");
    const auto states = static_cast<std::uint32_t>(lts.state_count());
    rows_.resize(states + std::size_t{1}, 0);
    for (std::uint32_t s = 0; s < states; ++s) {
      for (const Edge& edge : lts.edges(State{s})) ++rows_[edge.target.value + std::size_t{1}];
    }
    for (std::size_t i = 1; i < rows_.size(); ++i) rows_[i] += rows_[i - 1];
    in_edges_.resize(lts.edge_count());
    for (std::uint32_t s = 0; s < states; ++s) {
      Label label;
      for (const Edge& edge : lts.edges(State{s})) {
        if (edge.label != label) {
          label = edge.label;
          groups_.push_back({0, none, none});
          signatures_[s] += hash(label.value, 0);
        }
        ++groups_.back().count;
        const auto group = static_cast<std::uint32_t>(groups_.size() - 1);
        in_edges_[rows_[edge.target.value]++] = {s, label.value, group};
      }
    }
    // Each entry is now the end of its row: the beginning of the next.
    for (std::size_t i = rows_.size() - 1; i > 0; --i) rows_[i] = rows_[i - 1];
    rows_[0] = 0;
  }

  /// The round's new blocks state by state, so that memory can be fetched ahead over all of them.
  void move_edges(std::span<const Partition::Split> splits) {
    constexpr std::size_t ahead = 8;
    moved_.resize(0);
    for (const Partition::Split& split : splits) {
      for (const std::uint32_t s : partition_.members(split.block)) moved_.push_back({s, split});
    }
    std::array<MovedEdge, 64> batch;
    std::size_t batched = 0;
    const auto flush = [&] {
      for (std::size_t i = 0; i < batched; ++i) move_edge(*batch[i].edge, batch[i].split);
      batched = 0;
    };
    for (std::size_t i = 0; i < moved_.size(); ++i) {
      if (i + 2 * ahead < moved_.size()) __builtin_prefetch(&rows_[moved_[i + 2 * ahead].state]);
      if (i + ahead < moved_.size()) {
        __builtin_prefetch(in_edges_.begin() + rows_[moved_[i + ahead].state]);
      }
      const std::uint32_t target = moved_[i].state;
      for (std::uint32_t e = rows_[target]; e < rows_[target + std::size_t{1}]; ++e) {
        __builtin_prefetch(&groups_[in_edges_[e].group]);
        __builtin_prefetch(&signatures_[in_edges_[e].source]);
        batch[batched++] = {&in_edges_[e], moved_[i].split};
        if (batched == batch.size()) flush();
      }
    }
    flush();
  }

  /// The edge led into `split.from` and leads into `split.block` now.
  void move_edge(InEdge& edge, const Partition::Split& split) {
    const std::uint32_t old_group = edge.group;
    std::uint64_t& signature = signatures_[edge.source];
    if (groups_[old_group].moved_into != split.block) {
      signature += hash(edge.label, split.block);
      change(edge.source);
      if (groups_[old_group].count == 1) {  // the group moves as a whole
        signature -= hash(edge.label, split.from);
        return;
      }
      const std::uint32_t group = new_group();
      groups_[old_group].moved_into = split.block;
      groups_[old_group].moved_to = group;
    }
    edge.group = groups_[old_group].moved_to;
    ++groups_[edge.group].count;
    if (--groups_[old_group].count == 0) {
      signature -= hash(edge.label, split.from);
      free_groups_.push_back(old_group);
    }
  }

  std::uint32_t new_group() {
    if (free_groups_.empty()) {
      groups_.push_back({0, none, none});
      return static_cast<std::uint32_t>(groups_.size() - 1);
    }
    const std::uint32_t group = free_groups_.back();
    free_groups_.pop_back();
    groups_[group] = {0, none, none};
    return group;
  }

  void change(std::uint32_t state) {
    if (is_changed_[state] != 0) return;
    is_changed_[state] = 1;
    changed_.push_back(state);
  }

  std::uint64_t seed_;
  base::GrowingArray<std::uint32_t> rows_;  // by state, where its incoming edges begin
  base::GrowingArray<InEdge> in_edges_;
  base::GrowingArray<Group> groups_;
  std::vector<std::uint32_t> free_groups_;
  base::GrowingArray<MovedState> moved_;  // in the round in hand
  base::GrowingArray<std::uint64_t> signatures_;
  std::vector<std::uint8_t> is_changed_;
  std::vector<std::uint32_t> changed_;  // states whose signature may have changed
  Partition partition_;
};

Quotient quotient(const Lts& lts, const Partition& partition) {
  return quotient_by(
      lts, partition.block_count(), [&](State s) { return partition.block_of(s.value); },
      [&](State s, auto add) {
        for (const Edge& edge : lts.edges(s)) add(edge.label, edge.target);
      });
}

}  // namespace

bool is_stable(const Lts& lts, const Partition& partition) {
  std::vector<std::uint64_t> expected;
  std::vector<std::uint64_t> pairs;
  const auto signature = [&](std::uint32_t s, std::vector<std::uint64_t>& out) {
    out.clear();
    for (const Edge& edge : lts.edges(State{s})) {
      const std::uint32_t block = partition.block_of(edge.target.value);
      out.push_back((std::uint64_t{edge.label.value} << 32U) | block);
    }
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
  };
  for (std::uint32_t b = 0; b < partition.block_count(); ++b) {
    const std::span<const std::uint32_t> members = partition.members(b);
    if (members.size() == 1) continue;
    signature(members.front(), expected);
    for (const std::uint32_t s : members.subspan(1)) {
      signature(s, pairs);
      if (pairs != expected) return false;
    }
  }
  return true;
}

bool parts(const Partition& partition, std::span<const std::uint32_t> classes) {
  for (std::uint32_t s = 0; s < classes.size(); ++s) {
    if (classes[s] != classes[partition.members(partition.block_of(s)).front()]) return false;
  }
  return true;
}

Quotient strong_bisimulation(const Lts& lts, std::span<const std::uint32_t> classes) {
  PERENTIE_CHECK(classes.empty() || classes.size() == lts.state_count(),
                 "the classes are not one a state");
  for (std::uint64_t seed = 0;; ++seed) {
    const Partition partition = Refinement(lts, classes, seed).run();
    if (parts(partition, classes) && is_stable(lts, partition)) return quotient(lts, partition);
  }
}

}  // namespace perentie::lts

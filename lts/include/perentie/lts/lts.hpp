// Labelled transition systems: the explicit, immutable graph that every analysis reads.
//
// States and labels are dense ids. Label 0 is τ, label 1 is ✓, events follow. The edges of a state
// are one run of a single array, sorted by (label, target) and free of duplicates, so the
// successors under one label are a sub-run. An `Lts` is made by a builder and never changes
// afterwards.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/base/growing_array.hpp"
#include "perentie/base/id.hpp"

namespace perentie::lts {

using State = base::Id<struct StateTag>;
using Label = base::Id<struct LabelTag>;

inline constexpr Label tau{0};
inline constexpr Label tick{1};

/// The printed names of τ and ✓, as FDR prints them (CSPM reference 4.1.1).
inline constexpr std::string_view tau_name = "τ";
inline constexpr std::string_view tick_name = "✓";

struct Edge {
  Label label;
  State target;

  friend constexpr auto operator<=>(const Edge&, const Edge&) = default;
};

/// The names of labels, by label. Always begins with τ and ✓; names are distinct.
using LabelNames = std::vector<std::string>;

/// The labels of edges that are sorted, each once.
std::vector<Label> labels_on(std::span<const Edge> edges);

class Lts {
 public:
  std::size_t state_count() const { return rows_.size() - 1; }
  std::size_t edge_count() const { return edges_.size(); }
  State initial() const { return initial_; }

  /// The edges out of a state, sorted by (label, target).
  std::span<const Edge> edges(State state) const {
    return {edges_.begin() + rows_[state.value], edges_.begin() + rows_[state.value + 1]};
  }
  /// The sub-run of `edges(state)` with one label.
  std::span<const Edge> edges(State state, Label label) const;
  /// Whether the state has no τ.
  bool is_stable(State state) const {
    const std::span<const Edge> row = edges(state);
    return row.empty() || row.front().label != tau;
  }

  const LabelNames& label_names() const { return *label_names_; }
  std::shared_ptr<const LabelNames> shared_label_names() const { return label_names_; }
  std::string_view name(Label label) const { return (*label_names_)[label.value]; }
  std::optional<Label> find_label(std::string_view name) const;

  /// The labels other than τ and ✓ that occur on some edge, in ascending order: the events that the
  /// process can perform, Alpha(M) of the Varanus paper's section "Varanus Overview".
  std::vector<Label> alphabet() const;

 private:
  friend class LtsBuilder;
  friend class LtsRowBuilder;
  Lts(base::GrowingArray<std::uint64_t> rows, base::GrowingArray<Edge> edges, State initial,
      std::shared_ptr<const LabelNames> label_names);

  base::GrowingArray<std::uint64_t> rows_;  // state_count() + 1 offsets into edges_
  base::GrowingArray<Edge> edges_;
  State initial_;
  std::shared_ptr<const LabelNames> label_names_;
};

/// O(states).
bool has_tau(const Lts& lts);

/// Collects edges in any order and finishes them into an `Lts`.
class LtsBuilder {
 public:
  explicit LtsBuilder(std::shared_ptr<const LabelNames> names) : label_names_(std::move(names)) {}

  State add_state() { return State{state_count_++}; }
  void add_states(std::uint32_t count) { state_count_ += count; }
  std::uint32_t state_count() const { return state_count_; }
  void add_edge(State source, Label label, State target);
  void reserve_edges(std::size_t count) { edges_.reserve(count); }

  /// Sorts, removes duplicate edges, and hands the graph over. `initial` must be a state.
  Lts finish(State initial) &&;

 private:
  struct SourcedEdge {
    State source;
    Edge edge;
  };

  std::vector<SourcedEdge> edges_;
  std::uint32_t state_count_ = 0;
  std::shared_ptr<const LabelNames> label_names_;
};

/// Takes the rows of states 0, 1, 2, ... one after the other, so that nothing but each row is
/// sorted: the builder of steps that finish one state before the next.
class LtsRowBuilder {
 public:
  LtsRowBuilder() { rows_.push_back(0); }

  /// Adds an edge to the row in hand.
  void add_edge(Label label, State target) { edges_.push_back({label, target}); }
  /// Sorts the row in hand, removes its duplicate edges, and begins the row of the next state.
  void end_row();
  /// The row of the next state in one step.
  void add_row(std::span<const Edge> edges);
  /// Drops the edges of the row in hand.
  void drop_row() { edges_.resize(rows_.back()); }

  /// The number of finished rows.
  std::size_t row_count() const { return rows_.size() - 1; }
  /// The edges in finished rows, and in the row in hand.
  std::size_t edge_count() const { return edges_.size(); }
  /// What the builder will hold at most while it takes one more row of `edges` edges.
  std::uint64_t peak_bytes(std::size_t edges) const;

  /// Hands the graph over. States beyond the finished rows have no edges. `initial` and all targets
  /// must be below `state_count`.
  Lts finish(State initial, std::size_t state_count, std::shared_ptr<const LabelNames> names) &&;

 private:
  base::GrowingArray<std::uint64_t> rows_;
  base::GrowingArray<Edge> edges_;
};

}  // namespace perentie::lts

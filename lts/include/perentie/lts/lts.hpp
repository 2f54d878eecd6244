// Labelled transition systems: the explicit, immutable graph that every analysis reads.
//
// States and labels are dense ids. Label 0 is τ, label 1 is ✓, events follow. The edges of a state are
// one run of a single array, sorted by (label, target) and free of duplicates, so the successors under
// one label are a sub-run. An `Lts` is made by an `LtsBuilder` and never changes afterwards.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

class Lts {
 public:
  std::size_t state_count() const { return rows_.size() - 1; }
  std::size_t edge_count() const { return edges_.size(); }
  State initial() const { return initial_; }

  /// The edges out of a state, sorted by (label, target).
  std::span<const Edge> edges(State state) const {
    return std::span<const Edge>(edges_).subspan(rows_[state.value],
                                                 rows_[state.value + 1] - rows_[state.value]);
  }
  /// The sub-run of `edges(state)` with one label.
  std::span<const Edge> edges(State state, Label label) const;

  const LabelNames& label_names() const { return *label_names_; }
  std::shared_ptr<const LabelNames> shared_label_names() const { return label_names_; }
  std::string_view name(Label label) const { return (*label_names_)[label.value]; }
  std::optional<Label> find_label(std::string_view name) const;

  /// The labels other than τ and ✓ that occur on some edge, in ascending order: the events that the
  /// process can perform, Alpha(M) of the Varanus paper's section "Varanus Overview".
  std::vector<Label> alphabet() const;

 private:
  friend class LtsBuilder;
  Lts() = default;

  std::vector<std::uint64_t> rows_;  // state_count() + 1 offsets into edges_
  std::vector<Edge> edges_;
  State initial_;
  std::shared_ptr<const LabelNames> label_names_;
};

/// Collects edges in any order and finishes them into an `Lts`.
class LtsBuilder {
 public:
  explicit LtsBuilder(std::shared_ptr<const LabelNames> names) : label_names_(std::move(names)) {}

  State add_state() { return State{state_count_++}; }
  void add_states(std::uint32_t count) { state_count_ += count; }
  std::uint32_t state_count() const { return state_count_; }
  void add_edge(State source, Label label, State target);

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

}  // namespace perentie::lts

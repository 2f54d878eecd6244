// MonitorTable: the deterministic automaton that monitors run, laid out for one look-up per event.
//
// Input is a deterministic LTS without τ (what normalisation makes of a process). Its alphabet is
// renumbered to consecutive `Event`s, so that a state's successors are one row indexed by event.
// Small tables are dense, with entries of two or four bytes; larger ones keep sorted rows and
// search them. Which layout is used never changes an answer. ✓ is a label like any other: a state
// reached by ✓ has an empty row. Immutable, so any number of monitors and threads share one table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "perentie/lts/lts.hpp"

namespace perentie::monitor {

/// An event of Alpha(M), numbered from 0 in the order of the labels. None: an event outside
/// Alpha(M).
using Event = base::Id<struct EventTag>;

/// A state of the deterministic automaton, the same as in the LTS it was made from. None: no state,
/// the Error of the Varanus paper's Definitions 1 and 2.
using lts::State;

enum class TableLayout : std::uint8_t { dense_2_byte, dense_4_byte, sorted_rows };

struct TableOptions {
  /// A dense table above this size becomes sorted rows.
  std::size_t max_dense_bytes = std::size_t{64} << 20U;
};

class MonitorTable {
 public:
  /// The table of `deterministic`, which must have no τ and at most one edge per state and label.
  static MonitorTable compile(const lts::Lts& deterministic, const TableOptions& options = {});
  /// The same with a layout of the caller's choice; `dense_2_byte` needs fewer than 65,535 states.
  static MonitorTable compile(const lts::Lts& deterministic, TableLayout layout);

  /// The successor of `state` under `event`, or none. Both must be of this table.
  State next(State state, Event event) const {
    if (layout_ == TableLayout::dense_2_byte) {
      const std::uint16_t target = entries_2_[cell(state, event)];
      return target == no_target_2 ? State{} : State{target};
    }
    if (layout_ == TableLayout::dense_4_byte) return State{entries_4_[cell(state, event)]};
    return search_row(state, event);
  }

  /// The events that `state` permits, ascending: Events(s) of the Varanus paper.
  std::vector<Event> enabled(State state) const;

  State initial() const { return initial_; }
  TableLayout layout() const { return layout_; }
  std::size_t state_count() const { return state_count_; }
  std::size_t event_count() const { return labels_.size(); }
  std::size_t memory_bytes() const;

  /// Alpha(M): the label of each event, ascending. Holds ✓ if the process can terminate.
  std::span<const lts::Label> alphabet() const { return labels_; }
  std::string_view name(Event event) const { return (*label_names_)[labels_[event.value].value]; }
  const lts::LabelNames& label_names() const { return *label_names_; }

 private:
  static constexpr std::uint16_t no_target_2 = 0xFFFF;

  MonitorTable() = default;

  std::size_t cell(State state, Event event) const {
    return std::size_t{state.value} * labels_.size() + event.value;
  }
  State search_row(State state, Event event) const;
  void fill_dense(const lts::Lts& deterministic, const std::vector<Event>& event_of);
  void fill_rows(const lts::Lts& deterministic, const std::vector<Event>& event_of);

  TableLayout layout_ = TableLayout::sorted_rows;
  State initial_;
  std::size_t state_count_ = 0;
  std::vector<lts::Label> labels_;
  std::shared_ptr<const lts::LabelNames> label_names_;

  std::vector<std::uint16_t> entries_2_;  // of the two dense layouts: row by row, none = all ones
  std::vector<std::uint32_t> entries_4_;
  std::vector<std::uint64_t> rows_;  // of sorted rows: state_count_ + 1 offsets into the other two
  std::vector<Event> row_events_;
  std::vector<State> row_targets_;
};

}  // namespace perentie::monitor

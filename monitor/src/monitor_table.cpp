#include "perentie/monitor/monitor_table.hpp"

#include "perentie/base/check.hpp"

namespace perentie::monitor {
namespace {

// The labels that occur, ascending. ✓ counts: to a monitor it is an observation like any other.
std::vector<lts::Label> occurring_labels(const lts::Lts& deterministic) {
  std::vector<bool> occurs(deterministic.label_names().size(), false);
  for (std::uint32_t s = 0; s < deterministic.state_count(); ++s) {
    const lts::Edge* previous = nullptr;
    for (const lts::Edge& edge : deterministic.edges(State{s})) {
      PERENTIE_CHECK(edge.label != lts::tau, "a monitor table from an LTS that has τ");
      PERENTIE_CHECK(previous == nullptr || previous->label != edge.label,
                     "a monitor table from a nondeterministic LTS");
      previous = &edge;
      occurs[edge.label.value] = true;
    }
  }
  std::vector<lts::Label> labels;
  for (std::uint32_t i = 0; i < occurs.size(); ++i) {
    if (occurs[i]) labels.push_back(lts::Label{i});
  }
  return labels;
}

TableLayout choose_layout(std::size_t states, std::size_t events, std::size_t max_dense_bytes) {
  const TableLayout dense = states < 0xFFFF ? TableLayout::dense_2_byte : TableLayout::dense_4_byte;
  const std::size_t entry = dense == TableLayout::dense_2_byte ? 2 : 4;
  if (events == 0 || states <= max_dense_bytes / entry / events) return dense;
  return TableLayout::sorted_rows;
}

}  // namespace

MonitorTable MonitorTable::compile(const lts::Lts& deterministic, const TableOptions& options) {
  return compile(deterministic,
                 choose_layout(deterministic.state_count(), occurring_labels(deterministic).size(),
                               options.max_dense_bytes));
}

MonitorTable MonitorTable::compile(const lts::Lts& deterministic, TableLayout layout) {
  PERENTIE_CHECK(layout != TableLayout::dense_2_byte || deterministic.state_count() < no_target_2,
                 "too many states for entries of two bytes");
  MonitorTable table;
  table.layout_ = layout;
  table.initial_ = deterministic.initial();
  table.state_count_ = deterministic.state_count();
  table.labels_ = occurring_labels(deterministic);
  table.label_names_ = deterministic.shared_label_names();

  std::vector<Event> event_of(deterministic.label_names().size());
  for (std::uint32_t e = 0; e < table.labels_.size(); ++e) {
    event_of[table.labels_[e].value] = Event{e};
  }
  if (layout == TableLayout::sorted_rows) {
    table.fill_rows(deterministic, event_of);
  } else {
    table.fill_dense(deterministic, event_of);
  }
  return table;
}

void MonitorTable::fill_dense(const lts::Lts& deterministic, const std::vector<Event>& event_of) {
  const std::size_t cells = state_count_ * labels_.size();
  const bool two_bytes = layout_ == TableLayout::dense_2_byte;
  if (two_bytes) {
    entries_2_.assign(cells, no_target_2);
  } else {
    entries_4_.assign(cells, State::none_value);
  }
  for (std::uint32_t s = 0; s < state_count_; ++s) {
    for (const lts::Edge& edge : deterministic.edges(State{s})) {
      const std::size_t at = cell(State{s}, event_of[edge.label.value]);
      if (two_bytes) {
        entries_2_[at] = static_cast<std::uint16_t>(edge.target.value);
      } else {
        entries_4_[at] = edge.target.value;
      }
    }
  }
}

void MonitorTable::fill_rows(const lts::Lts& deterministic, const std::vector<Event>& event_of) {
  rows_.reserve(state_count_ + 1);
  row_events_.reserve(deterministic.edge_count());
  row_targets_.reserve(deterministic.edge_count());
  rows_.push_back(0);
  for (std::uint32_t s = 0; s < state_count_; ++s) {
    // The edges come sorted by label, and events are numbered in the order of labels.
    for (const lts::Edge& edge : deterministic.edges(State{s})) {
      row_events_.push_back(event_of[edge.label.value]);
      row_targets_.push_back(edge.target);
    }
    rows_.push_back(row_events_.size());
  }
}

// Halves the row without branches that depend on the events, which cannot be predicted.
State MonitorTable::search_row(State state, Event event) const {
  std::size_t at = rows_[state.value];
  std::size_t length = rows_[state.value + 1] - at;
  if (length == 0) return State{};
  while (length > 1) {
    const std::size_t half = length / 2;
    at += row_events_[at + half] <= event ? half : 0;
    length -= half;
  }
  return row_events_[at] == event ? row_targets_[at] : State{};
}

std::vector<Event> MonitorTable::enabled(State state) const {
  if (layout_ == TableLayout::sorted_rows) {
    const auto begin = row_events_.begin();
    return {begin + static_cast<std::ptrdiff_t>(rows_[state.value]),
            begin + static_cast<std::ptrdiff_t>(rows_[state.value + 1])};
  }
  std::vector<Event> events;
  for (std::uint32_t e = 0; e < labels_.size(); ++e) {
    if (next(state, Event{e})) events.push_back(Event{e});
  }
  return events;
}

std::size_t MonitorTable::memory_bytes() const {
  return entries_2_.size() * sizeof(entries_2_[0]) + entries_4_.size() * sizeof(entries_4_[0]) +
         rows_.size() * sizeof(rows_[0]) + row_events_.size() * sizeof(row_events_[0]) +
         row_targets_.size() * sizeof(row_targets_[0]);
}

}  // namespace perentie::monitor

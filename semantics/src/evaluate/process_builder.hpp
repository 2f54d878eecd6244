// From evaluated operands to process terms: conversions of sets and pairs to events, and the
// simplifications that FDR's evaluator makes (CSPM reference 3.8.3).
#pragma once

#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "data_model.hpp"
#include "perentie/semantics/event.hpp"
#include "perentie/semantics/process.hpp"

namespace perentie::semantics {

/// A pair of a renaming or a link as written: possibly incomplete events.
using Tie = std::pair<ValueId, ValueId>;

class ProcessBuilder {
 public:
  ProcessBuilder(ValueStore& values, EventTable& events, ProcStore& processes,
                 const Resolution& resolution, const DataModel& data)
      : values_(values),
        events_(events),
        processes_(processes),
        resolution_(resolution),
        data_(data) {}

  EventId event(ValueId value);
  /// The events of a set of events; fails for other elements and for infinite sets.
  EventSetId event_set(ValueId set);

  ProcId event_set_prefix(ValueId set, ProcId body);
  ProcId binary(ProcKind kind, ProcId left, ProcId right);
  ProcId external_choice(std::span<const ProcId> operands);
  ProcId with_alphabet(ProcKind kind, ProcId left, ValueId set, ProcId right);
  ProcId alphabet_parallel(ProcId left, ValueId left_set, ValueId right_set, ProcId right);
  ProcId hide(ProcKind kind, ProcId operand, ValueId set);
  ProcId rename(ProcId operand, std::span<const Tie> ties);
  ProcId link_parallel(ProcId left, std::span<const Tie> ties, ProcId right);
  /// A replicated operator over its operands; `set` is the alphabet of those that have one. With
  /// `is_choice_of_fields`, a `|~|` of one operand is that operand (a `$` field).
  ProcId replicated(ProcKind kind, std::span<const ProcId> operands, ValueId set,
                    bool is_choice_of_fields);
  ProcId replicated_alphabet_parallel(std::span<const std::uint32_t> words) {
    return processes_.alphabet_parallel(words);
  }
  /// `P1 [l1] (P2 [l2] (.. Pn))` (4.4.4).
  ProcId replicated_link(std::span<const std::pair<std::vector<Tie>, ProcId>> operands);

  /// The arguments of a buffer with signals: a capacity, the signals, pairs of events (3.10.6).
  void check_buffer(std::span<const ValueId> arguments);

  ProcId prioritise(ProcId operand, ValueId order);
  ProcId prioritise_partial(ProcId operand, ValueId prioritised, ValueId order, ValueId maximal);

 private:
  std::vector<EventPair> event_pairs(std::span<const Tie> ties);
  std::string show_event(EventId event) const;

  ValueStore& values_;
  EventTable& events_;
  ProcStore& processes_;
  const Resolution& resolution_;
  const DataModel& data_;
  std::unordered_map<std::uint32_t, EventSetId> event_sets_;  // by the bits of the set's value
};

}  // namespace perentie::semantics

// Monitor: one system under analysis against one table, event by event.
//
// The next-state functions are those of the Varanus paper, Definitions 1 (strict) and 2
// (permissive). A monitor is a position in a shared table and a latch: copying one is cheap, and
// every session has its own. Nondeterministic and hidden behaviour needs no care here: a state of
// the table stands for the set of states that the process may be in.
#pragma once

#include <cstdint>
#include <vector>

#include "perentie/monitor/monitor_table.hpp"

namespace perentie::monitor {

enum class Mode : std::uint8_t {
  strict,      ///< the model is complete: an event outside Alpha(M) is a violation
  permissive,  ///< the model is partial: an event outside Alpha(M) is ignored
};

enum class Verdict : std::uint8_t {
  ok,         ///< the model permits the event, and has moved on
  ignored,    ///< the event is outside Alpha(M), and the mode is permissive
  violation,  ///< the model does not permit the event, or a violation is latched
};

/// What happens after a violation.
enum class AfterViolation : std::uint8_t {
  latch,  ///< every later event is a violation too, until `reset`
  stay,   ///< stay in the state before the violation and go on from there, as Varanus does online
  reset,  ///< go on from the initial state
};

/// next(s, e) of Definitions 1 and 2; none is Error. An `event` that is none is outside Alpha(M).
inline State next_state(const MonitorTable& table, Mode mode, State state, Event event) {
  if (event.is_none()) return mode == Mode::strict ? State{} : state;
  return table.next(state, event);
}

class Monitor {
 public:
  /// Starts in the initial state. The table must outlive the monitor.
  explicit Monitor(const MonitorTable& table, Mode mode,
                   AfterViolation after_violation = AfterViolation::latch)
      : table_(&table), state_(table.initial()), mode_(mode), after_violation_(after_violation) {}

  /// Takes one event of the system; none stands for every event outside Alpha(M).
  Verdict step(Event event) {
    if (violated_) return Verdict::violation;
    const State next = next_state(*table_, mode_, state_, event);
    if (next.is_none()) return violate();
    state_ = next;
    return event.is_none() ? Verdict::ignored : Verdict::ok;
  }

  /// True from a violation on, if violations are latched.
  bool violated() const { return violated_; }
  /// Where the model is. After a latched violation: where it was before the offending event.
  State state() const { return state_; }
  /// The events that the model permits in `state()`, ascending.
  std::vector<Event> expected() const { return table_->enabled(state_); }

  /// Back to the initial state, with no violation.
  void reset() {
    state_ = table_->initial();
    violated_ = false;
  }

  const MonitorTable& table() const { return *table_; }
  Mode mode() const { return mode_; }

 private:
  Verdict violate() {
    if (after_violation_ == AfterViolation::latch) violated_ = true;
    if (after_violation_ == AfterViolation::reset) state_ = table_->initial();
    return Verdict::violation;
  }

  const MonitorTable* table_;
  State state_;
  Mode mode_;
  AfterViolation after_violation_;
  bool violated_ = false;
};

}  // namespace perentie::monitor

// EventIndex: the text of an event in a trace to the event of the table.
//
// Events are looked up as they stand first. Systems do not always write events as CSPM prints them,
// so a text that is not found is looked up again in a normal form: without blanks around dots,
// commas and brackets (`foot_pedal_pressed. true`), and with the fields `True` and `False` as
// Python prints them in lower case. Numbers are not touched: `speed.38.0` is an event with two
// fields. ✓ may be written `✓`, or `tick` or `_tick` if the model has no event of that name.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "perentie/monitor/monitor_table.hpp"
#include "perentie/monitor/string_hash.hpp"

namespace perentie::monitor {

/// The normal form described above.
std::string normalise_event_text(std::string_view text);

class EventIndex {
 public:
  explicit EventIndex(const MonitorTable& table);

  /// The event that a text names; none if it is outside Alpha(M).
  Event find(std::string_view text) const {
    const auto found = events_.find(text);
    return found != events_.end() ? found->second : find_normalised(text);
  }

 private:
  Event find_normalised(std::string_view text) const;

  // Every label of the model; those that never occur map to none, so that no other reading is
  // tried.
  std::unordered_map<std::string, Event, StringHash, std::equal_to<>> events_;
};

}  // namespace perentie::monitor

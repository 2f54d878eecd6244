// EventMap: names of the system under analysis to names of the model (Varanus's event map).
//
// A flat JSON object such as {"velocity": "speed", "Green": "Radiation_Green"}. It renames the
// topics of simple messages, the values that a mapping sends through it, the channels of events in
// traces, and the channels of `common_alphabet`. A name that it does not have stays as it is.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "perentie/base/diagnostic.hpp"
#include "perentie/monitor/string_hash.hpp"

namespace perentie::monitor {

class EventMap {
 public:
  void add(std::string name, std::string model_name) {
    names_.insert_or_assign(std::move(name), std::move(model_name));
  }

  /// The model's name for `name`, or `name` itself.
  std::string_view operator()(std::string_view name) const {
    const auto found = names_.find(name);
    return found == names_.end() ? name : std::string_view(found->second);
  }

  /// An event with its channel renamed: the whole text if the map has it, otherwise the part before
  /// the first dot.
  std::string rename_event(std::string_view event) const;

  bool empty() const { return names_.empty(); }
  std::size_t size() const { return names_.size(); }

 private:
  std::unordered_map<std::string, std::string, StringHash, std::equal_to<>> names_;
};

/// Reads an event map from a file already in `sources`. None after diagnostics if it is not one.
std::optional<EventMap> parse_event_map(base::FileId file, const base::SourceMap& sources,
                                        base::Diagnostics& diagnostics);

/// Reads the file and parses it.
std::optional<EventMap> load_event_map(const std::string& path, base::SourceMap& sources,
                                       base::Diagnostics& diagnostics);

}  // namespace perentie::monitor

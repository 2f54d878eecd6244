// Which events of a model a list of channels means, and so which events the system does not show.
//
// Varanus's configs list the channels that the system shows; every other event is hidden before the
// monitor is made. The channel of an event is what stands before its first dot. An entry of the
// list may also be an event (`move.1`) or the beginning of one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/monitor/event_map.hpp"
#include "perentie/monitor/placed.hpp"

namespace perentie::monitor {

/// The names in the model's terms, each where it was given. None after a diagnostic for each name
/// that is of no declared channel.
std::optional<std::vector<std::string>> resolve_channels(std::span<const Placed<std::string>> names,
                                                         const EventMap* event_map,
                                                         std::span<const std::string> channels,
                                                         base::Diagnostics& diagnostics);

/// The labels, other than τ and ✓, that are of one of `names` (channels, events or their
/// beginnings, as `resolve_channels` gives them), ascending.
std::vector<lts::Label> labels_of_channels(const lts::LabelNames& labels,
                                           std::span<const std::string> names);

/// All other labels except τ and ✓: those to hide so that only `names` are seen.
std::vector<lts::Label> labels_not_of_channels(const lts::LabelNames& labels,
                                               std::span<const std::string> names);

}  // namespace perentie::monitor

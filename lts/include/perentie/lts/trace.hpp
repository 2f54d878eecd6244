// Paths through an Lts and the traces that they show.
//
// A path begins at the initial state and lists the edges taken, τ included; its trace is the
// sequence of its other labels (✓ is one of them). Paths found here have the least possible number
// of edges and are the same on every run.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

using Path = std::vector<Edge>;

/// A shortest path to a state for which `goal` is true; nothing if none can be reached.
std::optional<Path> shortest_path(const Lts& lts, const std::function<bool(State)>& goal);
/// The same among the paths whose trace is `trace`.
std::optional<Path> shortest_path(const Lts& lts, const std::function<bool(State)>& goal,
                                  std::span<const Label> trace);

/// The labels of a path, τ included.
std::vector<Label> labels_of(const Path& path);
/// The labels of a path without τ.
std::vector<Label> trace_of(const Path& path);
/// The state that a path ends in.
State end_of(const Lts& lts, const Path& path);

}  // namespace perentie::lts

// GraphML output of an Lts, for graph editors and libraries: nodes s0, s1, ...; the attribute
// `label` of an edge is its event, `initial` marks the initial node, `name` is what a state shows.
// Format: graphml.graphdrawing.org.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

struct GraphmlOptions {
  std::function<std::string(State)> state_name = {};  ///< none: no `name`
};

/// Errors are those of the stream. Control characters, which XML cannot hold, become U+FFFD.
void write_graphml(std::ostream& out, const Lts& lts, const GraphmlOptions& options = {});

}  // namespace perentie::lts

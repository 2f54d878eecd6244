// Graphviz (.dot) output: a picture of an Lts, sensible up to a few thousand states.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

struct DotOptions {
  std::function<std::string(State)> state_name = {};  ///< what nodes show; none: their numbers
};

/// States are nodes s0, s1, ...; an arrow from nowhere marks the initial state. Errors are those of
/// the stream.
void write_dot(std::ostream& out, const Lts& lts, const DotOptions& options = {});

}  // namespace perentie::lts

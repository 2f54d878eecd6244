// JSON output of an Lts, schema perentie.lts/1.
//
// One object: "schema", "initial" (a state), "states" (how many), "labels" (names; τ is number 0, ✓
// number 1, then those that occur), "transitions" ([source, label, target], sorted, one a line)
// and, if asked for, "state_names". It is written piece by piece, so size is no concern. Bytes that
// are not UTF-8 become U+FFFD.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

struct JsonOptions {
  std::function<std::string(State)> state_name = {};  ///< none: no "state_names"
};

/// Errors are those of the stream.
void write_json(std::ostream& out, const Lts& lts, const JsonOptions& options = {});

}  // namespace perentie::lts

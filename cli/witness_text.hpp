// Counterexamples in sentences.
#pragma once

#include <string>
#include <vector>

#include "perentie/semantics/check.hpp"

namespace perentie::cli {

/// `{a, b}`.
std::string set_of(const std::vector<std::string>& events);
/// `<a, τ, b>`.
std::string trace_of(const std::vector<std::string>& events);
/// What the process does after the trace that it must not do: "it performs c".
std::string behaviour_of(const semantics::Witness& witness);
/// In R, what was seen to be offered on the way: "offering only {a} after <>", one each line.
std::vector<std::string> observations_of(const semantics::Witness& witness);
/// What would have been right, or nothing: "the specification allows {d}".
std::string expectation_of(const semantics::Witness& witness);

}  // namespace perentie::cli

// The whole of an analysis against the oracles, for one graph: shared by the random and the
// exhaustive tests. Every function returns what is wrong, or nothing.
#pragma once

#include <cstddef>
#include <string>

#include "perentie/lts/determinism.hpp"
#include "perentie/lts/lts.hpp"

namespace perentie::test {

/// The normal form against the definition, for all traces of at most `depth` labels.
std::string wrong_in_normal_form(const lts::Lts& lts, std::size_t depth);
/// Verdict and witness of the determinism check. A witness longer than `depth` must only be valid.
std::string wrong_in_determinism(const lts::Lts& lts, lts::DeterminismModel model,
                                 std::size_t depth);
std::string wrong_in_divergence(const lts::Lts& lts);

}  // namespace perentie::test

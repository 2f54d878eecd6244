// Whether a compression kept traces, failures and divergences, by definition, for small graphs.
// Every function returns what is wrong, or nothing.
#pragma once

#include <cstddef>
#include <string>

#include "perentie/lts/generalised_lts.hpp"
#include "perentie/lts/lts.hpp"

namespace perentie::test {

/// After every trace of at most `depth` labels: the same next labels, minimal acceptances and
/// divergence. Failures and divergences are compared also after a divergence: compressions keep
/// more than the failures-divergences model asks for.
std::string wrong_in_compression(const lts::Lts& original, const lts::Lts& result,
                                 std::size_t depth);
std::string wrong_in_compression(const lts::Lts& original, const lts::GeneralisedLts& result,
                                 std::size_t depth);

}  // namespace perentie::test

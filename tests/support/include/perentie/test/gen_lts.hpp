// rapidcheck generator of small LTSs. Failing cases print as `lts_from` texts.
#pragma once

#include <rapidcheck.h>
#include <cstdint>
#include <string>
#include <vector>

#include "perentie/test/lts_text.hpp"

namespace perentie::test {

struct LtsShape {
  std::uint32_t max_states = 6;
  std::vector<std::string> events = {"a", "b"};
  /// Among the labels of edges, τ and ✓ are as frequent as this many events each.
  std::uint32_t tau_weight = 1;
  std::uint32_t tick_weight = 1;
};

/// LTSs with 1 to `max_states` states, up to about two edges a state, all kinds of loops, and some
/// unreachable states. Shrinks towards fewer edges and states.
rc::Gen<lts::Lts> arbitrary_lts(LtsShape shape = {});

}  // namespace perentie::test

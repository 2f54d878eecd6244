// deterministic_extraction: a process that is deterministic as long as it does not diverge, and
// whose behaviours are among those of the original.
//
// Every state follows one τ as long as there is one, and keeps one successor for each label that is
// left: always the first in the order of the edges. ✓ is a label like any other. States whose τ
// never end become one state with nothing but a τ to itself. So the original is deterministic in
// failures-divergences iff the result does not diverge and the original refines it (CSPM reference
// 4.6.4, 5.3.4; Roscoe, *Understanding Concurrent Systems*, on FDR's check of determinism).
#pragma once

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

/// FDR's `deter`. Numbered breadth first; never more than one state more than the original.
/// O(states + edges).
Lts deterministic_extraction(const Lts& lts);

}  // namespace perentie::lts

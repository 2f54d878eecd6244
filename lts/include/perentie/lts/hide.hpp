// hide: some events of an Lts become τ.
//
// The states and the label table stay as they are; rows are sorted again and edges that became
// equal are merged. τ and ✓ are no events: no set of hidden or kept events concerns them (CSPM
// reference 4.1.1, 4.2).
#pragma once

#include <functional>
#include <span>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

/// P \ A, where A holds the events for which `hidden` is true. Each label is asked about once.
Lts hide_if(const Lts& lts, const std::function<bool(Label)>& hidden);
/// P \ A.
Lts hide(const Lts& lts, std::span<const Label> hidden);
/// P |\ A: everything but A is hidden (FDR's project).
Lts project(const Lts& lts, std::span<const Label> kept);

}  // namespace perentie::lts

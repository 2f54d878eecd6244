// The strongly connected components of the τ edges of an Lts.
#pragma once

#include <cstdint>
#include <vector>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

struct TauComponents {
  /// By state: its component. τ leads from a component only to itself and to lower numbers.
  std::vector<std::uint32_t> of;
  std::uint32_t count = 0;
};

TauComponents tau_components(const Lts& lts);

}  // namespace perentie::lts

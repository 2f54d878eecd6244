// The strongly connected components of the τ edges of an Lts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

struct TauComponents {
  /// By state: its component. τ leads from a component only to itself and to lower numbers.
  std::vector<std::uint32_t> of;
  /// The states by component, those of one ascending.
  std::vector<std::uint32_t> states;
  /// By component, where its states begin; one entry more than there are components.
  std::vector<std::uint32_t> begin;

  std::size_t count() const { return begin.size() - 1; }
  std::span<const std::uint32_t> members(std::uint32_t component) const {
    return std::span(states).subspan(begin[component], begin[component + 1] - begin[component]);
  }
};

/// O(states + edges).
TauComponents tau_components(const Lts& lts);

}  // namespace perentie::lts

// The strongly connected components of any directed graph.
#pragma once

#include <cstdint>
#include <vector>

namespace perentie::lts {

/// `successors[v]` are the vertices that v leads to. The components come in an order in which each
/// is after all that it leads to; the vertices of each are in ascending order.
std::vector<std::vector<std::uint32_t>> strong_components(
    const std::vector<std::vector<std::uint32_t>>& successors);

}  // namespace perentie::lts

// Whether a partition is a strong bisimulation: the exact check behind hashed signatures.
#pragma once

#include <cstdint>
#include <span>

#include "partition.hpp"
#include "perentie/lts/lts.hpp"

namespace perentie::lts {

/// Whether any two states of a block lead with the same labels to the same blocks.
bool is_stable(const Lts& lts, const Partition& partition);
/// Whether states of different classes are in different blocks.
bool parts(const Partition& partition, std::span<const std::uint32_t> classes);

}  // namespace perentie::lts

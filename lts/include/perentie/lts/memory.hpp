// What growing containers will hold at the peak of their growth, so that a memory budget is kept
// before the memory is taken, not noticed after.
//
// A vector that outgrows its block holds the old block and the used part of the new one at the same
// time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "perentie/base/growing_array.hpp"

namespace perentie::lts {

/// The bytes in use, at the peak, while `more` elements are appended.
template <class T>
std::uint64_t peak_bytes(const std::vector<T>& vector, std::size_t more) {
  const std::size_t size = vector.size() + more;
  const std::size_t moved = size > vector.capacity() ? vector.size() : 0;
  return (static_cast<std::uint64_t>(size) + moved) * sizeof(T);
}

/// The same: a growing array never holds two blocks.
template <class T>
std::uint64_t peak_bytes(const base::GrowingArray<T>& array, std::size_t more) {
  return (static_cast<std::uint64_t>(array.size()) + more) * sizeof(T);
}

}  // namespace perentie::lts

// UniqueIndex: the hash table behind hash-consing.
//
// It maps the content of an element to the element's 32-bit index in storage that the caller owns.
// The table holds indices and half of their hashes (open addressing, linear probing, load at most
// 1/2), so the elements live once, append-only, in their store, and are hardly ever looked at to
// find that they are others. Hash and equality come from the caller at each call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "perentie/base/check.hpp"
#include "perentie/base/growing_array.hpp"

namespace perentie::base {

class UniqueIndex {
 public:
  /// Where `find_or_insert` found the element, and whether it was absent before.
  struct Result {
    std::uint32_t index;
    bool inserted;
  };

  /// Looks for an element with this hash for which `equal(index)` holds. If there is none, inserts
  /// `next_index`, which the caller then appends to its store: indices are 0, 1, 2, ... in order of
  /// insertion.
  template <class Equal>
  Result find_or_insert(std::uint64_t hash, std::uint32_t next_index, Equal equal) {
    if ((size_ + 1) * 2 > slots_.size()) grow();
    const auto half = static_cast<std::uint32_t>(hash);
    std::size_t slot = half & mask();
    for (; slots_[slot].index != no_index; slot = (slot + 1) & mask()) {
      if (slots_[slot].hash == half && equal(slots_[slot].index))
        return {slots_[slot].index, false};
    }
    PERENTIE_CHECK(next_index == size_, "an element is not numbered in order of insertion");
    slots_[slot] = {next_index, half};
    ++size_;
    return {next_index, true};
  }

  std::size_t size() const { return size_; }
  std::size_t memory_bytes() const { return slots_.capacity() * sizeof(Slot); }
  /// The bytes in use, at the peak, while `more` elements are inserted: a table that grows is there
  /// twice.
  std::uint64_t peak_bytes(std::size_t more) const {
    const std::size_t needed = 2 * (size_ + more);
    if (needed <= slots_.size()) return slots_.size() * sizeof(Slot);
    std::size_t slot_count = larger(slots_.size());
    while (slot_count < needed) slot_count = larger(slot_count);
    return (slot_count + slot_count / 2) * sizeof(Slot);
  }

 private:
  static constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

  struct Slot {
    std::uint32_t index = no_index;
    std::uint32_t hash = 0;  // its lower half
  };

  static std::size_t larger(std::size_t slot_count) {
    return slot_count == 0 ? 64 : slot_count * 2;
  }
  std::size_t mask() const { return slots_.size() - 1; }

  void grow() {
    const GrowingArray<Slot> old = std::exchange(slots_, {});
    slots_.resize(larger(old.size()));
    PERENTIE_CHECK(mask() <= no_index, "half a hash is too short for the table");
    for (const Slot& element : old) {
      if (element.index == no_index) continue;
      std::size_t slot = element.hash & mask();
      while (slots_[slot].index != no_index) slot = (slot + 1) & mask();
      slots_[slot] = element;
    }
  }

  GrowingArray<Slot> slots_;
  std::size_t size_ = 0;
};

}  // namespace perentie::base

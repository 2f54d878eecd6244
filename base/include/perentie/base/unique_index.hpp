// UniqueIndex: the hash table behind hash-consing.
//
// It maps the content of an element to the element's 32-bit index in storage that the caller owns.
// The table holds only indices (open addressing, linear probing, load at most 1/2), so the elements
// live once, append-only, in their store. Hash and equality come from the caller at each call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

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
  /// insertion. `rehash(index)` recomputes an element's hash when the table grows.
  template <class Equal, class Rehash>
  Result find_or_insert(std::uint64_t hash, std::uint32_t next_index, Equal equal, Rehash rehash) {
    if ((size_ + 1) * 2 > slots_.size()) grow(rehash);
    std::size_t slot = hash & mask();
    for (; slots_[slot] != empty_slot; slot = (slot + 1) & mask()) {
      if (equal(slots_[slot])) return {slots_[slot], false};
    }
    PERENTIE_CHECK(next_index == size_, "an element is not numbered in order of insertion");
    slots_[slot] = next_index;
    ++size_;
    return {next_index, true};
  }

  std::size_t size() const { return size_; }
  std::size_t memory_bytes() const { return slots_.capacity() * sizeof(std::uint32_t); }

 private:
  static constexpr std::uint32_t empty_slot = std::numeric_limits<std::uint32_t>::max();

  std::size_t mask() const { return slots_.size() - 1; }

  // Goes through the elements in their order, which is kind to the cache, and needs no old table.
  template <class Rehash>
  void grow(Rehash rehash) {
    const std::size_t slot_count = slots_.empty() ? 64 : slots_.size() * 2;
    slots_ = {};
    slots_.resize(slot_count, empty_slot);
    for (std::uint32_t index = 0; index < size_; ++index) {
      std::size_t slot = rehash(index) & mask();
      while (slots_[slot] != empty_slot) slot = (slot + 1) & mask();
      slots_[slot] = index;
    }
  }

  GrowingArray<std::uint32_t> slots_;
  std::size_t size_ = 0;
};

}  // namespace perentie::base

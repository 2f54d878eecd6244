// ClaimIndex: the hash table of a visited set, in which several threads can look and insert at
// once.
//
// It holds only numbers (open addressing, linear probing, load at most 1/2), four bytes each; the
// elements live with the caller. An element has the least number that was ever claimed for it,
// whatever the order of the claims was.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "perentie/base/growing_array.hpp"
#include "perentie/lts/workers.hpp"

namespace perentie::lts {

class ClaimIndex {
 public:
  /// Makes room for `count` elements, of which the table has 0, ..., `size` - 1 now.
  /// `hash_of(number)` recomputes their hashes if it grows. No thread may claim meanwhile.
  template <class HashOf>
  void reserve(std::size_t count, std::size_t size, HashOf hash_of, Workers& workers) {
    if (2 * count <= slots_.size()) return;
    const std::size_t slot_count = slots_for(count);
    slots_ = {};
    slots_.resize_for_overwrite(slot_count);
    const auto share = [&](std::size_t items, unsigned worker) {
      return items * worker / workers.count();
    };
    workers.run([&](unsigned w) {
      std::fill(&slots_[0] + share(slot_count, w), &slots_[0] + share(slot_count, w + 1), empty);
    });
    workers.run([&](unsigned w) {
      for (std::size_t i = share(size, w); i < share(size, w + 1); ++i) {
        claim(hash_of(i), static_cast<std::uint32_t>(i), [](std::uint32_t) { return false; });
      }
    });
  }

  /// Claims `number` for an element, and returns its place. `is_same(other)` says whether the
  /// element is the one that `other` was claimed for; it is asked for some of those with an equal
  /// hash and some others. There must be room.
  template <class IsSame>
  std::size_t claim(std::uint64_t hash, std::uint32_t number, IsSame is_same) {
    for (std::size_t place = hash & mask();; place = (place + 1) & mask()) {
      const std::atomic_ref slot(slots_[place]);
      std::uint32_t other = slot.load(std::memory_order_relaxed);
      if (other == empty &&
          slot.compare_exchange_strong(other, number, std::memory_order_relaxed)) {
        return place;
      }
      if (!is_same(other)) continue;
      while (number < other &&
             !slot.compare_exchange_weak(other, number, std::memory_order_relaxed)) {
      }
      return place;
    }
  }

  /// The number of the element at a place. It may change as long as others claim.
  std::uint32_t number(std::size_t place) { return at(place).load(std::memory_order_relaxed); }
  /// Gives the element at a place another number.
  void set_number(std::size_t place, std::uint32_t number) {
    at(place).store(number, std::memory_order_relaxed);
  }

  /// Begins to fetch the place of a hash into the cache, for a claim that comes soon.
  void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & mask()]); }
  /// The number at the place of a hash, which a claim will compare first; nothing: the place is
  /// free.
  std::optional<std::uint32_t> candidate(std::uint64_t hash) {
    const std::uint32_t found = number(hash & mask());
    return found == empty ? std::nullopt : std::optional(found);
  }

  /// The bytes of a table with room for `count` elements, if it has at least the present one.
  std::uint64_t bytes_for(std::size_t count) const {
    return std::max(slots_.size(), slots_for(count)) * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::uint32_t empty = std::numeric_limits<std::uint32_t>::max();

  std::atomic_ref<std::uint32_t> at(std::size_t place) { return std::atomic_ref(slots_[place]); }
  std::size_t mask() const { return slots_.size() - 1; }

  // A power of two.
  static std::size_t slots_for(std::size_t count) {
    std::size_t slots = 64;
    while (slots < 2 * count) slots *= 2;
    return slots;
  }

  base::GrowingArray<std::uint32_t> slots_;
};

}  // namespace perentie::lts

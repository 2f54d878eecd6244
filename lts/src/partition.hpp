// Partition: blocks of numbers 0 .. n-1 that are split, never merged.
//
// The elements of a block are one run of a permutation, so a split costs time in the elements that
// move. When a block is split its largest part keeps the block's number; hence the number of an
// element changes at most log2(n) times (Hopcroft 1971).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perentie/base/growing_array.hpp"

namespace perentie::lts {

class Partition {
 public:
  /// A new block and the block that it was split from.
  struct Split {
    std::uint32_t block;
    std::uint32_t from;
  };

  /// All elements in block 0.
  explicit Partition(std::uint32_t size);

  std::uint32_t block_count() const { return static_cast<std::uint32_t>(blocks_.size()); }
  std::uint32_t block_of(std::uint32_t element) const { return block_of_[element]; }
  std::span<const std::uint32_t> members(std::uint32_t block) const {
    return {elements_.begin() + blocks_[block].begin, elements_.begin() + blocks_[block].end};
  }
  std::uint32_t size_of(std::uint32_t block) const {
    return blocks_[block].end - blocks_[block].begin;
  }

  /// Splits every block so that elements with different keys part. `changed` lists, each once, the
  /// elements whose keys may differ from those of their block; the others of a block have one key
  /// in common. Appends the new blocks to `splits`.
  void split(std::span<const std::uint32_t> changed, std::span<const std::uint64_t> keys,
             std::vector<Split>& splits);

 private:
  struct Block {
    std::uint32_t begin;
    std::uint32_t end;
    std::uint32_t changed_end;  // the changed elements are in front
  };
  struct Slot {
    std::uint64_t key;
    std::uint32_t part;
  };

  void move_to_front(std::uint32_t element);
  void split_block(std::uint32_t block, std::span<const std::uint64_t> keys,
                   std::vector<Split>& splits);
  void find_parts(const Block& block, std::span<const std::uint64_t> keys);
  void arrange_parts(const Block& block);

  base::GrowingArray<std::uint32_t> elements_;
  base::GrowingArray<std::uint32_t> position_;  // by element: where it is in elements_
  base::GrowingArray<std::uint32_t> block_of_;
  base::GrowingArray<Block> blocks_;

  // Scratch of one split.
  std::vector<std::uint32_t> touched_;     // blocks with changed elements
  std::vector<Slot> slots_;                // key -> part
  std::vector<std::uint32_t> part_of_;     // by place among the changed
  std::vector<std::uint32_t> part_begin_;  // by part; the last entry is the end
  std::vector<std::uint32_t> moved_;
};

}  // namespace perentie::lts

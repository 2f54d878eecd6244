#include "partition.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace perentie::lts {

namespace {

constexpr std::uint32_t free_slot = ~std::uint32_t{0};

}  // namespace

Partition::Partition(std::uint32_t size) {
  elements_.resize_for_overwrite(size);
  position_.resize_for_overwrite(size);
  block_of_.resize(size, 0);
  std::iota(elements_.begin(), elements_.end(), 0U);
  std::iota(position_.begin(), position_.end(), 0U);
  if (size > 0) blocks_.push_back({0, size, 0});
}

void Partition::move_to_front(std::uint32_t element) {
  Block& block = blocks_[block_of_[element]];
  if (block.changed_end == block.begin) touched_.push_back(block_of_[element]);
  const std::uint32_t from = position_[element];
  const std::uint32_t to = block.changed_end++;
  const std::uint32_t other = elements_[to];
  elements_[from] = other;
  position_[other] = from;
  elements_[to] = element;
  position_[element] = to;
}

void Partition::split(std::span<const std::uint32_t> changed, std::span<const std::uint64_t> keys,
                      std::vector<Split>& splits) {
  touched_.clear();
  for (const std::uint32_t element : changed) {
    if (size_of(block_of_[element]) > 1) move_to_front(element);
  }
  for (const std::uint32_t block : touched_) split_block(block, keys, splits);
}

/// Numbers the keys of the changed elements in order of appearance. Part 0 is that of the elements
/// that did not change, if there are any. Leaves the sizes of the parts in `part_begin_`.
void Partition::find_parts(const Block& block, std::span<const std::uint64_t> keys) {
  const std::uint32_t changed = block.changed_end - block.begin;
  const std::size_t slot_count = std::bit_ceil(std::size_t{changed} * 2 + 2);
  if (slots_.size() < slot_count) slots_.resize(slot_count);
  std::fill_n(slots_.begin(), slot_count, Slot{0, free_slot});
  part_begin_.clear();
  const auto part_of_key = [&](std::uint64_t key) {
    std::size_t at = key & (slot_count - 1);
    while (slots_[at].part != free_slot && slots_[at].key != key) at = (at + 1) & (slot_count - 1);
    if (slots_[at].part == free_slot) {
      slots_[at] = {key, static_cast<std::uint32_t>(part_begin_.size())};
      part_begin_.push_back(0);
    }
    return slots_[at].part;
  };

  if (block.changed_end < block.end) {
    part_of_key(keys[elements_[block.changed_end]]);
    part_begin_[0] = block.end - block.changed_end;
  }
  part_of_.resize(changed);
  for (std::uint32_t i = 0; i < changed; ++i) {
    part_of_[i] = part_of_key(keys[elements_[block.begin + i]]);
    ++part_begin_[part_of_[i]];
  }
}

/// Puts the elements in order of their parts, part 0 last, next to its elements that did not
/// change. Turns sizes into places in `part_begin_`, where part 0 comes after the last.
void Partition::arrange_parts(const Block& block) {
  std::uint32_t at = block.begin;
  for (std::size_t part = 1; part < part_begin_.size(); ++part) {
    at += std::exchange(part_begin_[part], at);
  }
  part_begin_[0] = at;
  moved_.assign(elements_.begin() + block.begin, elements_.begin() + block.changed_end);
  std::vector<std::uint32_t>& next = part_begin_;
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    const std::uint32_t to = next[part_of_[i]]++;
    elements_[to] = moved_[i];
    position_[moved_[i]] = to;
  }
}

void Partition::split_block(std::uint32_t number, std::span<const std::uint64_t> keys,
                            std::vector<Split>& splits) {
  const Block block = blocks_[number];
  find_parts(block, keys);
  blocks_[number].changed_end = block.begin;
  const std::size_t part_count = part_begin_.size();
  if (part_count == 1) return;

  const std::size_t largest = static_cast<std::size_t>(
      std::max_element(part_begin_.begin(), part_begin_.end()) - part_begin_.begin());
  arrange_parts(block);
  // Now `part_begin_[part]` is the end of the part, but for the unchanged elements of part 0.
  std::uint32_t begin = block.begin;
  for (std::size_t i = 1; i <= part_count; ++i) {
    const std::size_t part = i % part_count;
    const std::uint32_t end = part == 0 ? block.end : part_begin_[part];
    if (part == largest) {
      blocks_[number] = {begin, end, begin};
    } else {
      const std::uint32_t fresh = block_count();
      blocks_.push_back({begin, end, begin});
      for (std::uint32_t at = begin; at < end; ++at) block_of_[elements_[at]] = fresh;
      splits.push_back({fresh, number});
    }
    begin = end;
  }
}

}  // namespace perentie::lts

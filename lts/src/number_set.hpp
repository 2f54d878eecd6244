// NumberSet: a set of numbers below a bound whose least one is taken, all in a few steps.
//
// A bit for each number, and above each 64 bits one that says whether any is set: as many levels
// as it takes to end in one word.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace perentie::lts {

class NumberSet {
 public:
  /// The empty set; its numbers are to be below `bound`.
  explicit NumberSet(std::uint32_t bound) {
    std::size_t words = bound;
    do {
      words = (words + 63) / 64;
      levels_.emplace_back(words, 0);
    } while (words > 1);
  }

  bool empty() const { return levels_.back().empty() || levels_.back().front() == 0; }

  void insert(std::uint32_t number) {
    for (std::vector<std::uint64_t>& level : levels_) {
      std::uint64_t& word = level[number / 64];
      const bool was_empty = word == 0;
      word |= std::uint64_t{1} << (number % 64);
      if (!was_empty) return;
      number /= 64;
    }
  }

  /// Removes the least number, which there must be.
  std::uint32_t take_least() {
    std::uint32_t least = 0;
    for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
      least = least * 64 + static_cast<std::uint32_t>(std::countr_zero((*level)[least]));
    }
    std::uint32_t number = least;
    for (std::vector<std::uint64_t>& level : levels_) {
      std::uint64_t& word = level[number / 64];
      word &= word - 1;  // nothing below it is set
      if (word != 0) break;
      number /= 64;
    }
    return least;
  }

 private:
  std::vector<std::vector<std::uint64_t>> levels_;  // the last is one word
};

}  // namespace perentie::lts

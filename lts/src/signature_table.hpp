// SignatureTable: sorted sequences of 64-bit words, each kept once, by number.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "perentie/base/hash.hpp"
#include "perentie/base/unique_index.hpp"
#include "perentie/lts/runs.hpp"

namespace perentie::lts {

class SignatureTable {
 public:
  /// The number of a sequence, known or new.
  std::uint32_t add(std::span<const std::uint64_t> words) {
    const auto result = index_.find_or_insert(
        hash(words), static_cast<std::uint32_t>(runs_.size()),
        [&](std::uint32_t other) { return std::ranges::equal(runs_[other], words); },
        [&](std::uint32_t other) { return hash(runs_[other]); });
    if (result.inserted) runs_.add(words);
    return result.index;
  }

  std::span<const std::uint64_t> operator[](std::uint32_t number) const { return runs_[number]; }
  std::size_t size() const { return runs_.size(); }
  std::uint64_t peak_bytes(std::size_t length) const {
    return runs_.peak_bytes(length) + lts::peak_bytes(index_, 1);
  }

 private:
  static std::uint64_t hash(std::span<const std::uint64_t> words) {
    std::uint64_t hash = base::hash_mix(0, words.size());
    for (const std::uint64_t word : words) hash = base::hash_mix(hash, word);
    return hash;
  }

  Runs<std::uint64_t> runs_;
  base::UniqueIndex index_;
};

}  // namespace perentie::lts

// Runs: many short sequences in one block, by number; UniqueRuns: the same, each sequence once.
//
// Sets of states and sets of labels are such sequences, sorted. Appending copies the elements, and
// the span of a run is not valid after the next one has been added.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>

#include "perentie/base/growing_array.hpp"
#include "perentie/base/hash.hpp"
#include "perentie/base/unique_index.hpp"
#include "perentie/lts/memory.hpp"

namespace perentie::lts {

template <class T>
class Runs {
 public:
  void add(std::span<const T> run) {
    items_.append(run);
    ends_.push_back(items_.size());
  }

  std::span<const T> operator[](std::size_t i) const {
    const std::uint64_t begin = i == 0 ? 0 : ends_[i - 1];
    return {items_.begin() + begin, static_cast<std::size_t>(ends_[i] - begin)};
  }

  std::size_t size() const { return ends_.size(); }
  /// The memory at most in use while one more run of `length` elements is added.
  std::uint64_t peak_bytes(std::size_t length) const {
    return lts::peak_bytes(ends_, 1) + lts::peak_bytes(items_, length);
  }

 private:
  base::GrowingArray<std::uint64_t> ends_;
  base::GrowingArray<T> items_;
};

/// Runs are numbered by `IdT`, a `base::Id`, in order of first appearance.
template <class IdT, class T>
class UniqueRuns {
  static_assert(std::has_unique_object_representations_v<T>, "elements are hashed as bytes");
  static_assert(sizeof(T) == 4 || sizeof(T) == 8);

 public:
  /// The number of a run, known or new; `none` if it is new and there are `max` runs already, and
  /// then no further run may be added.
  IdT add(std::span<const T> run, std::uint64_t max = IdT::none_value) {
    const auto result = index_.find_or_insert(
        hash(run), static_cast<std::uint32_t>(runs_.size()),
        [&](std::uint32_t other) { return std::ranges::equal(runs_[other], run); });
    if (result.inserted) {
      if (runs_.size() >= max) return IdT{};
      runs_.add(run);
    }
    return IdT{result.index};
  }

  std::span<const T> operator[](IdT id) const { return runs_[id.value]; }
  std::size_t size() const { return runs_.size(); }
  std::uint64_t peak_bytes(std::size_t length) const {
    return runs_.peak_bytes(length) + index_.peak_bytes(1);
  }
  Runs<T> take() && { return std::move(runs_); }

 private:
  static std::uint64_t hash(std::span<const T> run) {
    auto bytes = std::as_bytes(run);
    std::uint64_t hash = base::hash_mix(0, run.size());
    for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
      hash = base::hash_mix(hash, word<std::uint64_t>(bytes));
    }
    return bytes.empty() ? hash : base::hash_mix(hash, word<std::uint32_t>(bytes));
  }
  template <class Word>
  static Word word(std::span<const std::byte> bytes) {
    Word word;
    std::memcpy(&word, bytes.data(), sizeof word);
    return word;
  }

  Runs<T> runs_;
  base::UniqueIndex index_;
};

}  // namespace perentie::lts

// TermTable: hash-consed terms. A term is a tag and a run of 32-bit words (ids, mostly).
//
// Interning the same tag and words twice gives the same index, so equality of terms is equality of
// indices and a memo table is a vector. Terms are append-only and live as long as the table.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "perentie/base/hash.hpp"
#include "perentie/base/unique_index.hpp"

namespace perentie::base {

class TermTable {
 public:
  /// The index of the term. `words` may lie inside this table.
  std::uint32_t intern(std::uint8_t tag, std::span<const std::uint32_t> words) {
    const auto next = static_cast<std::uint32_t>(heads_.size());
    const auto result = index_.find_or_insert(hash_words(words, tag), next,
                                              [&](std::uint32_t i) { return is(i, tag, words); });
    if (result.inserted) append(tag, words);
    return result.index;
  }
  std::uint32_t intern(std::uint8_t tag, std::initializer_list<std::uint32_t> words) {
    return intern(tag, std::span<const std::uint32_t>(words.begin(), words.size()));
  }

  std::uint8_t tag(std::uint32_t term) const { return heads_[term].tag; }
  /// Not valid after the next `intern`.
  std::span<const std::uint32_t> words(std::uint32_t term) const {
    const Head& head = heads_[term];
    return std::span<const std::uint32_t>(words_).subspan(head.first, head.count);
  }

  std::size_t size() const { return heads_.size(); }
  std::size_t memory_bytes() const {
    return heads_.capacity() * sizeof(Head) + words_.capacity() * sizeof(std::uint32_t) +
           index_.memory_bytes();
  }

 private:
  struct Head {
    std::uint64_t first;
    std::uint32_t count;
    std::uint8_t tag;
  };

  bool is(std::uint32_t term, std::uint8_t tag, std::span<const std::uint32_t> words) const {
    const std::span<const std::uint32_t> own = this->words(term);
    return heads_[term].tag == tag &&
           std::equal(own.begin(), own.end(), words.begin(), words.end());
  }

  void append(std::uint8_t tag, std::span<const std::uint32_t> words) {
    const std::size_t first = words_.size();
    // The words may be our own, which growing would move: reserve before, and copy by position.
    const bool own = !words.empty() && words.data() >= words_.data() &&
                     words.data() < words_.data() + words_.size();
    const std::size_t from = own ? static_cast<std::size_t>(words.data() - words_.data()) : 0;
    words_.resize(first + words.size());
    const std::uint32_t* source = own ? words_.data() + from : words.data();
    std::copy_n(source, words.size(), words_.data() + first);
    heads_.push_back({first, static_cast<std::uint32_t>(words.size()), tag});
  }

  std::vector<Head> heads_;
  std::vector<std::uint32_t> words_;
  UniqueIndex index_;
};

}  // namespace perentie::base

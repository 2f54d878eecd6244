// GrowingArray: a vector for very many plain elements.
//
// It differs from std::vector where gigabytes make a difference: large blocks grow where they are,
// or move without a copy, so there is never a second block; and they ask for huge pages, without
// which most random reads of a large block also miss the cache of page addresses.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace perentie::base {

/// A block of `new_bytes` bytes, more than before, that begins with the old one, which is gone;
/// nullptr and 0 stand for no block. Throws std::bad_alloc, and then the old block is still there.
void* grow_block(void* block, std::size_t old_bytes, std::size_t new_bytes);
void free_block(void* block, std::size_t bytes);

template <class T>
class GrowingArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  GrowingArray() = default;
  GrowingArray(GrowingArray&& other) noexcept { swap(other); }
  GrowingArray& operator=(GrowingArray&& other) noexcept {
    GrowingArray taken(std::move(other));
    swap(taken);
    return *this;
  }
  GrowingArray(const GrowingArray& other) { append({other.begin(), other.size()}); }
  GrowingArray& operator=(const GrowingArray& other) {
    GrowingArray copy(other);
    swap(copy);
    return *this;
  }
  ~GrowingArray() { free_block(items_, capacity_ * sizeof(T)); }

  /// Throws std::bad_alloc.
  void push_back(const T& item) {
    if (size_ == capacity_) {
      const T copy = item;  // which may be one of ours
      grow(size_ + 1);
      new (items_ + size_++) T(copy);
    } else {
      new (items_ + size_++) T(item);
    }
  }
  /// `items` are not ours. Throws std::bad_alloc.
  void append(std::span<const T> items) {
    if (size_ + items.size() > capacity_) grow(size_ + items.size());
    std::uninitialized_copy(items.begin(), items.end(), items_ + size_);
    size_ += items.size();
  }
  /// New elements are copies of `value`. Throws std::bad_alloc.
  void resize(std::size_t size, T value = T()) {  // by value: it may be one of ours
    if (size > capacity_) grow(size);
    if (size > size_) std::uninitialized_fill(items_ + size_, items_ + size, value);
    size_ = size;
  }

  /// New elements are to be written before they are read. Throws std::bad_alloc.
  void resize_for_overwrite(std::size_t size) {
    if (size > capacity_) grow(size);
    size_ = size;
  }

  T& operator[](std::size_t i) { return items_[i]; }
  const T& operator[](std::size_t i) const { return items_[i]; }
  T& back() { return items_[size_ - 1]; }
  T* begin() { return items_; }
  T* end() { return items_ + size_; }
  const T* begin() const { return items_; }
  const T* end() const { return items_ + size_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// What is reserved. Pages of large blocks that were never used take no memory.
  std::size_t capacity() const { return capacity_; }

 private:
  void swap(GrowingArray& other) noexcept {
    std::swap(items_, other.items_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  void grow(std::size_t needed) {
    const std::size_t capacity = std::max({needed, 2 * capacity_, std::size_t{8}});
    // T can be copied as bytes.
    items_ = static_cast<T*>(grow_block(items_, capacity_ * sizeof(T), capacity * sizeof(T)));
    capacity_ = capacity;
  }

  T* items_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace perentie::base

// Typed 32-bit ids and the stores they index.
//
// Trees, names, values, process terms, states and labels are all named by ids: they are small, they
// compare by value, and they stay valid when their store grows. An `Id<Tag>` of one kind does not
// convert to another. A reference obtained from a store does not survive the next `add`.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace perentie::base {

/// A typed index. The default value is `none`, which names nothing.
template <class Tag>
struct Id {
  static constexpr std::uint32_t none_value = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t value = none_value;

  constexpr bool is_none() const { return value == none_value; }
  constexpr explicit operator bool() const { return !is_none(); }
  friend constexpr auto operator<=>(Id, Id) = default;
};

/// An append-only sequence of `T` whose elements are named by `IdT`, in order of addition.
template <class IdT, class T>
class Store {
 public:
  IdT add(T value) {
    items_.push_back(std::move(value));
    return IdT{static_cast<std::uint32_t>(items_.size() - 1)};
  }

  T& operator[](IdT id) { return items_[id.value]; }
  const T& operator[](IdT id) const { return items_[id.value]; }

  std::size_t size() const { return items_.size(); }
  bool empty() const { return items_.empty(); }
  void reserve(std::size_t count) { items_.reserve(count); }

  auto begin() const { return items_.begin(); }
  auto end() const { return items_.end(); }

 private:
  std::vector<T> items_;
};

/// A run of consecutive entries of a `ListPool`: how a tree node refers to its children.
template <class T>
struct ListRef {
  std::uint32_t first = 0;
  std::uint32_t count = 0;

  constexpr bool empty() const { return count == 0; }
};

/// Storage for the child lists of a tree: one allocation for all lists of one element type.
template <class T>
class ListPool {
 public:
  ListRef<T> add(std::span<const T> items) {
    const ListRef<T> ref{static_cast<std::uint32_t>(items_.size()),
                         static_cast<std::uint32_t>(items.size())};
    items_.insert(items_.end(), items.begin(), items.end());
    return ref;
  }

  std::span<const T> operator[](ListRef<T> ref) const {
    return std::span<const T>(items_).subspan(ref.first, ref.count);
  }

 private:
  std::vector<T> items_;
};

}  // namespace perentie::base

template <class Tag>
struct std::hash<perentie::base::Id<Tag>> {
  std::size_t operator()(perentie::base::Id<Tag> id) const noexcept {
    return std::hash<std::uint32_t>{}(id.value);
  }
};

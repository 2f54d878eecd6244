// Values: completely evaluated data, hash-consed, so equal values are equal ids.
//
// A `ValueId` is either a small integer itself or the index of a term in the `ValueStore`. Lazy
// things (thunks, half-evaluated sequences, closures) live on the evaluator's heap, not here. Sets
// are sorted by `compare`, the total order in which FDR enumerates them (CSPM reference 3.4.1).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "perentie/base/check.hpp"
#include "perentie/base/id.hpp"
#include "perentie/base/term_table.hpp"
#include "perentie/semantics/symbols.hpp"

namespace perentie::semantics {

using ProcId = base::Id<struct ProcTag>;

/// A value. Bit 31 set: the other bits are a small integer; otherwise an index into the store.
struct ValueId {
  static constexpr std::uint32_t small_bit = 0x8000'0000U;
  std::uint32_t bits = 0;

  constexpr bool is_small_int() const { return (bits & small_bit) != 0; }
  friend constexpr bool operator==(ValueId, ValueId) = default;
};

enum class ValueKind : std::uint8_t {
  integer,
  boolean,
  character,
  atom,  ///< a channel or constructor without arguments: {symbol}
  dot,   ///< components; a completed constructor application is one component (3.6.1)
  tuple,
  empty_seq,
  cons,       ///< {head, tail, length}
  set,        ///< elements in ascending order
  int_set,    ///< all integers
  proc_set,   ///< all processes
  from_set,   ///< {n}: all integers from n
  seq_set,    ///< {s}: all finite sequences over a set
  tuple_set,  ///< sets: all tuples of their elements, if these cannot be listed
  dot_set,    ///< sets: all dotted values of their elements, if these cannot be listed
  power_set,  ///< {s}: all subsets, if they cannot be listed
  map_set,    ///< {s, t}: all partial maps from s to t, if they cannot be listed
  data_set,   ///< {symbol}: all values of a datatype with infinitely many
  map,        ///< {} or {key, value, map of smaller keys, map of greater keys}
  process,    ///< {process}
  function,   ///< {function, group, scope}: see evaluate's code.hpp
  builtin,    ///< {builtin}
  ignored,    ///< stands for an argument that a function ignores (3.8.2)
};

class ValueStore {
 public:
  ValueStore();

  // Constructors. `make_set` sorts and removes duplicates.
  ValueId make_int(std::int64_t value);
  ValueId make_bool(bool value) const { return value ? true_ : false_; }
  ValueId make_char(unsigned char value);
  ValueId make_atom(SymbolId symbol);
  ValueId make_dot(
      std::span<const ValueId> components);  ///< two or more, none a plain dot at the end
  ValueId make_tuple(std::span<const ValueId> items);
  ValueId empty_seq() const { return empty_seq_; }
  ValueId make_cons(ValueId head, ValueId tail);
  ValueId make_seq(std::span<const ValueId> items);
  ValueId make_string(std::string_view text);
  ValueId empty_set() const { return empty_set_; }
  ValueId make_set(std::vector<ValueId> elements);
  ValueId make_sorted_set(std::span<const ValueId> elements);
  ValueId int_set() const { return int_set_; }
  ValueId proc_set() const { return proc_set_; }
  ValueId make_from_set(std::int64_t first);
  ValueId make_seq_set(ValueId elements);
  /// A `tuple_set`, `dot_set`, `power_set` or `map_set`.
  ValueId make_set_over(ValueKind kind, std::span<const ValueId> sets);
  ValueId make_data_set(SymbolId datatype);
  ValueId empty_map() const { return empty_map_; }
  /// For `make_map` and the other operations of src/maps.hpp.
  ValueId make_map_node(ValueId key, ValueId value, ValueId smaller, ValueId greater);
  ValueId make_process(ProcId process);
  ValueId make_function(std::uint32_t function, std::uint32_t group, std::uint32_t scope);
  ValueId make_builtin(Builtin builtin);
  ValueId ignored() const { return ignored_; }

  // Observers. Each presumes the kind it reads; spans do not survive the next constructor call.
  ValueKind kind(ValueId value) const {
    return value.is_small_int() ? ValueKind::integer
                                : static_cast<ValueKind>(terms_.tag(value.bits));
  }
  std::int64_t as_int(ValueId value) const;
  bool as_bool(ValueId value) const { return value == true_; }
  unsigned char as_char(ValueId value) const;
  SymbolId as_symbol(ValueId value) const { return SymbolId{word(value, 0)}; }
  ProcId as_process(ValueId value) const { return ProcId{word(value, 0)}; }
  Builtin as_builtin(ValueId value) const { return static_cast<Builtin>(word(value, 0)); }
  ValueId head(ValueId cons) const { return {word(cons, 0)}; }
  ValueId tail(ValueId cons) const { return {word(cons, 1)}; }
  std::uint32_t length(ValueId seq) const;
  /// The components of a dot, items of a tuple, elements of a set.
  std::span<const ValueId> items(ValueId value) const;
  std::uint32_t word(ValueId value, std::size_t index) const {
    return terms_.words(value.bits)[index];
  }

  bool is_seq(ValueId value) const {
    const ValueKind k = kind(value);
    return k == ValueKind::cons || k == ValueKind::empty_seq;
  }
  bool is_set(ValueId value) const {
    const ValueKind k = kind(value);
    return k >= ValueKind::set && k <= ValueKind::data_set;
  }
  /// The text of a sequence of characters; nothing if some element is none.
  std::optional<std::string> as_string(ValueId seq) const;

  /// The total order that sorts sets: negative, zero or positive.
  int compare(ValueId a, ValueId b) const;

  std::size_t memory_bytes() const { return terms_.memory_bytes(); }

  /// To be called now and then while values are made. It may throw.
  void set_checkpoint(std::function<void()> checkpoint) { checkpoint_ = std::move(checkpoint); }

 private:
  static constexpr std::uint32_t values_per_checkpoint = 1U << 14U;

  ValueId intern(ValueKind kind, std::span<const std::uint32_t> words) {
    if (++made_ % values_per_checkpoint == 0) checkpoint_();
    return {terms_.intern(static_cast<std::uint8_t>(kind), words)};
  }
  ValueId intern(ValueKind kind, std::initializer_list<std::uint32_t> words) {
    return intern(kind, std::span<const std::uint32_t>(words.begin(), words.size()));
  }
  ValueId intern(ValueKind kind, std::span<const ValueId> items);

  base::TermTable terms_;
  std::function<void()> checkpoint_ = [] {};
  std::uint32_t made_ = 0;
  ValueId false_, true_, empty_seq_, empty_set_, empty_map_, int_set_, proc_set_, ignored_;
};

/// The partial order of `<=` (3.2.4): sequences by prefix, sets by inclusion, maps entry by entry,
/// numbers and characters as usual, tuples by the total order. Nothing where the values have no
/// order.
enum class Ordering : std::uint8_t { less, equal, greater, incomparable };
std::optional<Ordering> compare_partially(const ValueStore& values, ValueId a, ValueId b);

}  // namespace perentie::semantics

// The evaluator's heap: what is not (yet) a value, with a copying collector.
//
// A `Word` is a small integer, a `ValueId`, a reference to a heap object, or nothing. Objects are
// thunks, frames, sequence cells, tuples and closures. The machine collects only between two
// instructions, when every live word is in one of its registers, stacks or tables; instructions
// themselves may therefore hold words freely (Cheney, "A nonrecursive list compacting algorithm",
// 1970).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "perentie/parser/token.hpp"
#include "perentie/semantics/value.hpp"

namespace perentie::semantics {

enum class ObjectKind : std::uint8_t {
  thunk,        ///< aux: code address; {frame}
  blackhole,    ///< a thunk under evaluation
  indirection,  ///< an evaluated thunk: {value}
  frame,        ///< aux: scope; {parent, canonical scope, slots..}
  cell,         ///< a sequence: {head, tail}
  tuple,        ///< aux: number of items; {items..}
  closure,      ///< aux: function; {frame, group}
  forwarded,    ///< during a collection: {new place}
};

struct Object;

/// One machine word. Heap references are pointers; integers have bit 0 set, values bit 1.
class Word {
 public:
  constexpr Word() = default;
  static Word integer(std::int64_t value) {
    return Word((static_cast<std::uint64_t>(value) << 1U) | int_bit);
  }
  static constexpr Word value(ValueId value) {
    return Word((std::uint64_t{value.bits} << 2U) | value_bit);
  }
  static Word object(Object* object) { return Word(reinterpret_cast<std::uint64_t>(object)); }

  bool is_nothing() const { return bits_ == 0; }
  bool is_integer() const { return (bits_ & int_bit) != 0; }
  bool is_value() const { return (bits_ & 3U) == value_bit; }
  bool is_object() const { return (bits_ & 3U) == 0 && bits_ != 0; }

  std::int64_t as_integer() const { return static_cast<std::int64_t>(bits_) >> 1U; }
  ValueId as_value() const { return {static_cast<std::uint32_t>(bits_ >> 2U)}; }
  Object* as_object() const { return reinterpret_cast<Object*>(bits_); }

  friend bool operator==(Word, Word) = default;

 private:
  static constexpr std::uint64_t int_bit = 1;
  static constexpr std::uint64_t value_bit = 2;
  constexpr explicit Word(std::uint64_t bits) : bits_(bits) {}

  std::uint64_t bits_ = 0;
};

/// Integers are those of 63 bits: the word's range (CSPM reference 1.4.1 leaves the range open).
inline constexpr std::int64_t max_integer = parser::largest_integer;
inline constexpr std::int64_t min_integer = -(std::int64_t{1} << 62);

struct Object {
  ObjectKind kind;
  std::uint32_t size : 24;  ///< words that follow
  std::uint32_t aux;

  Word* words() { return reinterpret_cast<Word*>(this + 1); }
  Word& operator[](std::size_t index) { return words()[index]; }
};
static_assert(sizeof(Object) % sizeof(Word) == 0);

/// Places of a frame's words.
inline constexpr std::size_t frame_parent = 0;
inline constexpr std::size_t frame_canonical = 1;
inline constexpr std::size_t frame_slots = 2;

class Heap {
 public:
  Object* allocate(ObjectKind kind, std::uint32_t aux, std::size_t size);

  bool wants_collection() const { return allocated_ >= threshold_; }
  std::size_t bytes() const { return allocated_; }

  /// Copies what the roots reach and frees the rest. `visit_roots(move)` calls `move(Word&)` on
  /// every word that the machine holds.
  template <class VisitRoots>
  void collect(VisitRoots visit_roots) {
    std::vector<Chunk> old = begin_collection();
    visit_roots([this](Word& word) { move(word); });
    scan_copied();
    end_collection();
  }

 private:
  struct Chunk {
    std::unique_ptr<std::uint64_t[]> words;
    std::size_t capacity = 0;
    std::size_t used = 0;
  };

  void move(Word& word);
  std::vector<Chunk> begin_collection();
  void scan_copied();
  void end_collection();

  std::vector<Chunk> chunks_;
  std::size_t allocated_ = 0;
  std::size_t threshold_ = std::size_t{64} << 20U;
};

}  // namespace perentie::semantics

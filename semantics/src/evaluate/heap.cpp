#include "heap.hpp"

#include <algorithm>
#include <cstring>

namespace perentie::semantics {
namespace {

constexpr std::size_t chunk_words = std::size_t{1} << 17U;  // 1 MiB

}  // namespace

Object* Heap::allocate(ObjectKind kind, std::uint32_t aux, std::size_t size) {
  PERENTIE_CHECK(size > 0 && size < (std::size_t{1} << 24U), "an object of impossible size");
  const std::size_t needed = size + sizeof(Object) / sizeof(Word);
  if (chunks_.empty() || chunks_.back().used + needed > chunks_.back().capacity) {
    const std::size_t capacity = std::max(chunk_words, needed);
    chunks_.push_back({std::make_unique_for_overwrite<std::uint64_t[]>(capacity), capacity, 0});
  }
  Chunk& chunk = chunks_.back();
  auto* object = reinterpret_cast<Object*>(chunk.words.get() + chunk.used);
  chunk.used += needed;
  allocated_ += needed * sizeof(std::uint64_t);
  object->kind = kind;
  object->size = static_cast<std::uint32_t>(size) & 0xFF'FFFFU;
  object->aux = aux;
  std::fill_n(object->words(), size, Word{});
  return object;
}

std::vector<Heap::Chunk> Heap::begin_collection() {
  allocated_ = 0;
  return std::exchange(chunks_, {});
}

void Heap::move(Word& word) {
  if (!word.is_object()) return;
  Object* object = word.as_object();
  // Evaluated thunks are skipped: the word refers to their value from now on.
  while (object->kind == ObjectKind::indirection) {
    word = (*object)[0];
    if (!word.is_object()) return;
    object = word.as_object();
  }
  if (object->kind == ObjectKind::forwarded) {
    word = (*object)[0];
    return;
  }
  Object* copy = allocate(object->kind, object->aux, object->size);
  std::copy_n(object->words(), object->size, copy->words());
  object->kind = ObjectKind::forwarded;
  (*object)[0] = Word::object(copy);
  word = Word::object(copy);
}

void Heap::scan_copied() {
  // Scanning appends to the last chunk, so positions are indices.
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    for (std::size_t at = 0; at < chunks_[c].used;) {
      auto* object = reinterpret_cast<Object*>(chunks_[c].words.get() + at);
      for (std::uint32_t i = 0; i < object->size; ++i) move((*object)[i]);
      at += object->size + sizeof(Object) / sizeof(Word);
    }
  }
}

void Heap::end_collection() { threshold_ = std::max(std::size_t{64} << 20U, 2 * allocated_); }

}  // namespace perentie::semantics

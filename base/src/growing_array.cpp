#include "perentie/base/growing_array.hpp"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>

namespace perentie::base {
namespace {

// Blocks of at least this many bytes are mapped by themselves.
constexpr std::size_t mapped_bytes = std::size_t{4} << 20U;

void* map(void* block, std::size_t old_bytes, std::size_t new_bytes) {
  void* mapped = block == nullptr ? mmap(nullptr, new_bytes, PROT_READ | PROT_WRITE,
                                         MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)
                                  : mremap(block, old_bytes, new_bytes, MREMAP_MAYMOVE);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  // Without huge pages everything works as well.
  madvise(mapped, new_bytes, MADV_HUGEPAGE);
  return mapped;
}

}  // namespace

void* resize_block(void* block, std::size_t old_bytes, std::size_t new_bytes) {
  const bool was_mapped = old_bytes >= mapped_bytes;
  if (new_bytes == 0) {
    if (was_mapped) {
      munmap(block, old_bytes);
    } else {
      std::free(block);
    }
    return nullptr;
  }
  if (new_bytes < mapped_bytes && !was_mapped) {
    void* resized = std::realloc(block, new_bytes);
    if (resized == nullptr) throw std::bad_alloc();
    return resized;
  }
  if (new_bytes >= mapped_bytes && was_mapped) return map(block, old_bytes, new_bytes);
  void* moved = new_bytes >= mapped_bytes ? map(nullptr, 0, new_bytes) : std::malloc(new_bytes);
  if (moved == nullptr) throw std::bad_alloc();
  if (block != nullptr) std::memcpy(moved, block, std::min(old_bytes, new_bytes));
  resize_block(block, old_bytes, 0);
  return moved;
}

}  // namespace perentie::base

#include "perentie/base/growing_array.hpp"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <limits>

namespace perentie::base {
namespace {

// Blocks of at least this many bytes are mapped by themselves. ThreadSanitizer does not see
// `mremap`: a block that moves to where another thread had one would look like a race.
#ifdef __SANITIZE_THREAD__
constexpr std::size_t mapped_bytes = std::numeric_limits<std::size_t>::max();
#else
constexpr std::size_t mapped_bytes = std::size_t{4} << 20U;
#endif

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

void* grow_block(void* block, std::size_t old_bytes, std::size_t new_bytes) {
  if (new_bytes < mapped_bytes) {
    void* grown = std::realloc(block, new_bytes);
    if (grown == nullptr) throw std::bad_alloc();
    return grown;
  }
  if (old_bytes >= mapped_bytes) return map(block, old_bytes, new_bytes);
  void* mapped = map(nullptr, 0, new_bytes);
  if (block != nullptr) std::memcpy(mapped, block, old_bytes);
  std::free(block);
  return mapped;
}

void free_block(void* block, std::size_t bytes) {
  if (bytes >= mapped_bytes) {
    munmap(block, bytes);
  } else {
    std::free(block);
  }
}

}  // namespace perentie::base

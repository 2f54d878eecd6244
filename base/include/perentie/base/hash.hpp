// Hashing of small integers and of sequences of them, for unique tables and visited sets.
#pragma once

#include <cstdint>
#include <span>

namespace perentie::base {

/// Mixes one 64-bit word into a hash (the finaliser of splitmix64 over the running value).
constexpr std::uint64_t hash_mix(std::uint64_t hash, std::uint64_t word) {
  std::uint64_t x = hash ^ (word + 0x9E37'79B9'7F4A'7C15U + (hash << 6U) + (hash >> 2U));
  x = (x ^ (x >> 30U)) * 0xBF58'476D'1CE4'E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D0'49BB'1331'11EBU;
  return x ^ (x >> 31U);
}

constexpr std::uint64_t hash_words(std::span<const std::uint32_t> words, std::uint64_t seed = 0) {
  std::uint64_t hash = hash_mix(seed, words.size());
  for (const std::uint32_t word : words) hash = hash_mix(hash, word);
  return hash;
}

}  // namespace perentie::base

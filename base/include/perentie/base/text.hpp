// Small text helpers that several libraries print with.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace perentie::base {

/// 1234567 as "1,234,567".
std::string with_thousands(std::uint64_t number);

/// The candidates nearest to `word` by edit distance, best first, at most `limit`; none further
/// away than a third of the word's length. The source of every "did you mean".
std::vector<std::string_view> nearest_words(std::string_view word,
                                            std::span<const std::string_view> candidates,
                                            std::size_t limit = 3);

}  // namespace perentie::base

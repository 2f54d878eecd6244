#include "glob.hpp"

#include <cstddef>
#include <vector>

namespace perentie::monitor {

// Steps the set of pattern positions that the text so far may have reached: linear in both lengths
// multiplied, whatever the pattern.
bool matches_glob(std::string_view pattern, std::string_view text) {
  const auto star_length = [pattern](std::size_t at) -> std::size_t {
    if (at >= pattern.size() || pattern[at] != '*') return 0;
    return pattern.substr(at, 2) == "**" ? 2 : 1;
  };
  // A star may stand for nothing, so whoever is before it is behind it too.
  const auto pass_stars = [&](std::vector<bool>& at) {
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      if (at[i] && star_length(i) > 0) at[i + star_length(i)] = true;
    }
  };
  std::vector<bool> now(pattern.size() + 1, false);
  now[0] = true;
  pass_stars(now);
  for (const char c : text) {
    std::vector<bool> next(pattern.size() + 1, false);
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      if (!now[i]) continue;
      const std::size_t star = star_length(i);
      if (star == 0 && pattern[i] == c) next[i + 1] = true;
      if (star == 2 || (star == 1 && c != '/')) next[i] = true;
    }
    pass_stars(next);
    now = std::move(next);
  }
  return now[pattern.size()];
}

}  // namespace perentie::monitor

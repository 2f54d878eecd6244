// HittingSets: the smallest sets of labels that share a label with each set of a family.
//
// The sets are taken one after the other: what hits all sets so far and not the next one gets one
// of its labels. A set is minimal iff each of its labels is the only one that hits some set of the
// family, so minimality needs no comparison with other hitting sets, and none is made twice. There
// may be exponentially many (Berge, *Hypergraphs*, 1989, chapter 2).
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "perentie/lts/lts.hpp"
#include "perentie/lts/watch.hpp"

namespace perentie::lts {

class HittingSets {
 public:
  using Family = std::span<const std::span<const Label>>;

  /// `max_states` counts hitting sets.
  explicit HittingSets(const base::Limits& limits) : watch_(limits) {}

  /// Of sets that are ascending and not empty; of no set, the empty set.
  std::optional<base::LimitReached> find(Family family) {
    found_.assign(1, {});
    for (std::size_t next = 0; next < family.size(); ++next) {
      std::vector<std::vector<Label>> extended;
      for (std::vector<Label>& set : found_) {
        if (std::ranges::any_of(set, [&](Label label) { return has(family[next], label); })) {
          extended.push_back(std::move(set));
        } else {
          extend(set, family.first(next), family[next], extended);
        }
        if (watch_.due()) {
          if (const auto limit = watch_.look()) return limit;
        }
        if (const auto limit = watch_.budget().check_states(extended.size())) return limit;
      }
      found_ = std::move(extended);
    }
    std::ranges::sort(found_);
    return std::nullopt;
  }

  /// Ascending, each of them and all.
  const std::vector<std::vector<Label>>& found() const { return found_; }

 private:
  static bool has(std::span<const Label> set, Label label) {
    return std::ranges::binary_search(set, label);
  }

  /// Adds the set with each label of `missed` beside which all its labels are still needed.
  static void extend(const std::vector<Label>& set, Family hit, std::span<const Label> missed,
                     std::vector<std::vector<Label>>& out) {
    for (const Label added : missed) {
      const auto is_needed = [&](Label label) {
        return std::ranges::any_of(hit, [&](std::span<const Label> other) {
          return has(other, label) && !has(other, added) &&
                 std::ranges::none_of(
                     set, [&](Label third) { return third != label && has(other, third); });
        });
      };
      if (!std::ranges::all_of(set, is_needed)) continue;
      std::vector<Label>& larger = out.emplace_back(set);
      larger.insert(std::ranges::upper_bound(larger, added), added);
    }
  }

  Watch watch_;
  std::vector<std::vector<Label>> found_;
};

}  // namespace perentie::lts

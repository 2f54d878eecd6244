#include "sets.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "../maps.hpp"
#include "failure.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {
namespace {

auto less_in(const ValueStore& values) {
  return [&values](ValueId a, ValueId b) { return values.compare(a, b) < 0; };
}

void check_size(std::size_t size) {
  if (size <= max_set_elements) return;
  fail(codes::too_large,
       fmt::format("a set of more than {} elements would be needed", max_set_elements));
}

std::vector<ValueId> copy_items(const ValueStore& values, ValueId value) {
  const auto items = values.items(value);
  return {items.begin(), items.end()};
}

bool is_set_kind(const ValueStore& values, ValueId set, ValueKind kind) {
  return values.kind(set) == kind;
}

std::int64_t first_of(const ValueStore& values, ValueId from_set) {
  return values.as_int(ValueId{values.word(from_set, 0)});
}

bool lists(const ValueStore& values, ValueId listed_set, ValueId element) {
  const auto items = values.items(listed_set);
  return std::binary_search(items.begin(), items.end(), element, less_in(values));
}

// What must hold: that a value is in a set, or that all elements of a set are in another.
struct Claim {
  enum class Kind : std::uint8_t { element, subset } kind;
  ValueId part, set;
};

// Whether a claim holds. It does if others do, which are kept on a stack: sets can be nested
// deeply.
class ClaimChecker {
 public:
  ClaimChecker(const ValueStore& values, const Resolution& resolution)
      : values_(values), resolution_(resolution) {}

  bool holds(Claim claim) {
    claims_.push_back(claim);
    while (!claims_.empty()) {
      const Claim next = claims_.back();
      claims_.pop_back();
      const bool possible = next.kind == Claim::Kind::element ? reduce_element(next.part, next.set)
                                                              : reduce_subset(next.part, next.set);
      if (!possible) return false;
    }
    return true;
  }

 private:
  void claim_element(ValueId element, ValueId set) {
    claims_.push_back({Claim::Kind::element, element, set});
  }

  // Sets of different shapes that hold the same type are listed in one case, so shapes decide.
  bool reduce_subset(ValueId part, ValueId set) {
    if (part == set || is_set_kind(values_, set, ValueKind::int_set)) return true;
    if (is_set_kind(values_, part, ValueKind::set)) {
      for (const ValueId element : values_.items(part)) claim_element(element, set);
      return true;
    }
    if (values_.kind(part) != values_.kind(set)) return false;
    switch (values_.kind(part)) {
      case ValueKind::from_set:
        return first_of(values_, part) >= first_of(values_, set);
      case ValueKind::seq_set:
      case ValueKind::tuple_set:
      case ValueKind::dot_set:
      case ValueKind::power_set:
      case ValueKind::map_set: {
        const auto parts = values_.items(part);
        const auto sets = values_.items(set);
        if (parts.size() != sets.size()) return false;
        for (std::size_t i = 0; i < parts.size(); ++i) {
          claims_.push_back({Claim::Kind::subset, parts[i], sets[i]});
        }
        return true;
      }
      default:
        return false;
    }
  }

  bool reduce_element(ValueId element, ValueId set) {
    const ValueKind kind = values_.kind(element);
    switch (values_.kind(set)) {
      case ValueKind::set:
        return lists(values_, set, element);
      case ValueKind::int_set:
        return kind == ValueKind::integer;
      case ValueKind::proc_set:
        return kind == ValueKind::process;
      case ValueKind::from_set:
        return kind == ValueKind::integer && values_.as_int(element) >= first_of(values_, set);
      case ValueKind::seq_set:
        for (; values_.kind(element) == ValueKind::cons; element = values_.tail(element)) {
          claim_element(values_.head(element), values_.items(set)[0]);
        }
        return values_.is_seq(element);
      case ValueKind::tuple_set:
        return kind == ValueKind::tuple && reduce_items(element, set);
      case ValueKind::dot_set:
        return kind == ValueKind::dot && reduce_items(element, set);
      case ValueKind::power_set:
        claims_.push_back({Claim::Kind::subset, element, values_.items(set)[0]});
        return values_.is_set(element);
      case ValueKind::map_set:
        if (kind != ValueKind::map && element != values_.empty_map()) return false;
        for (const auto& [key, value] : map_entries(values_, element)) {
          claim_element(key, values_.items(set)[0]);
          claim_element(value, values_.items(set)[1]);
        }
        return true;
      case ValueKind::data_set: {
        const ValueId head = kind == ValueKind::dot ? values_.items(element)[0] : element;
        if (values_.kind(head) != ValueKind::atom) return false;
        const Symbol& constructor = resolution_.symbols[values_.as_symbol(head)];
        return constructor.decl == resolution_.symbols[values_.as_symbol(set)].decl;
      }
      default:
        return false;
    }
  }

  bool reduce_items(ValueId element, ValueId product) {
    const auto items = values_.items(element);
    const auto sets = values_.items(product);
    if (items.size() != sets.size()) return false;
    for (std::size_t i = 0; i < items.size(); ++i) claim_element(items[i], sets[i]);
    return true;
  }

  const ValueStore& values_;
  const Resolution& resolution_;
  std::vector<Claim> claims_;
};

bool is_inside(const ValueStore& values, const Resolution& resolution, ValueId part, ValueId set) {
  return ClaimChecker(values, resolution).holds({Claim::Kind::subset, part, set});
}

ValueId over(ValueStore& values, ValueKind kind, std::initializer_list<ValueId> sets) {
  return values.make_set_over(kind, std::span(sets.begin(), sets.size()));
}

}  // namespace

bool is_listed(const ValueStore& values, ValueId set) {
  return is_set_kind(values, set, ValueKind::set);
}

bool is_finite(const ValueStore& values, ValueId set) {
  std::vector<ValueId> stack{set};
  while (!stack.empty()) {
    const ValueId s = stack.back();
    stack.pop_back();
    switch (values.kind(s)) {
      case ValueKind::set:
        break;
      case ValueKind::tuple_set:
      case ValueKind::dot_set:
      case ValueKind::power_set:
      case ValueKind::map_set: {
        const auto items = values.items(s);
        stack.insert(stack.end(), items.begin(), items.end());
        break;
      }
      default:
        return false;
    }
  }
  return true;
}

void fail_unlisted(const ValueStore& values, ValueId set, std::string_view purpose) {
  if (is_finite(values, set)) {
    fail(codes::too_large,
         fmt::format("cannot {} a set of more than {} elements", purpose, max_set_elements));
  }
  fail(codes::infinite_set, fmt::format("cannot {} an infinite set", purpose));
}

bool lists_nothing(const ValueStore& values, ValueId set) {
  return is_set_kind(values, set, ValueKind::seq_set) &&
         ValueId{values.word(set, 0)} == values.empty_set();
}

std::size_t cardinality(const ValueStore& values, ValueId set) {
  if (!is_listed(values, set)) fail_unlisted(values, set, "take the cardinality of");
  return values.items(set).size();
}

std::vector<ValueId> elements_of(const ValueStore& values, ValueId set, std::string_view purpose) {
  if (lists_nothing(values, set)) return {};
  if (!is_listed(values, set)) fail_unlisted(values, set, purpose);
  return copy_items(values, set);
}

ValueId set_union(ValueStore& values, const Resolution& resolution, ValueId a, ValueId b) {
  if (a == b) return a;
  if (a == values.empty_set()) return b;
  if (b == values.empty_set()) return a;
  if (!is_listed(values, a) || !is_listed(values, b)) {
    if (is_inside(values, resolution, a, b)) return b;
    if (is_inside(values, resolution, b, a)) return a;
    fail_unlisted(values, is_listed(values, a) ? b : a, "form the union with");
  }
  std::vector<ValueId> merged;
  const auto as = values.items(a);
  const auto bs = values.items(b);
  merged.reserve(as.size() + bs.size());
  std::set_union(as.begin(), as.end(), bs.begin(), bs.end(), std::back_inserter(merged),
                 less_in(values));
  return values.make_sorted_set(merged);
}

ValueId set_intersection(ValueStore& values, const Resolution& resolution, ValueId a, ValueId b) {
  if (a == b) return a;
  if (!is_listed(values, a)) std::swap(a, b);
  if (!is_listed(values, a)) {
    if (is_inside(values, resolution, a, b)) return a;
    if (is_inside(values, resolution, b, a)) return b;
    fail_unlisted(values, a, "intersect");
  }
  std::vector<ValueId> common;
  if (is_listed(values, b)) {
    const auto as = values.items(a);
    const auto bs = values.items(b);
    std::set_intersection(as.begin(), as.end(), bs.begin(), bs.end(), std::back_inserter(common),
                          less_in(values));
  } else {
    for (const ValueId x : values.items(a)) {
      if (set_contains(values, resolution, b, x)) common.push_back(x);
    }
  }
  return values.make_sorted_set(common);
}

ValueId set_difference(ValueStore& values, const Resolution& resolution, ValueId a, ValueId b) {
  if (a == b || a == values.empty_set()) return values.empty_set();
  if (b == values.empty_set()) return a;
  if (!is_listed(values, a)) {
    if (is_inside(values, resolution, a, b)) return values.empty_set();
    fail_unlisted(values, a, "take elements away from");
  }
  std::vector<ValueId> rest;
  if (is_listed(values, b)) {
    const auto as = values.items(a);
    const auto bs = values.items(b);
    std::set_difference(as.begin(), as.end(), bs.begin(), bs.end(), std::back_inserter(rest),
                        less_in(values));
  } else {
    for (const ValueId x : values.items(a)) {
      if (!set_contains(values, resolution, b, x)) rest.push_back(x);
    }
  }
  return values.make_sorted_set(rest);
}

ValueId union_of_all(ValueStore& values, const Resolution& resolution, ValueId sets) {
  std::vector<ValueId> all;
  ValueId infinite = values.empty_set();
  for (const ValueId set : elements_of(values, sets, "form the distributed union of")) {
    if (is_listed(values, set)) {
      const auto items = values.items(set);
      all.insert(all.end(), items.begin(), items.end());
    } else {
      infinite = set_union(values, resolution, infinite, set);
    }
  }
  return set_union(values, resolution, infinite, values.make_set(std::move(all)));
}

ValueId intersection_of_all(ValueStore& values, const Resolution& resolution, ValueId sets) {
  const std::vector<ValueId> all =
      elements_of(values, sets, "form the distributed intersection of");
  if (all.empty()) return values.empty_set();
  ValueId result = all[0];
  for (const ValueId set : all) result = set_intersection(values, resolution, result, set);
  return result;
}

ValueId power_set(ValueStore& values, ValueId set) {
  if (!is_listed(values, set) && !lists_nothing(values, set)) {
    return over(values, ValueKind::power_set, {set});
  }
  const std::vector<ValueId> elements = elements_of(values, set, "list the subsets of");
  if (elements.size() >= 24) return over(values, ValueKind::power_set, {set});
  // Subsets in the order of `compare`: each subset is followed by its extensions by later elements.
  std::vector<ValueId> subsets;
  std::vector<std::size_t> chosen;
  std::vector<ValueId> members;
  const auto add = [&] {
    members.clear();
    for (const std::size_t i : chosen) members.push_back(elements[i]);
    subsets.push_back(values.make_sorted_set(members));
  };
  add();
  for (std::size_t next = 0;;) {
    if (next < elements.size()) {
      chosen.push_back(next);
      add();
      ++next;
    } else if (chosen.empty()) {
      break;
    } else {
      next = chosen.back() + 1;
      chosen.pop_back();
    }
  }
  return values.make_sorted_set(subsets);
}

ValueId range_set(ValueStore& values, std::int64_t first, std::int64_t last) {
  if (last < first) return values.empty_set();
  const auto count = static_cast<std::uint64_t>(last) - static_cast<std::uint64_t>(first) + 1;
  check_size(count == 0 ? max_set_elements + 1 : count);
  std::vector<ValueId> elements;
  elements.reserve(count);
  for (std::int64_t i = first; i <= last; ++i) elements.push_back(values.make_int(i));
  return values.make_sorted_set(elements);
}

bool can_list_product(const ValueStore& values, std::span<const ValueId> sets) {
  std::size_t size = 1;
  bool all_listed = true;
  for (const ValueId set : sets) {
    if (lists_nothing(values, set) || set == values.empty_set()) return true;
    if (!is_listed(values, set)) {
      all_listed = false;
    } else {
      size = std::min(max_set_elements + 1, size * values.items(set).size());
    }
  }
  return all_listed && size <= max_set_elements;
}

ValueId tuple_product(ValueStore& values, std::span<const ValueId> sets) {
  if (!can_list_product(values, sets)) return values.make_set_over(ValueKind::tuple_set, sets);
  std::vector<std::vector<ValueId>> columns;
  std::size_t size = 1;
  for (const ValueId set : sets) {
    if (lists_nothing(values, set) || set == values.empty_set()) return values.empty_set();
    columns.push_back(copy_items(values, set));
    size *= columns.back().size();
  }
  std::vector<ValueId> tuples;
  std::vector<std::size_t> at(columns.size(), 0);
  std::vector<ValueId> tuple(columns.size());
  for (std::size_t n = 0; n < size; ++n) {
    for (std::size_t i = 0; i < columns.size(); ++i) tuple[i] = columns[i][at[i]];
    tuples.push_back(values.make_tuple(tuple));
    for (std::size_t i = columns.size(); i > 0 && ++at[i - 1] == columns[i - 1].size(); --i) {
      at[i - 1] = 0;
    }
  }
  return values.make_sorted_set(tuples);
}

ValueId all_maps(ValueStore& values, ValueId keys, ValueId results) {
  const auto lists_none = [&](ValueId set) {
    return set == values.empty_set() || lists_nothing(values, set);
  };
  std::vector<std::vector<std::pair<ValueId, ValueId>>> maps{{}};
  std::vector<ValueId> ks, rs;
  if (!lists_none(keys) && !lists_none(results)) {
    const ValueId shape = over(values, ValueKind::map_set, {keys, results});
    if (!is_listed(values, keys) || !is_listed(values, results)) return shape;
    ks = copy_items(values, keys);
    rs = copy_items(values, results);
    std::size_t size = 1;
    for (std::size_t i = 0; i < ks.size(); ++i) {
      if ((size *= rs.size() + 1) > max_set_elements) return shape;
    }
  }
  for (const ValueId key : ks) {
    const std::size_t before = maps.size();
    for (std::size_t i = 0; i < before; ++i) {
      for (const ValueId result : rs) {
        auto extended = maps[i];
        extended.emplace_back(key, result);
        maps.push_back(std::move(extended));
      }
    }
  }
  std::vector<ValueId> all;
  for (auto& map : maps) all.push_back(make_map(values, map));
  return values.make_set(std::move(all));
}

bool set_contains(const ValueStore& values, const Resolution& resolution, ValueId set,
                  ValueId element) {
  if (is_listed(values, set)) return lists(values, set, element);
  return ClaimChecker(values, resolution).holds({Claim::Kind::element, element, set});
}

std::optional<Ordering> compare_inclusion(const ValueStore& values, const Resolution& resolution,
                                          ValueId a, ValueId b) {
  const bool are_listed = is_listed(values, a) && is_listed(values, b);
  if (are_listed || !values.is_set(a) || !values.is_set(b)) return compare_partially(values, a, b);
  if (a == b) return Ordering::equal;
  if (is_inside(values, resolution, a, b)) return Ordering::less;
  return is_inside(values, resolution, b, a) ? Ordering::greater : Ordering::incomparable;
}

}  // namespace perentie::semantics

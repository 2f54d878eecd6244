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

[[noreturn]] void fail_infinite(std::string_view purpose) {
  fail(codes::infinite_set, fmt::format("cannot {} an infinite set", purpose));
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

// Whether every element of `a` is in `b`. Sets of different shapes that hold the same type are
// finite in one case, so shapes decide.
bool is_inside(const ValueStore& values, const Resolution& resolution, ValueId a, ValueId b) {
  for (;;) {
    if (a == b || is_set_kind(values, b, ValueKind::int_set)) return true;
    if (is_set_kind(values, a, ValueKind::set)) {
      const auto items = values.items(a);
      return std::all_of(items.begin(), items.end(), [&](ValueId element) {
        return set_contains(values, resolution, b, element);
      });
    }
    if (values.kind(a) != values.kind(b)) return false;
    if (is_set_kind(values, a, ValueKind::from_set)) {
      return first_of(values, a) >= first_of(values, b);
    }
    if (!is_set_kind(values, a, ValueKind::seq_set)) return false;
    a = ValueId{values.word(a, 0)};
    b = ValueId{values.word(b, 0)};
  }
}

}  // namespace

bool is_finite_set(const ValueStore& values, ValueId set) {
  return is_set_kind(values, set, ValueKind::set);
}

bool lists_nothing(const ValueStore& values, ValueId set) {
  return is_set_kind(values, set, ValueKind::seq_set) &&
         ValueId{values.word(set, 0)} == values.empty_set();
}

std::size_t cardinality(const ValueStore& values, ValueId set) {
  if (!is_finite_set(values, set)) fail_infinite("take the cardinality of");
  return values.items(set).size();
}

std::vector<ValueId> elements_of(const ValueStore& values, ValueId set, std::string_view purpose) {
  if (lists_nothing(values, set)) return {};
  if (!is_finite_set(values, set)) fail_infinite(purpose);
  return copy_items(values, set);
}

ValueId set_union(ValueStore& values, const Resolution& resolution, ValueId a, ValueId b) {
  if (a == b) return a;
  if (a == values.empty_set()) return b;
  if (b == values.empty_set()) return a;
  if (!is_finite_set(values, a) || !is_finite_set(values, b)) {
    if (is_inside(values, resolution, a, b)) return b;
    if (is_inside(values, resolution, b, a)) return a;
    fail_infinite("form the union with");
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
  if (!is_finite_set(values, a)) std::swap(a, b);
  if (!is_finite_set(values, a)) {
    if (is_inside(values, resolution, a, b)) return a;
    if (is_inside(values, resolution, b, a)) return b;
    fail_infinite("intersect");
  }
  std::vector<ValueId> common;
  if (is_finite_set(values, b)) {
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
  if (!is_finite_set(values, a)) {
    if (is_inside(values, resolution, a, b)) return values.empty_set();
    fail_infinite("take elements away from");
  }
  std::vector<ValueId> rest;
  if (is_finite_set(values, b)) {
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
    if (is_finite_set(values, set)) {
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
  const std::vector<ValueId> elements = elements_of(values, set, "list the subsets of");
  if (elements.size() >= 24) check_size(max_set_elements + 1);
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

ValueId tuple_product(ValueStore& values, std::span<const ValueId> sets) {
  std::vector<std::vector<ValueId>> columns;
  std::size_t size = 1;
  for (const ValueId set : sets) {
    columns.push_back(elements_of(values, set, "list the tuples over"));
    check_size(size = columns.back().empty() ? 0 : size * columns.back().size());
    if (size == 0) return values.empty_set();
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
  const std::vector<ValueId> ks = elements_of(values, keys, "list the maps over");
  const std::vector<ValueId> rs = elements_of(values, results, "list the maps into");
  std::vector<std::vector<std::pair<ValueId, ValueId>>> maps{{}};
  for (const ValueId key : ks) {
    const std::size_t before = maps.size();
    check_size(before * (rs.size() + 1));
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
  switch (values.kind(set)) {
    case ValueKind::set: {
      const auto items = values.items(set);
      return std::binary_search(items.begin(), items.end(), element, less_in(values));
    }
    case ValueKind::int_set:
      return values.kind(element) == ValueKind::integer;
    case ValueKind::proc_set:
      return values.kind(element) == ValueKind::process;
    case ValueKind::from_set:
      return values.kind(element) == ValueKind::integer &&
             values.as_int(element) >= first_of(values, set);
    case ValueKind::seq_set:
      for (; values.kind(element) == ValueKind::cons; element = values.tail(element)) {
        if (!set_contains(values, resolution, ValueId{values.word(set, 0)}, values.head(element))) {
          return false;
        }
      }
      return values.is_seq(element);
    case ValueKind::data_set: {
      const ValueId head =
          values.kind(element) == ValueKind::dot ? values.items(element)[0] : element;
      if (values.kind(head) != ValueKind::atom) return false;
      const Symbol& constructor = resolution.symbols[values.as_symbol(head)];
      return constructor.decl == resolution.symbols[values.as_symbol(set)].decl;
    }
    default:
      return false;
  }
}

std::optional<Ordering> compare_inclusion(const ValueStore& values, const Resolution& resolution,
                                          ValueId a, ValueId b) {
  const bool are_finite = is_finite_set(values, a) && is_finite_set(values, b);
  if (are_finite || !values.is_set(a) || !values.is_set(b)) return compare_partially(values, a, b);
  if (a == b) return Ordering::equal;
  if (is_inside(values, resolution, a, b)) return Ordering::less;
  return is_inside(values, resolution, b, a) ? Ordering::greater : Ordering::incomparable;
}

}  // namespace perentie::semantics

// Operations on sets of values, finite and infinite (CSPM reference 3.4).
//
// A set of at most `max_set_elements` elements is the sorted sequence of these; it is called
// listed. Infinite sets and larger ones are known by shape only, and a set has one shape: what
// cannot be answered for them is an evaluation failure that says so, never a guess.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "perentie/semantics/value.hpp"

namespace perentie::semantics {

/// Sets with more elements than this are not listed.
inline constexpr std::size_t max_set_elements = std::size_t{1} << 24U;

bool is_listed(const ValueStore& values, ValueId set);
/// Whether a set is known to have finitely many elements, listed or not.
bool is_finite(const ValueStore& values, ValueId set);
/// Fails because a set is not listed: "cannot `purpose` .. ".
[[noreturn]] void fail_unlisted(const ValueStore& values, ValueId set, std::string_view purpose);
/// `Seq({})`: its only element is never listed, as in FDR (11.10).
bool lists_nothing(const ValueStore& values, ValueId set);
/// The number of elements; fails for a set that is not listed.
std::size_t cardinality(const ValueStore& values, ValueId set);

/// The elements in order; fails for a set that is not listed, naming `purpose` ("Cannot ... ").
std::vector<ValueId> elements_of(const ValueStore& values, ValueId set, std::string_view purpose);

ValueId set_union(ValueStore& values, const Resolution& resolution, ValueId a, ValueId b);
ValueId set_intersection(ValueStore& values, const Resolution& resolution, ValueId a, ValueId b);
ValueId set_difference(ValueStore& values, const Resolution& resolution, ValueId a, ValueId b);
ValueId union_of_all(ValueStore& values, const Resolution& resolution, ValueId sets);
ValueId intersection_of_all(ValueStore& values, const Resolution& resolution, ValueId sets);
ValueId power_set(ValueStore& values, ValueId set);
ValueId range_set(ValueStore& values, std::int64_t first, std::int64_t last);
/// All tuples with one component from each set.
ValueId tuple_product(ValueStore& values, std::span<const ValueId> sets);
/// Whether the Cartesian product of these sets can be listed.
bool can_list_product(const ValueStore& values, std::span<const ValueId> sets);
/// All partial maps (3.7).
ValueId all_maps(ValueStore& values, ValueId keys, ValueId results);

/// Membership in any set, infinite ones included. `data_set` membership is by datatype of the
/// value's constructor, whose fields were checked when the value was built.
bool set_contains(const ValueStore& values, const Resolution& resolution, ValueId set,
                  ValueId element);

/// `compare_partially`, which orders listed sets by inclusion, for other sets as well.
std::optional<Ordering> compare_inclusion(const ValueStore& values, const Resolution& resolution,
                                          ValueId a, ValueId b);

}  // namespace perentie::semantics

#include "value_builtins.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "brief.hpp"
#include "failure.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"
#include "sets.hpp"

namespace perentie::semantics {
ValueId ValueBuiltins::require_set(ValueId value, std::string_view function) const {
  if (values.is_set(value)) return value;
  fail(codes::wrong_type, fmt::format("`{}` needs a set, but this is `{}`", function,
                                      brief(values, resolution, value)));
}

ValueId ValueBuiltins::require_seq(ValueId value, std::string_view function) const {
  if (values.is_seq(value)) return value;
  fail(codes::wrong_type, fmt::format("`{}` needs a sequence, but this is `{}`", function,
                                      brief(values, resolution, value)));
}

ValueId ValueBuiltins::require_map(ValueId value, std::string_view function) const {
  if (values.kind(value) == ValueKind::map) return value;
  fail(codes::wrong_type, fmt::format("`{}` needs a map, but this is `{}`", function,
                                      brief(values, resolution, value)));
}

MapEntry ValueBuiltins::require_pair(ValueId value, std::string_view function) const {
  if (values.kind(value) == ValueKind::tuple && values.items(value).size() == 2) {
    return {values.items(value)[0], values.items(value)[1]};
  }
  fail(codes::wrong_type, fmt::format("`{}` needs pairs, but this is `{}`", function,
                                      brief(values, resolution, value)));
}

ValueId ValueBuiltins::all_events() const {
  std::vector<ValueId> events;
  for (const SymbolId channel : resolution.channels) {
    const std::vector<ValueId> all = data.productions(values.make_atom(channel));
    events.insert(events.end(), all.begin(), all.end());
  }
  return values.make_set(std::move(events));
}

// The classes of the symmetric transitive closure, as (representative, member) pairs (3.10.2).
ValueId ValueBuiltins::symmetric_closure(ValueId relation, ValueId elements) const {
  std::map<std::uint32_t, ValueId> parents;  // by bits; a forest towards smaller values
  const auto find = [&](ValueId x) {
    for (auto p = parents.find(x.bits); p != parents.end() && p->second != x;
         p = parents.find(x.bits)) {
      x = p->second;
    }
    return x;
  };
  for (const ValueId pair : elements_of(values, relation, "close")) {
    const auto [a, b] = require_pair(pair, "mtransclose");
    ValueId x = find(a);
    ValueId y = find(b);
    if (x == y) continue;
    if (values.compare(y, x) < 0) std::swap(x, y);
    parents[y.bits] = x;
  }
  std::vector<ValueId> pairs;
  for (const ValueId x : elements_of(values, elements, "close over")) {
    const ValueId representative = find(x);
    if (representative == x || !set_contains(values, resolution, elements, representative))
      continue;
    const ValueId pair[] = {representative, x};
    pairs.push_back(values.make_tuple(pair));
  }
  return values.make_set(std::move(pairs));
}

ValueId ValueBuiltins::apply(Builtin builtin, std::span<const ValueId> arguments) const {
  const std::string_view name = info(builtin).name;
  const auto set = [&](std::size_t i) { return require_set(arguments[i], name); };
  const auto map = [&](std::size_t i) { return require_map(arguments[i], name); };
  const auto seq = [&](std::size_t i) { return require_seq(arguments[i], name); };
  switch (builtin) {
    case Builtin::int_set:
      return values.int_set();
    case Builtin::proc_set:
      return values.proc_set();
    case Builtin::bool_set:
      return values.make_set({values.make_bool(false), values.make_bool(true)});
    case Builtin::char_set: {
      std::vector<ValueId> all;
      for (int c = 0; c < 256; ++c) all.push_back(values.make_char(static_cast<unsigned char>(c)));
      return values.make_set(std::move(all));
    }
    case Builtin::events:
      return all_events();
    case Builtin::true_constant:
      return values.make_bool(true);
    case Builtin::false_constant:
      return values.make_bool(false);
    case Builtin::empty_map:
      return values.empty_map();

    case Builtin::set_union:
      return set_union(values, resolution, set(0), set(1));
    case Builtin::set_inter:
      return set_intersection(values, resolution, set(0), set(1));
    case Builtin::set_diff:
      return set_difference(values, resolution, set(0), set(1));
    case Builtin::set_union_all:
      for (const ValueId inner : elements_of(values, set(0), "form the distributed union of")) {
        require_set(inner, name);
      }
      return union_of_all(values, resolution, arguments[0]);
    case Builtin::set_inter_all:
      for (const ValueId inner :
           elements_of(values, set(0), "form the distributed intersection of")) {
        require_set(inner, name);
      }
      return intersection_of_all(values, resolution, arguments[0]);
    case Builtin::set_member:
      return values.make_bool(set_contains(values, resolution, set(1), arguments[0]));
    case Builtin::set_card:
      return values.make_int(static_cast<std::int64_t>(cardinality(values, set(0))));
    case Builtin::set_empty:
      return values.make_bool(set(0) == values.empty_set() || lists_nothing(values, set(0)));
    case Builtin::set_of_seq: {
      std::vector<ValueId> elements;
      for (ValueId s = seq(0); values.kind(s) == ValueKind::cons; s = values.tail(s)) {
        elements.push_back(values.head(s));
      }
      return values.make_set(std::move(elements));
    }
    case Builtin::power_set:
      return power_set(values, set(0));
    case Builtin::all_sequences:
      return values.make_seq_set(set(0));
    case Builtin::seq_of_set:
      return values.make_seq(elements_of(values, set(0), "make a sequence of"));

    case Builtin::map_from_list: {
      std::vector<MapEntry> entries;
      for (ValueId s = seq(0); values.kind(s) == ValueKind::cons; s = values.tail(s)) {
        entries.push_back(require_pair(values.head(s), name));
      }
      return make_map(values, entries);
    }
    case Builtin::map_lookup:
      if (const std::optional<ValueId> found = map_find(values, map(0), arguments[1]))
        return *found;
      fail(codes::key_not_found,
           fmt::format("the map has no key `{}`", brief(values, resolution, arguments[1])));
    case Builtin::map_member:
      return values.make_bool(map_find(values, map(0), arguments[1]).has_value());
    case Builtin::map_to_list: {
      std::vector<ValueId> pairs;
      for (const auto& [key, value] : map_entries(values, map(0))) {
        const ValueId pair[] = {key, value};
        pairs.push_back(values.make_tuple(pair));
      }
      return values.make_seq(pairs);
    }
    case Builtin::map_update:
      return map_insert(values, map(0), {arguments[1], arguments[2]});
    case Builtin::map_update_many: {
      // Of equal keys the first wins, as in FDR's evaluator (docs/decisions/0004).
      std::vector<MapEntry> updates;
      for (ValueId s = seq(1); values.kind(s) == ValueKind::cons; s = values.tail(s)) {
        updates.push_back(require_pair(values.head(s), name));
      }
      ValueId updated = map(0);
      for (auto update = updates.rbegin(); update != updates.rend(); ++update) {
        updated = map_insert(values, updated, *update);
      }
      return updated;
    }
    case Builtin::map_delete:
      return map_erase(values, map(0), arguments[1]);
    case Builtin::all_maps:
      return all_maps(values, set(0), set(1));

    case Builtin::error: {
      const std::optional<std::string> text = values.as_string(seq(0));
      fail(codes::user_error, text ? *text : brief(values, resolution, arguments[0]));
    }
    case Builtin::show:
      return values.make_string(show_value(show, arguments[0]));
    case Builtin::extensions: {
      data.check_next_field_is_uniform(arguments[0]);
      std::vector<ValueId> found;
      for (const auto& extension : data.extensions(arguments[0], true)) {
        found.push_back(extension.component);
      }
      return values.make_set(std::move(found));
    }
    case Builtin::productions:
      return values.make_set(data.productions(arguments[0]));

    case Builtin::mtransclose:
      return symmetric_closure(set(0), set(1));
    case Builtin::transpose: {
      std::vector<ValueId> pairs;
      for (const ValueId pair : elements_of(values, set(0), "transpose")) {
        const auto [a, b] = require_pair(pair, name);
        const ValueId turned[] = {b, a};
        pairs.push_back(values.make_tuple(turned));
      }
      return values.make_set(std::move(pairs));
    }
    default:
      break;
  }
  PERENTIE_CHECK(false, "a built-in that is no function of values");
  return {};
}

}  // namespace perentie::semantics

#include "data_model.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "brief.hpp"
#include "failure.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"
#include "sets.hpp"

namespace perentie::semantics {

std::span<const ValueId> DataModel::fields(SymbolId symbol) const {
  if (!has_data(symbol)) return {};
  const auto found = fields_.find(symbol.value);
  if (found == fields_.end()) throw NeedFields{symbol};
  return found->second;
}

void DataModel::set_fields(SymbolId symbol, std::vector<ValueId> sets) {
  fields_[symbol.value] = std::move(sets);
}

// A channel or constructor, alone or with some fields, to which a field can be appended directly.
bool DataModel::lacks_field(ValueId value) const {
  const ValueKind kind = values_.kind(value);
  if (kind == ValueKind::atom) return has_data(values_.as_symbol(value));
  if (kind != ValueKind::dot) return false;
  const ValueId head = values_.items(value)[0];
  if (values_.kind(head) != ValueKind::atom || !has_data(values_.as_symbol(head))) return false;
  return values_.items(value).size() - 1 < fields(values_.as_symbol(head)).size();
}

bool DataModel::is_application(ValueId value) const {
  if (values_.kind(value) != ValueKind::dot) return false;
  const ValueId head = values_.items(value)[0];
  return values_.kind(head) == ValueKind::atom && has_data(values_.as_symbol(head));
}

// From the value inwards along last components to the innermost one that lacks a field; empty if
// the value is complete.
std::vector<ValueId> DataModel::incomplete_path(ValueId value) const {
  if (is_complete(value)) return {};
  std::vector<ValueId> path{value};
  while (values_.kind(path.back()) == ValueKind::dot) {
    path.push_back(values_.items(path.back()).back());
  }
  while (!lacks_field(path.back())) path.pop_back();
  return path;
}

bool DataModel::is_complete(ValueId value) const {
  // Data is built from the inside: what is known about a field is not looked for again.
  std::vector<std::uint32_t> seen;
  while (!complete_dots_.contains(value.bits)) {
    if (lacks_field(value)) return false;
    if (values_.kind(value) != ValueKind::dot) break;
    seen.push_back(value.bits);
    value = values_.items(value).back();
  }
  complete_dots_.insert(seen.begin(), seen.end());
  return true;
}

bool DataModel::is_event(ValueId value) const {
  ValueId head = value;
  if (values_.kind(value) == ValueKind::dot) {
    if (!is_application(value)) return false;
    head = values_.items(value)[0];
  }
  return values_.kind(head) == ValueKind::atom &&
         resolution_.symbols[values_.as_symbol(head)].kind == SymbolKind::channel &&
         is_complete(value);
}

// The components that a value contributes when it is appended: a plain dotted value several,
// anything else itself.
std::vector<ValueId> DataModel::components(ValueId value) const {
  if (values_.kind(value) != ValueKind::dot || is_application(value)) return {value};
  const auto items = values_.items(value);
  return {items.begin(), items.end()};
}

ValueId DataModel::append(ValueId left, ValueId right) const {
  const std::uint64_t key = (std::uint64_t{left.bits} << 32U) | right.bits;
  if (const auto known = appended_.find(key); known != appended_.end()) return known->second;
  return appended_[key] = append_all(left, right);
}

ValueId DataModel::append_all(ValueId left, ValueId right) const {
  for (const ValueId component : components(right)) {
    left = append_component(left, component, true);
  }
  return left;
}

ValueId DataModel::with_last(ValueId dot, ValueId last) const {
  const auto items = values_.items(dot);
  std::vector<ValueId> changed(items.begin(), items.end());
  changed.back() = last;
  return values_.make_dot(changed);
}

ValueId DataModel::append_component(ValueId left, ValueId component, bool check) const {
  const std::vector<ValueId> path = incomplete_path(left);
  std::vector<ValueId> items;
  const ValueId target = path.empty() ? left : path.back();
  if (values_.kind(target) == ValueKind::dot && (!path.empty() || !is_application(target))) {
    const auto existing = values_.items(target);
    items.assign(existing.begin(), existing.end());
  } else {
    items.push_back(target);
  }
  items.push_back(component);
  ValueId extended = values_.make_dot(items);
  if (path.empty()) return extended;
  if (check) check_field(extended);
  for (std::size_t i = path.size() - 1; i > 0; --i) {
    extended = with_last(path[i - 1], extended);
    if (check && is_application(extended)) check_field(extended);
  }
  return extended;
}

// The last field of an application, once complete, must be in its declared set (3.6.2).
void DataModel::check_field(ValueId application) const {
  const auto items = values_.items(application);
  const ValueId field = items.back();
  if (!is_complete(field)) return;
  const SymbolId symbol = values_.as_symbol(items[0]);
  const std::size_t index = items.size() - 2;
  const ValueId set = fields(symbol)[index];
  if (set_contains(values_, resolution_, set, field)) return;
  static constexpr std::string_view ordinals[] = {"first", "second", "third", "fourth", "fifth"};
  const std::string which =
      index < std::size(ordinals) ? std::string(ordinals[index]) : fmt::format("{}th", index + 1);
  const Symbol& owner = resolution_.symbols[symbol];
  fail(codes::field_out_of_range,
       fmt::format("`{}` is no value of the {} `{}`: its {} field `{}` is not in {}",
                   brief(values_, resolution_, application),
                   owner.kind == SymbolKind::channel ? "channel" : "constructor", owner.qualified,
                   which, brief(values_, resolution_, field), brief(values_, resolution_, set)));
}

// --- Extensions ---------------------------------------------------------------------------------

// The sets of the fields that a channel or constructor, alone or applied, has not taken yet.
std::span<const ValueId> DataModel::remaining_fields(ValueId application) const {
  const bool is_atom = values_.kind(application) == ValueKind::atom;
  const SymbolId symbol = values_.as_symbol(is_atom ? application : values_.items(application)[0]);
  return fields(symbol).subspan(is_atom ? 0 : values_.items(application).size() - 1);
}

void DataModel::check_next_field_is_uniform(ValueId partial) const {
  const std::vector<ValueId> path = incomplete_path(partial);
  if (path.size() != 1) return;
  const ValueId set = remaining_fields(path[0]).front();
  if (!is_listed(values_, set)) return;
  std::map<std::uint32_t, std::size_t> members;  // by constructor
  for (const ValueId member : values_.items(set)) {
    if (is_application(member)) ++members[values_.as_symbol(values_.items(member)[0]).value];
  }
  if (members.size() < 2) return;
  for (const auto& [constructor, count] : members) {
    std::size_t all = 1;
    for (const ValueId field : fields(SymbolId{constructor})) {
      all *= is_listed(values_, field) ? values_.items(field).size() : 0;  // too many to be all
    }
    if (all == count) continue;
    fail(codes::not_rectangular,
         fmt::format("the next field of `{}` takes some values of several constructors, {}, which "
                     "is not rectangular",
                     brief(values_, resolution_, partial), brief(values_, resolution_, set)));
  }
}

std::vector<ValueId> DataModel::next_components(ValueId partial) const {
  const std::vector<ValueId> path = incomplete_path(partial);
  if (path.empty()) {
    fail(codes::not_an_event,
         fmt::format("`{}` has no field left to take", brief(values_, resolution_, partial)));
  }
  // A declared field set restricts what lies inside the field as well (3.6.3): find the outermost
  // application whose last field is being built, and go through that field's set.
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (!is_application(path[i])) continue;
    const auto items = values_.items(path[i]);
    const ValueId set = fields(values_.as_symbol(items[0]))[items.size() - 2];
    if (!is_listed(values_, set)) continue;
    return components_after(set, std::span(path).subspan(i + 1));
  }
  const ValueId set = remaining_fields(path.back()).front();
  if (!is_listed(values_, set)) {
    const bool finite = is_finite(values_, set);
    fail(finite ? codes::too_large : codes::infinite_set,
         fmt::format("the next field of `{}` ranges over the {} set {}, which cannot be listed",
                     brief(values_, resolution_, partial), finite ? "large" : "infinite",
                     brief(values_, resolution_, set)));
  }
  const auto items = values_.items(set);
  return {items.begin(), items.end()};
}

// The components that follow the partial value path[0] in the elements of a set; path leads to its
// innermost incomplete part.
std::vector<ValueId> DataModel::components_after(ValueId set, std::span<const ValueId> path) const {
  std::vector<ValueId> found;
  for (ValueId element : values_.items(set)) {
    bool matches = true;
    for (std::size_t level = 0; matches && level < path.size(); ++level) {
      const bool innermost = level + 1 == path.size();
      const bool is_atom = values_.kind(path[level]) == ValueKind::atom;
      const auto wanted =
          is_atom ? std::span<const ValueId>(&path[level], 1) : values_.items(path[level]);
      const std::size_t fixed = innermost ? wanted.size() : wanted.size() - 1;
      matches = values_.kind(element) == ValueKind::dot && values_.items(element).size() > fixed &&
                std::equal(wanted.begin(), wanted.begin() + static_cast<std::ptrdiff_t>(fixed),
                           values_.items(element).begin());
      if (matches) element = values_.items(element)[fixed];
    }
    if (matches && (found.empty() || found.back() != element)) found.push_back(element);
  }
  std::vector<ValueId> distinct;
  for (const ValueId component : found) {
    if (std::find(distinct.begin(), distinct.end(), component) == distinct.end()) {
      distinct.push_back(component);
    }
  }
  return distinct;
}

const std::vector<DataModel::Extension>& DataModel::extensions(ValueId partial,
                                                               bool all_remaining) const {
  auto& known = extensions_[all_remaining ? 1 : 0];
  if (const auto found = known.find(partial.bits); found != known.end()) return found->second;
  return known[partial.bits] = find_extensions(partial, all_remaining);
}

// So many extensions that they cannot be listed are refused before they are listed.
void DataModel::check_extension_count(ValueId partial) const {
  const auto refuse = [&] {
    fail(codes::too_large, fmt::format("`{}` has more than {} extensions",
                                       brief(values_, resolution_, partial), max_set_elements));
  };
  if (incomplete_path(partial).size() != 1) return;  // inside a field: bounded by its declared set
  std::size_t count = 1;
  for (const ValueId set : remaining_fields(partial)) {
    if (!is_listed(values_, set)) return;  // refused where it is reached
    const std::size_t size = values_.items(set).size();
    if (size == 0) return;
    if (size > max_set_elements / count) refuse();
    count *= size;
  }
}

std::vector<DataModel::Extension> DataModel::find_extensions(ValueId partial,
                                                             bool all_remaining) const {
  std::vector<Extension> result;
  if (!all_remaining) {
    for (const ValueId component : next_components(partial)) {
      result.push_back({append_component(partial, component, false), component});
    }
    return result;
  }
  check_extension_count(partial);
  struct Open {
    ValueId value;
    std::vector<ValueId> appended;
  };
  std::vector<Open> stack{{partial, {}}};
  bool first = true;
  while (!stack.empty()) {
    Open open = std::move(stack.back());
    stack.pop_back();
    if (!std::exchange(first, false) && is_complete(open.value)) {
      const ValueId component =
          open.appended.size() == 1 ? open.appended[0] : values_.make_dot(open.appended);
      result.push_back({open.value, component});
      continue;
    }
    const std::vector<ValueId> next = next_components(open.value);
    for (auto component = next.rbegin(); component != next.rend(); ++component) {
      std::vector<ValueId> appended = open.appended;
      appended.push_back(*component);
      stack.push_back({append_component(open.value, *component, false), std::move(appended)});
    }
  }
  return result;
}

std::vector<ValueId> DataModel::productions(ValueId partial) const {
  if (is_complete(partial)) return {partial};
  std::vector<ValueId> result;
  for (const Extension& extension : extensions(partial, true)) result.push_back(extension.value);
  return result;
}

// --- Declared sets ------------------------------------------------------------------------------

ValueId DataModel::dot_product(std::span<const ValueId> sets) const {
  if (!can_list_product(values_, sets)) {
    // Plain dotted values: one field for each component of each factor.
    std::vector<ValueId> columns;
    for (const ValueId set : sets) {
      const std::vector<ValueId> parts = decompose(set);
      columns.insert(columns.end(), parts.begin(), parts.end());
      if (is_listed(values_, set) && !is_complete(values_.items(set)[0])) {
        fail_unlisted(values_, values_.make_set_over(ValueKind::tuple_set, sets),
                      "complete constructors with the fields of");
      }
    }
    return values_.make_set_over(ValueKind::dot_set, columns);
  }
  std::vector<ValueId> products;
  const ValueId tuples = tuple_product(values_, sets);
  for (std::size_t n = 0; n < values_.items(tuples).size(); ++n) {
    const ValueId tuple = values_.items(tuples)[n];
    std::size_t i = values_.items(tuple).size() - 1;
    ValueId value = values_.items(tuple)[i];
    while (i-- > 0) value = append(values_.items(tuple)[i], value);
    products.push_back(value);
  }
  return values_.make_set(std::move(products));
}

std::vector<ValueId> DataModel::decompose(ValueId set) const {
  if (values_.kind(set) == ValueKind::dot_set) {
    const auto items = values_.items(set);
    return {items.begin(), items.end()};
  }
  if (!is_listed(values_, set) || set == values_.empty_set()) return {set};
  std::vector<std::vector<ValueId>> rows;
  for (const ValueId element : values_.items(set)) rows.push_back(components(element));
  const std::size_t width = rows[0].size();
  if (std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.size() == 1; })) {
    return {set};
  }
  const auto not_rectangular = [&](const std::string& why) {
    fail(codes::not_rectangular,
         fmt::format("the set {} is not rectangular, so it cannot be the type of fields: {}",
                     brief(values_, resolution_, set), why));
  };
  if (std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.size() != width; })) {
    not_rectangular("its elements have different numbers of components");
  }
  std::vector<ValueId> columns;
  std::size_t product = 1;
  for (std::size_t i = 0; i < width; ++i) {
    std::vector<ValueId> column;
    for (const auto& row : rows) column.push_back(row[i]);
    columns.push_back(values_.make_set(std::move(column)));
    product *= values_.items(columns.back()).size();
  }
  if (product == rows.size()) return columns;
  // Name one missing value: the first row of the product that the set lacks.
  std::vector<std::size_t> at(width, 0);
  for (;;) {
    std::vector<ValueId> row;
    for (std::size_t i = 0; i < width; ++i) row.push_back(values_.items(columns[i])[at[i]]);
    if (std::find(rows.begin(), rows.end(), row) == rows.end()) {
      not_rectangular(
          fmt::format("it lacks `{}`", brief(values_, resolution_, values_.make_dot(row))));
    }
    for (std::size_t i = width; i > 0 && ++at[i - 1] == values_.items(columns[i - 1]).size(); --i) {
      at[i - 1] = 0;
    }
  }
}

}  // namespace perentie::semantics

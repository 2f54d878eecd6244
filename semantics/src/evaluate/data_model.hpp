// Dots: how channels and constructors take their fields (CSPM reference 2.3, 3.6).
//
// A dotted value is flat: a constructor or channel followed by its fields, each a whole value; a
// completed constructor application is one component of what it stands in. `c.A.0.x` with
// `datatype T = A.{0}` is therefore [c, [A, 0], x].
#pragma once

#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "code.hpp"
#include "perentie/semantics/symbols.hpp"
#include "perentie/semantics/value.hpp"

namespace perentie::semantics {

class DataModel {
 public:
  DataModel(ValueStore& values, const Resolution& resolution, const Program& program)
      : values_(values), resolution_(resolution), program_(program) {}

  /// The sets of a channel's or constructor's fields. Throws NeedFields until they are known.
  std::span<const ValueId> fields(SymbolId symbol) const;
  bool knows_fields(SymbolId symbol) const { return fields_.contains(symbol.value); }
  void set_fields(SymbolId symbol, std::vector<ValueId> sets);

  bool has_data(SymbolId symbol) const { return program_.field_types.contains(symbol.value); }
  /// Nothing is missing: not a channel or constructor that still lacks a field.
  bool is_complete(ValueId value) const;
  /// A complete application of a channel.
  bool is_event(ValueId value) const;

  /// `left.right` (3.6.1): the components of `right` go, one by one, into the innermost incomplete
  /// constructor. A field that becomes complete must be in its declared set.
  ValueId append(ValueId left, ValueId right) const;

  /// A way to extend a partial value: what was appended, and the result.
  struct Extension {
    ValueId value;
    ValueId component;
  };
  /// The values that the next field can take; with `all_remaining`, all missing fields together as
  /// one dotted value (4.3.5). In the order of sets. The result lives as long as the model.
  const std::vector<Extension>& extensions(ValueId partial, bool all_remaining) const;
  /// Fails if the next field takes only some values of several constructors, whose extensions FDR
  /// does not list (2.3.6).
  void check_next_field_is_uniform(ValueId partial) const;
  /// All complete values that begin with `partial` (3.6.5).
  std::vector<ValueId> productions(ValueId partial) const;

  /// All dotted values of one component from each set (2.3.2).
  ValueId dot_product(std::span<const ValueId> sets) const;
  /// A declared set as one set per field: a set of plain dotted values must be a Cartesian product
  /// (2.3.4), any other set is one field.
  std::vector<ValueId> decompose(ValueId set) const;

 private:
  ValueId append_all(ValueId left, ValueId right) const;
  std::vector<Extension> find_extensions(ValueId partial, bool all_remaining) const;
  void check_extension_count(ValueId partial) const;
  std::vector<ValueId> incomplete_path(ValueId value) const;
  bool lacks_field(ValueId value) const;
  bool is_application(ValueId value) const;
  std::vector<ValueId> components(ValueId value) const;
  ValueId append_component(ValueId left, ValueId component, bool check) const;
  ValueId with_last(ValueId dot, ValueId last) const;
  void check_field(ValueId application) const;
  std::span<const ValueId> remaining_fields(ValueId application) const;
  std::vector<ValueId> next_components(ValueId partial) const;
  std::vector<ValueId> components_after(ValueId set, std::span<const ValueId> path) const;

  ValueStore& values_;
  const Resolution& resolution_;
  const Program& program_;
  std::unordered_map<std::uint32_t, std::vector<ValueId>> fields_;  // by symbol

  // What was computed before: values are hash-consed, and models ask for the same again and again.
  mutable std::unordered_map<std::uint64_t, ValueId> appended_;  // by both operands
  mutable std::unordered_map<std::uint32_t, std::vector<Extension>> extensions_[2];  // by value
  mutable std::unordered_set<std::uint32_t> complete_dots_;                          // by value
};

}  // namespace perentie::semantics

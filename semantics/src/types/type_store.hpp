// Type terms: what the type checker unifies (CSPM reference 3.1).
//
// Terms are nodes named by ids. A variable is a node that may be bound to another later; `find`
// follows the bindings. A channel of two fields is `Int => Bool => Event`; something that may take
// further fields to become an event is `a =>* Event`, whose first part is the list of the fields
// still missing: a variable, `no_fields`, or a dot of a field and a list.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/base/id.hpp"
#include "perentie/base/interner.hpp"
#include "perentie/semantics/symbols.hpp"

namespace perentie::semantics {

using TypeRef = base::Id<struct TypeRefTag>;

enum class TypeKind : std::uint8_t {
  variable,
  any,  // of what had an error: agrees with everything
  integer,
  boolean,
  character,
  event,
  process,
  datatype,
  set,         // element
  sequence,    // element
  tuple,       // items
  map,         // key, value
  function,    // arguments, then the result
  dot,         // left, right
  yield,       // argument, result: `a => b`
  extendable,  // missing fields, result: `a =>* b`
  no_fields,   // the empty list of missing fields
};

// The constraints on a variable, as bits (3.1.2).
enum class Constraint : std::uint8_t { eq = 1, ord = 2, set = 4, complete = 8, yieldable = 16 };
inline constexpr Constraint all_constraints[] = {Constraint::eq, Constraint::ord, Constraint::set,
                                                 Constraint::complete, Constraint::yieldable};
std::string_view name_of(Constraint constraint);

struct ConstraintSet {
  std::uint8_t bits = 0;

  void add(Constraint c) { bits = static_cast<std::uint8_t>(bits | static_cast<std::uint8_t>(c)); }
  void add(ConstraintSet other) { bits = static_cast<std::uint8_t>(bits | other.bits); }
  // Whether the set says or implies `c`: Eq implies Set, and so does Ord, which implies Eq.
  bool implies(Constraint c) const;
  bool contains(Constraint c) const { return (bits & static_cast<std::uint8_t>(c)) != 0; }
};

struct TypeNode {
  TypeKind kind;
  bool is_rigid = false;           // a variable of an annotation: it stands for every type
  ConstraintSet constraints = {};  // of a variable
  TypeRef bound = {};              // what stands in the place of this node, if anything
  base::NameId name = {};          // of a rigid variable
  SymbolId datatype = {};
  std::uint32_t first = 0;  // the children
  std::uint32_t count = 0;
};

class TypeStore {
 public:
  TypeStore();

  TypeRef any() const { return simple(TypeKind::any); }
  TypeRef integer() const { return simple(TypeKind::integer); }
  TypeRef boolean() const { return simple(TypeKind::boolean); }
  TypeRef character() const { return simple(TypeKind::character); }
  TypeRef event() const { return simple(TypeKind::event); }
  TypeRef process() const { return simple(TypeKind::process); }
  TypeRef no_fields() const { return simple(TypeKind::no_fields); }
  TypeRef variable(ConstraintSet constraints = {});
  TypeRef variable(Constraint constraint);
  TypeRef rigid_variable(base::NameId name, ConstraintSet constraints);
  TypeRef datatype(SymbolId symbol);
  TypeRef set(TypeRef element) { return make(TypeKind::set, {&element, 1}); }
  TypeRef sequence(TypeRef element) { return make(TypeKind::sequence, {&element, 1}); }
  TypeRef tuple(std::span<const TypeRef> items) { return make(TypeKind::tuple, items); }
  TypeRef map(TypeRef key, TypeRef value) { return pair(TypeKind::map, key, value); }
  // `parts`: the arguments, then the result.
  TypeRef function(std::span<const TypeRef> parts) { return make(TypeKind::function, parts); }
  TypeRef dot(TypeRef left, TypeRef right) { return pair(TypeKind::dot, left, right); }
  TypeRef dots(std::span<const TypeRef> items);  // one or more
  TypeRef yield(TypeRef argument, TypeRef result) {
    return pair(TypeKind::yield, argument, result);
  }
  TypeRef extendable(TypeRef missing, TypeRef result) {
    return pair(TypeKind::extendable, missing, result);
  }

  // The node that stands for a term: bindings are followed, a `=>*` whose missing fields are known
  // is what it stands for, and the argument of a `=>` is one field.
  TypeRef find(TypeRef type);

  const TypeNode& operator[](TypeRef type) const { return nodes_[type.value]; }
  TypeKind kind(TypeRef type) const { return nodes_[type.value].kind; }
  // Not valid after the next term is made.
  std::span<const TypeRef> children(TypeRef type) const {
    const TypeNode& node = nodes_[type.value];
    return std::span<const TypeRef>(children_).subspan(node.first, node.count);
  }
  TypeRef child(TypeRef type, std::size_t i) const { return children(type)[i]; }
  bool is_flexible(TypeRef type) const {
    return kind(type) == TypeKind::variable && !nodes_[type.value].is_rigid;
  }

  void bind(TypeRef variable, TypeRef type) { nodes_[variable.value].bound = type; }
  void constrain(TypeRef variable, ConstraintSet constraints) {
    nodes_[variable.value].constraints.add(constraints);
  }
  // The variables in `type` that nothing has bound, each once, in order of appearance.
  std::vector<TypeRef> free_variables(TypeRef type);
  // The dots in `type` that are not parts of others.
  std::vector<TypeRef> dots_in(TypeRef type);
  // The type with fresh variables, as constrained, for those of `variables`.
  TypeRef instantiate(TypeRef type, std::span<const TypeRef> variables);

  std::size_t size() const { return nodes_.size(); }

 private:
  static TypeRef simple(TypeKind kind) { return TypeRef{static_cast<std::uint32_t>(kind)}; }
  TypeRef add(TypeNode node);
  // Calls `visit` for every node of a term, once each, and for what is below it if that says so.
  template <class Visit>
  void walk(TypeRef type, Visit visit);
  TypeRef make(TypeKind kind, std::span<const TypeRef> children);
  TypeRef pair(TypeKind kind, TypeRef left, TypeRef right);

  std::vector<TypeNode> nodes_;
  std::vector<TypeRef> children_;
  std::vector<std::uint32_t> marks_;  // by node: the visit that saw it last
  std::uint32_t visit_ = 0;
};

// The type as FDR prints it: `(a, {a}) -> Bool`, or with its constraints `Eq a => (a, {a}) -> Bool`
// (3.1.9).
std::string show_type(TypeStore& types, const Resolution& resolution, const base::Interner& names,
                      TypeRef type, bool with_constraints);

}  // namespace perentie::semantics

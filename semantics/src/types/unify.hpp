// Unification of types, with the dot types of CSPM (CSPM reference 3.1).
//
// `c.x.y` is a list of types. Where its first part is known to be `a => b`, the list is reduced:
// the next part is the field `a`, and what remains is a `b`. A variable behind such a part keeps
// the list as it is until something asks for more (3.1.7): an event or a value of a datatype makes
// the last variable take all the fields that are left, `a =>* b` makes it take one, and a variable
// further left takes one in any case.
#pragma once

#include <optional>
#include <vector>

#include "type_store.hpp"

namespace perentie::semantics {

// Why two types do not agree.
struct TypeClash {
  enum class Kind : std::uint8_t {
    different,    // `left` and `right`
    unsatisfied,  // `left` does not satisfy `constraint`
    infinite,     // `left` would be a part of itself
    rigid,        // `left`, a variable of an annotation, would have to be `right`
    too_deep,
  };
  Kind kind;
  TypeRef left = {};
  TypeRef right = {};
  Constraint constraint = {};
};

class Unifier {
 public:
  Unifier(TypeStore& types, const Resolution& resolution)
      : types_(types), is_eq_(resolution.symbols.size(), true) {}

  // Makes two types equal. On failure, `clash()` says why, and some variables may be bound.
  bool unify(TypeRef left, TypeRef right);
  // Makes a type satisfy a constraint, by constraining its variables.
  bool require(Constraint constraint, TypeRef type);
  // The type as far as it is known: bindings followed, dots reduced.
  std::optional<TypeRef> known(TypeRef type);
  // The type of a dot whose last variable takes all the fields that are left.
  std::optional<TypeRef> completed(TypeRef dot);
  const TypeClash& clash() const { return clash_; }

  // Whether values of a datatype can be compared: assumed until it is told otherwise.
  bool is_eq(SymbolId datatype) const {
    return datatype.value >= is_eq_.size() || is_eq_[datatype.value];
  }
  void set_not_eq(SymbolId datatype) {
    if (datatype.value >= is_eq_.size()) is_eq_.resize(datatype.value + 1, true);
    is_eq_[datatype.value] = false;
    satisfied_.clear();
  }
  // The datatypes whose values were asked to be comparable since the last call.
  std::vector<SymbolId> take_eq_assumptions() { return std::exchange(eq_assumptions_, {}); }

 private:
  using List = std::vector<TypeRef>;
  // How many fields the last variable of a stuck list takes.
  enum class Match : std::uint8_t { longest, shortest };

  bool fail(TypeClash clash) {
    clash_ = clash;
    return false;
  }
  bool different(TypeRef left, TypeRef right) {
    return fail({TypeClash::Kind::different, left, right});
  }

  bool unify_known(TypeRef left, TypeRef right);
  bool unify_parts(TypeRef left, TypeRef right);
  bool unify_yields(TypeRef left, TypeRef right);
  bool unify_extendable(TypeRef extendable, TypeRef other);
  bool bind(TypeRef variable, TypeRef type);
  bool contains(TypeRef type, TypeRef variable);
  bool complete_dots(TypeRef type);

  std::optional<List> reduced(TypeRef dot);
  bool is_dot_of(TypeRef dot, const List& list);
  bool put_before(TypeRef head, List& list);
  bool put_yield_before(TypeRef yield, List& list);
  bool put_extendable_before(TypeRef extendable, List& list);
  bool is_stuck(const List& list);
  bool resolve_stuck(List& list, Match match, std::size_t fields_kept);
  bool unify_dot(TypeRef dot, TypeRef other);
  bool unify_list(List list, TypeRef other);
  bool unify_head_variable(const List& list, TypeRef other);
  bool unify_lists(List left, List right);
  // The fields that a `=>` still takes, and what it is then.
  struct Chain {
    List fields;
    TypeRef result;
  };
  Chain chain(TypeRef yield);
  TypeRef yields(std::span<const TypeRef> fields, TypeRef result);

  bool require_once(Constraint constraint, TypeRef type);
  bool require_known(Constraint constraint, TypeRef type);
  bool require_of_variable(Constraint constraint, TypeRef variable);
  bool require_all(Constraint constraint, TypeRef type);

  TypeStore& types_;
  TypeClash clash_{};
  std::vector<bool> is_eq_;
  std::vector<SymbolId> eq_assumptions_;
  std::vector<ConstraintSet> satisfied_;  // by type: what it was found to satisfy
  std::size_t depth_ = 0;
};

}  // namespace perentie::semantics

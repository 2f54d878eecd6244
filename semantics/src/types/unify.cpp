// Unification of everything but dots, which are in unify_dots.cpp.
#include "unify.hpp"

#include <algorithm>

namespace perentie::semantics {
namespace {

// Types nest as deeply as scripts and data do; each level takes a few calls.
constexpr std::size_t max_depth = 2000;

}  // namespace

bool Unifier::unify(TypeRef left, TypeRef right) {
  if (types_.find(left) == types_.find(right)) return true;
  if (depth_ >= max_depth) return fail({.kind = TypeClash::Kind::too_deep, .left = left});
  ++depth_;
  const auto known_left = known(left);
  const auto known_right = known_left ? known(right) : std::nullopt;
  const bool ok = known_left && known_right && unify_known(*known_left, *known_right);
  --depth_;
  return ok;
}

bool Unifier::unify_known(TypeRef left, TypeRef right) {
  if (left == right) return true;
  const TypeKind l = types_.kind(left);
  const TypeKind r = types_.kind(right);
  if (types_.is_flexible(left)) return bind(left, right);
  if (types_.is_flexible(right)) return bind(right, left);
  if (l == TypeKind::any || r == TypeKind::any) return true;
  if (l == TypeKind::dot) return unify_dot(left, right);
  if (r == TypeKind::dot) return unify_dot(right, left);
  if (l == TypeKind::extendable) return unify_extendable(left, right);
  if (r == TypeKind::extendable) return unify_extendable(right, left);
  if (l != r) {
    if (l == TypeKind::variable) return fail({TypeClash::Kind::rigid, left, right});
    if (r == TypeKind::variable) return fail({TypeClash::Kind::rigid, right, left});
    return different(left, right);
  }
  switch (l) {
    case TypeKind::variable:
      return fail({TypeClash::Kind::rigid, left, right});
    case TypeKind::datatype:
      return types_[left].datatype == types_[right].datatype || different(left, right);
    case TypeKind::yield:
      return unify_yields(left, right);
    default:
      return unify_parts(left, right);
  }
}

bool Unifier::unify_parts(TypeRef left, TypeRef right) {
  const std::size_t count = types_.children(left).size();
  if (count != types_.children(right).size()) return different(left, right);
  for (std::size_t i = 0; i < count; ++i) {
    if (!unify(types_.child(left, i), types_.child(right, i))) return false;
  }
  // Shared parts are compared once.
  if (count > 1) types_.bind(left, right);
  return true;
}

// Field by field. Where one side has fewer, its result takes the others if it may, or else its last
// field does (3.6.4).
bool Unifier::unify_yields(TypeRef left, TypeRef right) {
  Chain shorter = chain(left);
  Chain longer = chain(right);
  if (shorter.fields.size() > longer.fields.size()) std::swap(shorter, longer);
  std::size_t pairs = shorter.fields.size();
  const bool differ = pairs < longer.fields.size();
  const bool result_takes_fields =
      types_.kind(shorter.result) == TypeKind::extendable ||
      types_.kind(shorter.result) == TypeKind::dot ||
      types_.kind(shorter.result) == TypeKind::any ||
      (types_.is_flexible(shorter.result) &&
       !types_[shorter.result].constraints.implies(Constraint::complete));
  if (differ && !result_takes_fields) {
    --pairs;
    const TypeRef last = types_.find(shorter.fields.back());
    if (!types_.is_flexible(last)) return different(left, right);
    if (!unify(last, types_.dots(std::span(longer.fields).subspan(pairs)))) return false;
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    if (!unify(shorter.fields[i], longer.fields[i])) return false;
  }
  const TypeRef rest = differ && result_takes_fields
                           ? yields(std::span(longer.fields).subspan(pairs), longer.result)
                           : longer.result;
  return unify(shorter.result, rest);
}

// `other` is no variable and no dot. `a =>* b` is a `b`, or a `=>` that ends in one.
bool Unifier::unify_extendable(TypeRef extendable, TypeRef other) {
  const TypeRef missing = types_.find(types_.child(extendable, 0));
  const TypeRef result = types_.child(extendable, 1);
  if (types_.kind(other) == TypeKind::extendable) {
    return unify(missing, types_.child(other, 0)) && unify(result, types_.child(other, 1));
  }
  if (!types_.is_flexible(missing)) {
    if (types_.kind(missing) == TypeKind::variable) {
      return fail({TypeClash::Kind::rigid, extendable, other});
    }
    return different(extendable, other);
  }
  if (types_.kind(other) != TypeKind::yield) {
    return bind(missing, types_.no_fields()) && unify(result, other);
  }
  const TypeRef field = types_.child(other, 0);
  const TypeRef after = types_.child(other, 1);
  const TypeRef rest = types_.variable();
  return bind(missing, types_.dot(field, rest)) && unify(types_.extendable(rest, result), after);
}

bool Unifier::bind(TypeRef variable, TypeRef type) {
  if (types_.is_flexible(type)) {
    types_.constrain(type, types_[variable].constraints);
    types_.bind(variable, type);
    return true;
  }
  if (contains(type, variable)) {
    return complete_dots(type) ? unify(variable, type)
                               : fail({TypeClash::Kind::infinite, variable, type});
  }
  const ConstraintSet constraints = types_[variable].constraints;
  types_.bind(variable, type);
  return std::all_of(std::begin(all_constraints), std::end(all_constraints),
                     [&](Constraint c) { return !constraints.contains(c) || require(c, type); });
}

// A dot that waits for a variable may hold it without being infinite: `c.x` is an event, and x one.
bool Unifier::complete_dots(TypeRef type) {
  const std::vector<TypeRef> dots = types_.dots_in(type);
  return !dots.empty() && std::all_of(dots.begin(), dots.end(), [&](TypeRef dot) {
    const auto whole = completed(dot) ? known(dot) : std::nullopt;
    return whole && types_.kind(*whole) != TypeKind::dot;
  });
}

bool Unifier::contains(TypeRef type, TypeRef variable) {
  const std::vector<TypeRef> variables = types_.free_variables(type);
  return std::find(variables.begin(), variables.end(), variable) != variables.end();
}

// --- Constraints --------------------------------------------------------------------------------

bool Unifier::require(Constraint constraint, TypeRef type) {
  if (depth_ >= max_depth) return fail({.kind = TypeClash::Kind::too_deep, .left = type});
  ++depth_;
  const auto is = known(type);
  const bool ok = is && require_once(constraint, *is);
  --depth_;
  return ok;
}

// Types may share parts. Variables remember their constraints, so what was found once holds.
bool Unifier::require_once(Constraint constraint, TypeRef type) {
  const TypeKind kind = types_.kind(type);
  const bool may_share = kind == TypeKind::tuple || kind == TypeKind::map;
  if (!may_share) return require_known(constraint, type);
  satisfied_.resize(types_.size());
  if (satisfied_[type.value].contains(constraint)) return true;
  if (!require_known(constraint, type)) return false;
  satisfied_.resize(types_.size());
  satisfied_[type.value].add(constraint);
  return true;
}

bool Unifier::require_of_variable(Constraint constraint, TypeRef variable) {
  if (types_[variable].constraints.implies(constraint)) return true;
  if (types_[variable].is_rigid) {
    // The bare name of an annotation stands for a complete value.
    if (constraint == Constraint::complete) return true;
    return fail({TypeClash::Kind::unsatisfied, variable, {}, constraint});
  }
  ConstraintSet constraints;
  constraints.add(constraint);
  types_.constrain(variable, constraints);
  return true;
}

bool Unifier::require_all(Constraint constraint, TypeRef type) {
  const std::size_t count = types_.children(type).size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!require(constraint, types_.child(type, i))) return false;
  }
  return true;
}

// The tables of CSPM reference 3.1.2 to 3.1.6.
bool Unifier::require_known(Constraint constraint, TypeRef type) {
  const TypeKind kind = types_.kind(type);
  const auto unsatisfied = [&] {
    return fail({TypeClash::Kind::unsatisfied, type, {}, constraint});
  };
  if (kind == TypeKind::any) return true;
  if (kind == TypeKind::variable) return require_of_variable(constraint, type);
  if (constraint == Constraint::complete || constraint == Constraint::yieldable) {
    TypeRef whole = type;
    if (kind == TypeKind::dot) {
      const auto all = completed(type);
      if (!all) return false;
      whole = *all;
    }
    if (constraint == Constraint::complete) {
      return types_.kind(whole) != TypeKind::yield || unsatisfied();
    }
    if (types_.is_flexible(whole)) return require_of_variable(constraint, whole);
    return types_.kind(whole) == TypeKind::event || types_.kind(whole) == TypeKind::datatype ||
           types_.kind(whole) == TypeKind::extendable || unsatisfied();
  }
  switch (kind) {
    case TypeKind::integer:
    case TypeKind::character:
      return true;
    case TypeKind::boolean:
    case TypeKind::event:
      return constraint != Constraint::ord || unsatisfied();
    case TypeKind::datatype:
      if (constraint == Constraint::ord) return unsatisfied();
      if (constraint == Constraint::set) return true;
      if (!is_eq(types_[type].datatype)) return unsatisfied();
      eq_assumptions_.push_back(types_[type].datatype);
      return true;
    case TypeKind::process:
      return constraint == Constraint::set || unsatisfied();
    case TypeKind::function:
      return unsatisfied();
    case TypeKind::set:
    case TypeKind::sequence:
      // The order of sets and sequences asks for equal elements (3.1.4).
      return require(constraint == Constraint::ord ? Constraint::eq : constraint,
                     types_.child(type, 0));
    case TypeKind::yield:
    case TypeKind::extendable:
      if (constraint == Constraint::ord) return unsatisfied();
      return kind == TypeKind::yield ? require_all(constraint, type)
                                     : require(constraint, types_.child(type, 1));
    default:
      return require_all(constraint, type);
  }
}

}  // namespace perentie::semantics

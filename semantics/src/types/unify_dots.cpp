// Dots: lists of types, reduced as far as it is known what takes fields.
#include <algorithm>

#include "unify.hpp"

namespace perentie::semantics {

std::optional<TypeRef> Unifier::known(TypeRef type) {
  type = types_.find(type);
  if (types_.kind(type) != TypeKind::dot) return type;
  const auto list = reduced(type);
  if (!list) return std::nullopt;
  if (is_dot_of(type, *list)) return type;
  const TypeRef whole = types_.find(types_.dots(*list));
  types_.bind(type, whole);
  return whole;
}

// Whether a dot, with its parts nested to the right, is that of a list.
bool Unifier::is_dot_of(TypeRef dot, const List& list) {
  for (std::size_t i = 0; i + 1 < list.size(); ++i) {
    if (types_.kind(dot) != TypeKind::dot || types_.find(types_.child(dot, 0)) != list[i]) {
      return false;
    }
    dot = types_.find(types_.child(dot, 1));
  }
  return dot == list.back();
}

// The parts of a dot, reduced: one part, or several where the first is not followed by its field.
std::optional<Unifier::List> Unifier::reduced(TypeRef dot) {
  List parts;  // from right to left
  List stack{dot};
  while (!stack.empty()) {
    const TypeRef top = types_.find(stack.back());
    stack.pop_back();
    if (types_.kind(top) == TypeKind::dot) {
      stack.push_back(types_.child(top, 0));
      stack.push_back(types_.child(top, 1));
    } else {
      parts.push_back(top);
    }
  }
  List list;
  for (const TypeRef part : parts) {
    if (!put_before(part, list)) return std::nullopt;
  }
  std::reverse(list.begin(), list.end());
  return list;
}

// Puts a part in front of a reduced list. Lists are built from right to left: the front is at the
// end of the vector.
bool Unifier::put_before(TypeRef head, List& list) {
  if (!list.empty() && types_.kind(head) == TypeKind::yield) return put_yield_before(head, list);
  if (!list.empty() && types_.kind(head) == TypeKind::extendable) {
    return put_extendable_before(head, list);
  }
  list.push_back(head);
  return true;
}

bool Unifier::put_yield_before(TypeRef head, List& list) {
  while (!list.empty() && types_.kind(head) == TypeKind::yield) {
    const TypeRef field = types_.child(head, 0);
    const TypeRef after = types_.child(head, 1);
    const TypeRef next = types_.find(list.back());
    if (types_.is_flexible(next) && next != types_.find(field)) break;
    list.pop_back();
    if (types_.kind(next) == TypeKind::yield) {
      // The field is a value that itself takes fields first.
      const Chain inner = chain(next);
      if (!unify(field, inner.result)) return false;
      head = yields(inner.fields, after);
      // Where the list is stuck behind `next`, it now is behind `head`.
      break;
    }
    const bool field_is_extendable = types_.kind(types_.find(field)) == TypeKind::extendable;
    if (types_.kind(next) == TypeKind::extendable && !field_is_extendable) {
      const TypeRef missing = types_.child(next, 0);
      if (!unify(field, types_.child(next, 1))) return false;
      head = types_.extendable(missing, after);
      break;
    }
    if (!unify(field, next)) return false;
    const auto rest = known(after);
    if (!rest) return false;
    head = *rest;
  }
  if (!list.empty() && types_.kind(head) == TypeKind::extendable) {
    return put_extendable_before(head, list);
  }
  list.push_back(head);
  return true;
}

// Something that may take fields is given some, so it takes these.
bool Unifier::put_extendable_before(TypeRef head, List& list) {
  while (!list.empty()) {
    const TypeRef missing = types_.find(types_.child(head, 0));
    const TypeRef result = types_.child(head, 1);
    if (!types_.is_flexible(missing)) return fail({TypeClash::Kind::rigid, head, list.back()});
    const TypeRef rest = types_.variable();
    if (!bind(missing, types_.dot(list.back(), rest))) return false;
    list.pop_back();
    head = types_.extendable(rest, result);
  }
  list.push_back(head);
  return true;
}

Unifier::Chain Unifier::chain(TypeRef yield) {
  Chain found{{}, types_.find(yield)};
  while (types_.kind(found.result) == TypeKind::yield) {
    found.fields.push_back(types_.child(found.result, 0));
    found.result = types_.find(types_.child(found.result, 1));
  }
  return found;
}

TypeRef Unifier::yields(std::span<const TypeRef> fields, TypeRef result) {
  for (auto field = fields.rbegin(); field != fields.rend(); ++field) {
    result = types_.yield(*field, result);
  }
  return result;
}

// --- Lists that wait for a field
// ------------------------------------------------------------------

bool Unifier::is_stuck(const List& list) {
  return list.size() > 1 && types_.kind(list.front()) == TypeKind::yield;
}

// Gives the variable behind the first part its fields: one, or as the last part all but
// `fields_kept`, or one. If there is one field for the variable and what follows it, that field is
// all of this: the variable is a constructor that takes it.
bool Unifier::resolve_stuck(List& list, Match match, std::size_t fields_kept) {
  const TypeRef variable = list[1];
  const Chain all = chain(list[0]);
  const TypeKind result = types_.kind(all.result);
  const bool is_complete = result == TypeKind::event || result == TypeKind::datatype;
  if (list.size() > 2 && all.fields.size() == 1 && is_complete) {
    if (!unify(types_.dots(std::span(list).subspan(1)), all.fields.front())) return false;
    list = {all.result};
    return true;
  }
  std::size_t taken = 1;
  if (list.size() == 2 && match == Match::longest && all.fields.size() > fields_kept) {
    taken = all.fields.size() - fields_kept;
  }
  const TypeRef fields = types_.dots(std::span(all.fields).first(taken));
  if (!unify(variable, fields)) return false;
  const auto next = reduced(types_.dots(list));
  if (!next) return false;
  list = *next;
  return true;
}

std::optional<TypeRef> Unifier::completed(TypeRef dot) {
  auto list = reduced(dot);
  while (list && is_stuck(*list)) {
    if (!resolve_stuck(*list, Match::longest, 0)) return std::nullopt;
  }
  if (!list) return std::nullopt;
  return list->size() == 1 ? types_.find(list->front()) : types_.dots(*list);
}

bool Unifier::unify_dot(TypeRef dot, TypeRef other) {
  const auto list = reduced(dot);
  if (!list) return false;
  const auto is_any = [&](TypeRef part) { return types_.kind(types_.find(part)) == TypeKind::any; };
  if (std::any_of(list->begin(), list->end(), is_any)) return true;
  if (types_.kind(other) != TypeKind::dot) return unify_list(*list, other);
  const auto others = reduced(other);
  return others && unify_lists(*list, *others);
}

// `other` is neither a dot nor a variable that could be bound.
bool Unifier::unify_list(List list, TypeRef other) {
  while (is_stuck(list)) {
    const TypeKind kind = types_.kind(other);
    const std::size_t kept = kind == TypeKind::yield ? chain(other).fields.size() : 0;
    const Match match = kind == TypeKind::extendable ? Match::shortest : Match::longest;
    if (!resolve_stuck(list, match, kept)) return false;
  }
  if (list.size() == 1) return unify(list.front(), other);
  if (types_.is_flexible(list.front())) return unify_head_variable(list, other);
  return different(types_.dots(list), other);
}

// `x.a.b` is to be an `other`: x takes the fields a and b.
bool Unifier::unify_head_variable(const List& list, TypeRef other) {
  const TypeKind kind = types_.kind(other);
  if (kind != TypeKind::event && kind != TypeKind::datatype && kind != TypeKind::yield &&
      kind != TypeKind::extendable && kind != TypeKind::variable) {
    return different(types_.dots(list), other);
  }
  const auto tail = completed(types_.dots(std::span(list).subspan(1)));
  if (!tail) return false;
  List fields;
  if (types_.kind(*tail) == TypeKind::dot) {
    const auto parts = reduced(*tail);
    if (!parts) return false;
    fields = *parts;
  } else {
    fields.push_back(*tail);
  }
  // A last field that is itself incomplete makes the whole incomplete.
  TypeRef result = other;
  if (types_.kind(fields.back()) == TypeKind::yield) {
    const Chain inner = chain(fields.back());
    for (const TypeRef field : inner.fields) {
      const auto outer = known(result);
      if (!outer) return false;
      const TypeRef after = types_.variable();
      if (!unify(*outer, types_.yield(field, after))) return false;
      result = after;
    }
    fields.back() = inner.result;
  }
  return unify(list.front(), yields(fields, result));
}

// Two dots that are not reduced further: part by part; the last part takes what is left.
bool Unifier::unify_lists(List left, List right) {
  const bool left_stuck = is_stuck(left);
  const bool right_stuck = is_stuck(right);
  if (left_stuck != right_stuck) {
    const List& waiting = left_stuck ? left : right;
    const List& other = left_stuck ? right : left;
    if (waiting.size() == 2 && !types_.is_flexible(other[0])) {
      // The last variable takes all fields and what follows the whole.
      const Chain all = chain(waiting[0]);
      List taken = all.fields;
      taken.insert(taken.end(), other.begin() + 1, other.end());
      return unify(all.result, other[0]) && unify(waiting[1], types_.dots(taken));
    }
  }
  if (left_stuck || right_stuck) {
    if (left_stuck && !resolve_stuck(left, Match::longest, 0)) return false;
    if (right_stuck && !resolve_stuck(right, Match::longest, 0)) return false;
    return unify(types_.dots(left), types_.dots(right));
  }
  const std::size_t shared = std::min(left.size(), right.size()) - 1;
  for (std::size_t i = 0; i < shared; ++i) {
    if (!unify(left[i], right[i])) return false;
  }
  return unify(types_.dots(std::span(left).subspan(shared)),
               types_.dots(std::span(right).subspan(shared)));
}

}  // namespace perentie::semantics

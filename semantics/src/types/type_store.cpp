#include "type_store.hpp"

#include <array>
#include <unordered_map>
#include <utility>

#include "perentie/base/check.hpp"

namespace perentie::semantics {

std::string_view name_of(Constraint constraint) {
  switch (constraint) {
    case Constraint::eq:
      return "Eq";
    case Constraint::ord:
      return "Ord";
    case Constraint::set:
      return "Set";
    case Constraint::complete:
      return "Complete";
    case Constraint::yieldable:
      return "Yieldable";
  }
  return {};
}

bool ConstraintSet::implies(Constraint c) const {
  if (contains(c)) return true;
  if (c == Constraint::set) return contains(Constraint::eq) || contains(Constraint::ord);
  if (c == Constraint::eq) return contains(Constraint::ord);
  // What is an event or of a datatype is complete.
  return c == Constraint::complete && contains(Constraint::yieldable);
}

TypeStore::TypeStore() {
  // The simple types are the nodes of their own number, so that they need no table.
  for (std::size_t i = 0; i <= static_cast<std::size_t>(TypeKind::no_fields); ++i) {
    add({.kind = static_cast<TypeKind>(i)});
  }
}

TypeRef TypeStore::add(TypeNode node) {
  nodes_.push_back(node);
  return TypeRef{static_cast<std::uint32_t>(nodes_.size() - 1)};
}

TypeRef TypeStore::variable(ConstraintSet constraints) {
  return add({.kind = TypeKind::variable, .constraints = constraints});
}

TypeRef TypeStore::variable(Constraint constraint) {
  ConstraintSet constraints;
  constraints.add(constraint);
  return variable(constraints);
}

TypeRef TypeStore::rigid_variable(base::NameId name, ConstraintSet constraints) {
  return add(
      {.kind = TypeKind::variable, .is_rigid = true, .constraints = constraints, .name = name});
}

TypeRef TypeStore::datatype(SymbolId symbol) {
  return add({.kind = TypeKind::datatype, .datatype = symbol});
}

TypeRef TypeStore::make(TypeKind kind, std::span<const TypeRef> children) {
  const auto first = static_cast<std::uint32_t>(children_.size());
  children_.insert(children_.end(), children.begin(), children.end());
  return add({.kind = kind, .first = first, .count = static_cast<std::uint32_t>(children.size())});
}

TypeRef TypeStore::pair(TypeKind kind, TypeRef left, TypeRef right) {
  const std::array<TypeRef, 2> children{left, right};
  return make(kind, children);
}

TypeRef TypeStore::dots(std::span<const TypeRef> items) {
  PERENTIE_CHECK(!items.empty(), "a dot of nothing");
  TypeRef type = items.back();
  for (auto item = items.rbegin() + 1; item != items.rend(); ++item) type = dot(*item, type);
  return type;
}

TypeRef TypeStore::find(TypeRef type) {
  while (true) {
    if (const TypeRef bound = nodes_[type.value].bound) {
      // Halves the path for the next time.
      if (const TypeRef next = nodes_[bound.value].bound) nodes_[type.value].bound = next;
      type = bound;
      continue;
    }
    const TypeKind k = kind(type);
    if (k != TypeKind::extendable && k != TypeKind::yield) return type;
    const TypeRef argument = find(child(type, 0));
    const TypeRef result = child(type, 1);
    if (kind(argument) == TypeKind::dot) {
      const TypeRef first = child(argument, 0);
      const TypeRef rest = child(argument, 1);
      const TypeRef remaining = pair(k, rest, result);
      bind(type, yield(first, remaining));
    } else if (k == TypeKind::extendable && kind(argument) == TypeKind::no_fields) {
      bind(type, result);
    } else {
      return type;
    }
  }
}

template <class Visit>
void TypeStore::walk(TypeRef type, Visit visit) {
  std::vector<TypeRef> stack{type};
  ++visit_;
  while (!stack.empty()) {
    const TypeRef top = find(stack.back());
    stack.pop_back();
    marks_.resize(nodes_.size());
    if (std::exchange(marks_[top.value], visit_) == visit_) continue;
    if (!visit(top)) continue;
    const auto below = children(top);
    stack.insert(stack.end(), below.rbegin(), below.rend());
  }
}

std::vector<TypeRef> TypeStore::free_variables(TypeRef type) {
  std::vector<TypeRef> found;
  walk(type, [&](TypeRef node) {
    if (kind(node) == TypeKind::variable) found.push_back(node);
    return true;
  });
  return found;
}

std::vector<TypeRef> TypeStore::dots_in(TypeRef type) {
  std::vector<TypeRef> found;
  walk(type, [&](TypeRef node) {
    if (kind(node) != TypeKind::dot) return true;
    found.push_back(node);
    return false;
  });
  return found;
}

TypeRef TypeStore::instantiate(TypeRef type, std::span<const TypeRef> variables) {
  if (variables.empty()) return type;
  std::unordered_map<std::uint32_t, TypeRef> copies;
  for (const TypeRef v : variables) {
    copies.emplace(v.value, variable(nodes_[v.value].constraints));
  }
  // A node is copied when all below it are.
  std::vector<TypeRef> stack{type};
  std::vector<TypeRef> below;
  while (!stack.empty()) {
    const TypeRef top = find(stack.back());
    if (copies.contains(top.value)) {
      stack.pop_back();
      continue;
    }
    const std::size_t height = stack.size();
    const auto parts = children(top);
    below.assign(parts.begin(), parts.end());
    for (TypeRef& part : below) {
      part = find(part);
      if (!copies.contains(part.value)) stack.push_back(part);
    }
    if (stack.size() > height) continue;
    stack.pop_back();
    bool is_changed = false;
    for (TypeRef& part : below) {
      const TypeRef copy = copies.at(part.value);
      is_changed = is_changed || copy != part;
      part = copy;
    }
    copies.emplace(top.value, is_changed ? make(kind(top), below) : top);
  }
  return copies.at(find(type).value);
}

}  // namespace perentie::semantics

// Types in words, as FDR prints them (CSPM reference 3.1.9).
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "type_store.hpp"

namespace perentie::semantics {
namespace {

// What surrounds a type decides about its brackets.
enum class Place : std::uint8_t { top, dotted, argument };

class Writer {
 public:
  Writer(TypeStore& types, const Resolution& resolution, const base::Interner& names)
      : types_(types), resolution_(resolution), names_(names) {}

  std::string write(TypeRef type, bool with_constraints) {
    for (const TypeRef variable : types_.free_variables(type)) {
      if (const base::NameId name = types_[variable].name) taken_.emplace(names_[name]);
    }
    show(type, Place::top, 0);
    const std::string body = std::exchange(text_, {});
    std::vector<std::string> constraints;
    for (const TypeRef variable : variables_) {
      for (const Constraint c : all_constraints) {
        if (!types_[variable].constraints.contains(c)) continue;
        // Eq says Set, too.
        if (c == Constraint::set && types_[variable].constraints.contains(Constraint::eq)) continue;
        constraints.push_back(fmt::format("{} {}", name_of(c), name(variable)));
      }
    }
    if (constraints.empty() || !with_constraints) return body;
    const std::string list = fmt::format("{}", fmt::join(constraints, ", "));
    return constraints.size() == 1 ? fmt::format("{} => {}", list, body)
                                   : fmt::format("({}) => {}", list, body);
  }

 private:
  // Types may share parts, and then be long beyond measure.
  static constexpr std::size_t max_length = 2000;
  static constexpr std::size_t max_depth = 200;

  void list(std::string_view open, std::span<const TypeRef> items, std::string_view close,
            std::size_t depth) {
    text_ += open;
    const std::vector<TypeRef> parts(items.begin(), items.end());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i > 0) text_ += ", ";
      show(parts[i], Place::top, depth);
    }
    text_ += close;
  }

  void infix(TypeRef type, std::string_view op, Place left, Place right, std::size_t depth) {
    const TypeRef first = types_.child(type, 0);
    const TypeRef second = types_.child(type, 1);
    show(first, left, depth);
    text_ += op;
    show(second, right, depth);
  }

  void show(TypeRef type, Place place, std::size_t depth) {
    if (text_.size() > max_length || depth > max_depth) {
      text_ += "..";
      return;
    }
    ++depth;
    type = types_.find(type);
    const TypeKind kind = types_.kind(type);
    const bool is_infix =
        kind == TypeKind::yield || kind == TypeKind::extendable || kind == TypeKind::function;
    const bool brackets = (place == Place::dotted && (is_infix || kind == TypeKind::dot)) ||
                          (place == Place::argument && is_infix);
    if (brackets) text_ += '(';
    switch (kind) {
      case TypeKind::variable:
        text_ += name(type);
        break;
      case TypeKind::any:
        text_ += '_';
        break;
      case TypeKind::integer:
        text_ += "Int";
        break;
      case TypeKind::boolean:
        text_ += "Bool";
        break;
      case TypeKind::character:
        text_ += "Char";
        break;
      case TypeKind::event:
        text_ += "Event";
        break;
      case TypeKind::process:
        text_ += "Proc";
        break;
      case TypeKind::datatype:
        text_ += resolution_.symbols[types_[type].datatype].qualified;
        break;
      case TypeKind::set:
        list("{", types_.children(type), "}", depth);
        break;
      case TypeKind::sequence:
        list("<", types_.children(type), ">", depth);
        break;
      case TypeKind::tuple:
        list("(", types_.children(type), ")", depth);
        break;
      case TypeKind::map:
        text_ += "(| ";
        infix(type, " => ", Place::argument, Place::top, depth);
        text_ += " |)";
        break;
      case TypeKind::function: {
        const std::size_t count = types_.children(type).size() - 1;
        const TypeRef result = types_.child(type, count);
        list("(", types_.children(type).first(count), ") -> ", depth);
        show(result, Place::top, depth);
        break;
      }
      case TypeKind::dot:
        infix(type, ".", Place::dotted, Place::argument, depth);
        break;
      case TypeKind::yield:
        infix(type, " => ", Place::argument, Place::top, depth);
        break;
      case TypeKind::extendable:
        infix(type, " =>* ", Place::argument, Place::top, depth);
        break;
      case TypeKind::no_fields:
        text_ += "()";
        break;
    }
    if (brackets) text_ += ')';
  }

  // Variables of annotations keep their names, the others are a, b, .. in order of appearance.
  const std::string& name(TypeRef variable) {
    const auto [entry, inserted] = given_.emplace(variable.value, "");
    if (!inserted) return entry->second;
    variables_.push_back(variable);
    if (types_[variable].name) {
      entry->second = names_[types_[variable].name];
    } else {
      do {
        entry->second = letters(unnamed_++);
      } while (taken_.contains(entry->second));
    }
    return entry->second;
  }

  // a, b, .., z, aa, ab, ..
  static std::string letters(std::size_t number) {
    std::string word;
    do {
      word.insert(word.begin(), static_cast<char>('a' + number % 26));
      number /= 26;
    } while (number-- > 0);
    return word;
  }

  TypeStore& types_;
  const Resolution& resolution_;
  const base::Interner& names_;
  std::string text_;
  std::unordered_map<std::uint32_t, std::string> given_;  // by variable
  std::vector<TypeRef> variables_;
  std::unordered_set<std::string_view> taken_;  // by variables of annotations
  std::size_t unnamed_ = 0;
};

}  // namespace

std::string show_type(TypeStore& types, const Resolution& resolution, const base::Interner& names,
                      TypeRef type, bool with_constraints) {
  return Writer(types, resolution, names).write(type, with_constraints);
}

}  // namespace perentie::semantics

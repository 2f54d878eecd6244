// Lowering of patterns (CSPM reference 1.9). A pattern takes the value on top of the stack. What it
// takes apart goes through slots of the innermost frame, so a failing match leaves nothing behind.
#include <algorithm>

#include "../pattern_names.hpp"
#include "lower.hpp"
#include "perentie/base/overload.hpp"

namespace perentie::semantics {

using base::overload;
using parser::PatternId;

bool Lowering::is_ignored(PatternId pattern) const {
  const auto& node = tree_.patterns[pattern].node;
  if (std::holds_alternative<parser::WildcardPattern>(node)) return true;
  if (!std::holds_alternative<parser::NamePattern>(node)) return false;
  const SymbolId symbol = resolution_.of_pattern[pattern.value];
  return symbol && resolution_.symbols[symbol].kind == SymbolKind::variable &&
         !resolution_.symbols[symbol].is_used;
}

bool Lowering::binds_used_variable(PatternId pattern) const {
  bool used = false;
  for_each_name(tree_, pattern, [&](PatternId id, const parser::NamePattern&) {
    const SymbolId symbol = resolution_.of_pattern[id.value];
    used = used || (symbol && resolution_.symbols[symbol].kind == SymbolKind::variable &&
                    resolution_.symbols[symbol].is_used);
  });
  return used;
}

void Lowering::pattern(PatternId id, Label& fail) {
  span_ = tree_.patterns[id].span;
  if (is_ignored(id)) {
    emit(Op::pop);
    return;
  }
  const auto literal = [&](ValueId v) {
    emit(Op::canon);
    emit_value(v);
    emit_jump(Op::match_value, fail);
  };
  std::visit(overload{
                 [&](const parser::NamePattern&) {
                   const SymbolId symbol = resolution_.of_pattern[id.value];
                   if (!symbol) return;  // an error, reported
                   const SymbolKind kind = resolution_.symbols[symbol].kind;
                   if (kind == SymbolKind::channel || kind == SymbolKind::constructor) {
                     literal(values_.make_atom(symbol));
                   } else if (kind == SymbolKind::unsupported) {
                     emit(Op::unsupported, symbol.value);
                   } else {
                     emit(Op::store, add_variable(symbol));
                   }
                 },
                 [](const parser::WildcardPattern&) {},
                 [&](const parser::IntPattern& p) { literal(values_.make_int(p.value)); },
                 [&](const parser::BoolPattern& p) { literal(values_.make_bool(p.value)); },
                 [&](const parser::CharPattern& p) { literal(values_.make_char(p.value)); },
                 [&](const parser::StringPattern& p) {
                   literal(values_.make_string(tree_.names[p.text]));
                 },
                 [&](const parser::TuplePattern& p) {
                   emit(Op::force);
                   emit(Op::match_tuple, p.items.count);
                   match_stacked(tree_.list(p.items), fail);
                 },
                 [&](const parser::SetPattern& p) {
                   emit(Op::canon);
                   if (p.items.empty()) {
                     emit_jump(Op::match_empty_set, fail);
                   } else {
                     emit_jump(Op::match_single_set, fail);
                     pattern(tree_.list(p.items)[0], fail);
                   }
                 },
                 [&](const parser::SequencePattern&) { sequence_pattern(id, fail); },
                 [&](const parser::ConcatPattern&) { sequence_pattern(id, fail); },
                 [&](const parser::DotPattern&) { dot_pattern(id, fail); },
                 [&](const parser::DoublePattern& p) {
                   const std::uint32_t slot = add_slot();
                   emit(Op::store, slot);
                   emit(Op::load, slot);
                   pattern(p.left, fail);
                   emit(Op::load, slot);
                   pattern(p.right, fail);
                 },
             },
             tree_.patterns[id].node);
}

void Lowering::match(const SequenceItem& item, Label& fail) {
  if (item.pattern) return pattern(item.pattern, fail);
  emit(Op::canon);
  emit_value(item.character);
  emit_jump(Op::match_value, fail);
}

// The items lie on the stack, the first on top: put them into slots, then match each.
void Lowering::match_stacked(std::span<const SequenceItem> items, Label& fail) {
  std::vector<std::uint32_t> slots;
  for (const SequenceItem& item : items) {
    if (item.pattern && is_ignored(item.pattern)) {
      emit(Op::pop);
      slots.push_back(0);
    } else {
      slots.push_back(add_slot());
      emit(Op::store, slots.back());
    }
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].pattern && is_ignored(items[i].pattern)) continue;
    emit(Op::load, slots[i]);
    match(items[i], fail);
  }
}

void Lowering::match_stacked(std::span<const PatternId> items, Label& fail) {
  std::vector<SequenceItem> converted;
  for (const PatternId item : items) converted.push_back({item, {}});
  match_stacked(converted, fail);
}

// Sequence patterns flatten to items at the front, an optional middle, items at the end (1.9.4).
Lowering::SequenceParts Lowering::flatten_sequence(PatternId id) {
  SequenceParts parts;
  std::vector<PatternId> stack{id};
  while (!stack.empty()) {
    const PatternId part = stack.back();
    stack.pop_back();
    auto& end = parts.middle ? parts.back : parts.front;
    std::visit(overload{
                   [&](const parser::ConcatPattern& p) {
                     stack.push_back(p.right);
                     stack.push_back(p.left);
                   },
                   [&](const parser::SequencePattern& p) {
                     for (const PatternId item : tree_.list(p.items)) end.push_back({item, {}});
                   },
                   [&](const parser::StringPattern& p) {
                     for (const char c : tree_.names[p.text]) {
                       end.push_back({{}, values_.make_char(static_cast<unsigned char>(c))});
                     }
                   },
                   [&](const auto&) { parts.middle = part; },
               },
               tree_.patterns[part].node);
  }
  return parts;
}

void Lowering::sequence_pattern(PatternId id, Label& fail) {
  SequenceParts parts = flatten_sequence(id);
  if (!parts.back.empty()) {  // the whole spine is needed to find the end
    emit(Op::canon);
    program_.ends_patterns.push_back({static_cast<std::uint32_t>(parts.front.size()),
                                      static_cast<std::uint32_t>(parts.back.size())});
    emit_jump(Op::match_ends, fail, program_.ends_patterns.size() - 1);
    std::vector<SequenceItem> items = std::move(parts.front);
    items.push_back({parts.middle, {}});
    items.insert(items.end(), parts.back.begin(), parts.back.end());
    match_stacked(items, fail);
    return;
  }
  const std::uint32_t rest = add_slot();
  for (const SequenceItem& item : parts.front) {
    emit(Op::force);
    emit_jump(Op::match_cons, fail);
    const std::uint32_t head = add_slot();
    emit(Op::store, head);
    emit(Op::store, rest);
    if (!item.pattern || !is_ignored(item.pattern)) {
      emit(Op::load, head);
      match(item, fail);
    }
    emit(Op::load, rest);
  }
  if (parts.middle) {
    pattern(parts.middle, fail);
  } else {
    emit(Op::force);
    emit_jump(Op::match_empty_seq, fail);
  }
}

std::vector<PatternId> Lowering::flatten_dots(PatternId id) const {
  std::vector<PatternId> items;
  std::vector<PatternId> stack{id};
  while (!stack.empty()) {
    const PatternId part = stack.back();
    stack.pop_back();
    if (const auto* dot = std::get_if<parser::DotPattern>(&tree_.patterns[part].node)) {
      stack.push_back(dot->right);
      stack.push_back(dot->left);
    } else {
      items.push_back(part);
    }
  }
  return items;
}

void Lowering::dot_pattern(PatternId id, Label& fail) {
  DotItems descriptor;
  std::vector<PatternId> taken;
  for (const PatternId item : flatten_dots(id)) {
    const SymbolId symbol = std::holds_alternative<parser::NamePattern>(tree_.patterns[item].node)
                                ? resolution_.of_pattern[item.value]
                                : SymbolId{};
    const bool is_atom = symbol && (resolution_.symbols[symbol].kind == SymbolKind::channel ||
                                    resolution_.symbols[symbol].kind == SymbolKind::constructor);
    descriptor.items.push_back(is_atom ? symbol : SymbolId{});
    if (!is_atom) taken.push_back(item);
  }
  emit(Op::canon);
  program_.dot_patterns.push_back(std::move(descriptor));
  emit_jump(Op::match_dot, fail, program_.dot_patterns.size() - 1);
  match_stacked(taken, fail);
}

}  // namespace perentie::semantics

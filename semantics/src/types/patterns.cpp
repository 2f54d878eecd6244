// The types of patterns, generators and fields (CSPM reference 1.9, 3.5, 4.3).
#include "inference.hpp"
#include "perentie/base/overload.hpp"

namespace perentie::semantics {

using base::overload;

TypeRef TypeChecker::Impl::pattern_name(PatternId id) {
  const SymbolId symbol = resolution.of_pattern[id.value];
  if (!symbol) return types.variable();
  const SymbolKind kind = resolution.symbols[symbol].kind;
  const bool is_atom = kind == SymbolKind::channel || kind == SymbolKind::constructor;
  return is_atom ? instance_of(symbol, tree.patterns[id].span) : mono(symbol);
}

void TypeChecker::Impl::finish_pattern(PatternId id) {
  const Span at = tree.patterns[id].span;
  const auto of = [&](PatternId part) { return of_pattern[part.value]; };
  const auto all_of = [&](parser::PatternList items) {
    const TypeRef element = types.variable();
    for (const PatternId item : tree.list(items)) {
      agree(element, of(item), tree.patterns[item].span);
    }
    return element;
  };
  of_pattern[id.value] = std::visit(
      overload{
          [&](const parser::NamePattern&) { return pattern_name(id); },
          [&](const parser::WildcardPattern&) { return types.variable(); },
          [&](const parser::IntPattern&) { return types.integer(); },
          [&](const parser::BoolPattern&) { return types.boolean(); },
          [&](const parser::CharPattern&) { return types.character(); },
          [&](const parser::StringPattern&) { return types.sequence(types.character()); },
          [&](const parser::TuplePattern& p) {
            std::vector<TypeRef> items;
            for (const PatternId item : tree.list(p.items)) items.push_back(of(item));
            return types.tuple(items);
          },
          [&](const parser::SequencePattern& p) { return types.sequence(all_of(p.items)); },
          [&](const parser::SetPattern& p) {
            const TypeRef element = all_of(p.items);
            // Whether there is one element can tell whether two are equal (3.1.5).
            require(p.items.empty() ? Constraint::set : Constraint::eq, element, at);
            return types.set(element);
          },
          [&](const parser::ConcatPattern& p) {
            const TypeRef sequence = types.sequence(types.variable());
            agree(sequence, of(p.left), tree.patterns[p.left].span);
            agree(sequence, of(p.right), tree.patterns[p.right].span);
            return sequence;
          },
          [&](const parser::DotPattern& p) {
            // A variable that is not the last takes one field, so it is no channel (1.9.5).
            const TypeRef left = of(p.left);
            if (types.is_flexible(types.find(left))) {
              require(Constraint::complete, left, tree.patterns[p.left].span);
            }
            return dotted({types.dot(left, of(p.right)), at, !is_part_of_dot[id.value]});
          },
          [&](const parser::DoublePattern& p) {
            agree(of(p.left), of(p.right), at);
            return of(p.left);
          },
      },
      tree.patterns[id].node);
}

void TypeChecker::Impl::finish_statement(parser::StatementId id) {
  std::visit(overload{
                 [&](const parser::Generator& s) {
                   const TypeRef element = of_pattern[s.pattern.value];
                   expect(s.source, draws_from_sequence[id.value] ? types.sequence(element)
                                                                  : types.set(element));
                 },
                 [&](const parser::Filter& s) { expect(s.condition, types.boolean()); },
             },
             tree.statements[id].node);
}

void TypeChecker::Impl::finish_field(parser::FieldId id) {
  const parser::Field& field = tree.fields[id];
  if (field.kind == parser::FieldKind::output) {
    of_field[id.value] = type(field.expression);
    return;
  }
  const TypeRef input = of_pattern[field.pattern.value];
  of_field[id.value] = input;
  if (field.expression) expect(field.expression, types.set(input));
  // What a variable reads is a complete value; a constructor gets its fields from what follows.
  const parser::Pattern& pattern = tree.patterns[field.pattern];
  const SymbolId symbol = resolution.of_pattern[field.pattern.value];
  const bool is_variable = std::holds_alternative<parser::WildcardPattern>(pattern.node) ||
                           (symbol && resolution.symbols[symbol].kind == SymbolKind::variable);
  if (is_variable) require(Constraint::complete, input, field.span);
}

}  // namespace perentie::semantics

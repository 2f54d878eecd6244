// Names in expressions, statements, fields and patterns.
#include "resolver.hpp"

#include <fmt/format.h>

#include "../pattern_names.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

using base::overload;

void Resolver::Impl::visit_expr(ExprId id) {
  using K = Task::Kind;
  const parser::Expr& expr = tree.exprs[id];
  std::visit(
      overload{
          [&](const parser::NameExpr& e) { visit_name(id, e, expr.span); },
          [&](const parser::TupleExpr& e) { then_all(K::expr, tree.list(e.items)); },
          [&](const parser::MapExpr& e) {
            then_all(K::expr, tree.list(e.values));
            then_all(K::expr, tree.list(e.keys));
          },
          [&](const parser::CollectionExpr& e) {
            scoped(e.statements, [&] { then_all(K::expr, tree.list(e.items)); });
          },
          [&](const parser::RangeExpr& e) {
            scoped(e.statements, [&] {
              then_expr(e.last);
              then_expr(e.first);
            });
          },
          [&](const parser::ApplyExpr& e) {
            then_all(K::expr, tree.list(e.arguments));
            then_expr(e.function);
          },
          [&](const parser::LambdaExpr& e) {
            tasks.push_back({K::close_scope});
            then_expr(e.body);
            then_all(K::pattern, tree.list(e.parameters));
            tasks.push_back({K::open_scope});
          },
          [&](const parser::LetExpr& e) {
            then({{K::open_scope},
                  {K::declarations, e.declarations.first, e.declarations.count},
                  {K::expr, e.body.value},
                  {K::close_scope}});
          },
          [&](const parser::IfExpr& e) {
            then_expr(e.else_branch);
            then_expr(e.then_branch);
            then_expr(e.condition);
          },
          [&](const parser::NegateExpr& e) { then_expr(e.operand); },
          [&](const parser::NotExpr& e) { then_expr(e.operand); },
          [&](const parser::LengthExpr& e) { then_expr(e.operand); },
          [&](const parser::InfixExpr& e) {
            then_expr(e.right);
            then_expr(e.left);
          },
          [&](const parser::PrefixExpr& e) {
            if (e.fields.empty()) {
              then_expr(e.body);
            } else {
              tasks.push_back({K::close_scope});
              then_expr(e.body);
              then_all(K::field, tree.list(e.fields));
              tasks.push_back({K::open_scope});
            }
            then_expr(e.channel);
          },
          [&](const parser::ParallelExpr& e) { visit_three(e.left, e.alphabet, e.right); },
          [&](const parser::ExceptionExpr& e) { visit_three(e.left, e.alphabet, e.right); },
          [&](const parser::SyncChoiceExpr& e) { visit_three(e.left, e.alphabet, e.right); },
          [&](const parser::SyncInterruptExpr& e) { visit_three(e.left, e.alphabet, e.right); },
          [&](const parser::AlphabetParallelExpr& e) {
            then_expr(e.right);
            visit_three(e.left, e.left_alphabet, e.right_alphabet);
          },
          [&](const parser::LinkParallelExpr& e) {
            visit_ties(e.links);
            then_expr(e.right);
            then_expr(e.left);
          },
          [&](const parser::RenameExpr& e) {
            visit_ties(e.pairs);
            then_expr(e.process);
          },
          [&](const parser::ReplicatedExpr& e) {
            // The alphabet of `|| s @ [A] P` sees the bound variables, the others do not (4.4.3).
            const bool inside = e.op == parser::ReplicatedOp::alphabet_parallel;
            scoped(e.statements, [&] {
              then_expr(e.body);
              if (inside) then_expr(e.alphabet);
            });
            if (!inside) then_expr(e.alphabet);
          },
          [&](const parser::ReplicatedLinkExpr& e) {
            scoped(e.statements, [&] {
              then_expr(e.body);
              visit_ties(e.links);
            });
          },
          [](const auto&) {},  // literals, and what only erroneous trees contain
      },
      expr.node);
}

void Resolver::Impl::visit_three(ExprId a, ExprId b, ExprId c) {
  then_expr(c);
  then_expr(b);
  then_expr(a);
}

void Resolver::Impl::visit_ties(const parser::Ties& ties) {
  scoped(ties.statements, [&] {
    then_all(Task::Kind::expr, tree.list(ties.to));
    then_all(Task::Kind::expr, tree.list(ties.from));
  });
}

void Resolver::Impl::visit_name(ExprId id, const parser::NameExpr& e, Span span) {
  const SymbolId symbol = lookup(e.name, span);
  if (symbol && result.symbols[symbol].kind == SymbolKind::module) {
    diagnostics->report(
        codes::module_as_value, span,
        fmt::format("the module `{}` is not a value", result.symbols[symbol].qualified));
    return;
  }
  result.of_expr[id.value] = symbol;
}

void Resolver::Impl::visit_statement(StatementId id) {
  std::visit(
      overload{[&](const parser::Generator& s) {
                 then({{Task::Kind::expr, s.source.value}, {Task::Kind::pattern, s.pattern.value}});
               },
               [&](const parser::Filter& s) { then_expr(s.condition); }},
      tree.statements[id].node);
}

void Resolver::Impl::visit_field(parser::FieldId id) {
  const parser::Field& field = tree.fields[id];
  if (field.pattern) tasks.push_back({Task::Kind::pattern, field.pattern.value});
  then_expr(field.expression);
}

// Binds the variables of a pattern in the innermost scope.
void Resolver::Impl::bind_pattern(PatternId root) {
  for_each_name(tree, root, [this](PatternId id, const parser::NamePattern& name) {
    bind_name(id, name, tree.patterns[id].span);
  });
}

bool Resolver::Impl::is_atom(SymbolKind kind) {
  return kind == SymbolKind::channel || kind == SymbolKind::constructor;
}

void Resolver::Impl::bind_name(PatternId id, const parser::NamePattern& p, Span span) {
  if (result.of_pattern[id.value]) return;  // a declared constant: bound with its group
  const auto parts = tree.list(p.name);
  if (parts.size() > 1) {
    const SymbolId symbol = lookup(p.name, span);
    if (symbol && !is_atom(result.symbols[symbol].kind) &&
        result.symbols[symbol].kind != SymbolKind::unsupported) {
      diagnostics->report(codes::qualified_binding, span,
                          fmt::format("`{}` is no channel or constructor, and a qualified name "
                                      "cannot be bound by a pattern",
                                      result.symbols[symbol].qualified));
    }
    result.of_pattern[id.value] = symbol;
    return;
  }
  const SymbolId existing = binding(parts[0]);
  if (existing && is_atom(result.symbols[existing].kind)) {
    result.symbols[existing].is_used = true;
    result.of_pattern[id.value] = existing;
    return;
  }
  if (const SymbolId twice = bound_in_innermost_scope(parts[0])) {
    auto& report = diagnostics->report(
        codes::variable_bound_twice, span,
        fmt::format("`{}` is bound more than once by the same patterns", text(parts[0])));
    report.notes.push_back({result.symbols[twice].span, "it is bound here first"});
    return;
  }
  const SymbolId symbol = result.symbols.add(Symbol{.kind = SymbolKind::variable,
                                                    .name = parts[0],
                                                    .qualified = std::string(text(parts[0])),
                                                    .span = span});
  bind(parts[0], symbol);
  result.of_pattern[id.value] = symbol;
}

}  // namespace perentie::semantics

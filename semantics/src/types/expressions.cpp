// The types of expressions, from those of their parts (CSPM reference 3.1 to 3.7).
#include <array>

#include <fmt/format.h>

#include "inference.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

using base::overload;
using parser::Collection;
using parser::InfixOp;

TypeRef TypeChecker::Impl::finish_expr(ExprId id) {
  const TypeRef process = types.process();
  const TypeRef events = types.set(types.event());
  const auto processes = [&](auto... operands) {
    (expect(operands, process), ...);
    return process;
  };
  return std::visit(
      overload{
          [&](const parser::NameExpr&) {
            return instance_of(resolution.of_expr[id.value], span(id));
          },
          [&](const parser::IntExpr&) { return types.integer(); },
          [&](const parser::BoolExpr&) { return types.boolean(); },
          [&](const parser::CharExpr&) { return types.character(); },
          [&](const parser::StringExpr&) { return types.sequence(types.character()); },
          [&](const parser::TupleExpr& e) {
            std::vector<TypeRef> items;
            for (const ExprId item : tree.list(e.items)) items.push_back(type(item));
            return types.tuple(items);
          },
          [&](const parser::MapExpr& e) {
            const TypeRef key = types.variable(Constraint::set);
            const TypeRef value = types.variable();
            for (const ExprId k : tree.list(e.keys)) expect(k, key);
            for (const ExprId v : tree.list(e.values)) expect(v, value);
            return types.map(key, value);
          },
          [&](const parser::CollectionExpr& e) { return collection(id, e); },
          [&](const parser::RangeExpr& e) {
            expect(e.first, types.integer());
            if (e.last) expect(e.last, types.integer());
            return e.kind == Collection::sequence ? types.sequence(types.integer())
                                                  : types.set(types.integer());
          },
          [&](const parser::ApplyExpr& e) { return apply(id, e); },
          [&](const parser::LambdaExpr& e) {
            std::vector<TypeRef> parts;
            for (const PatternId p : tree.list(e.parameters)) parts.push_back(of_pattern[p.value]);
            parts.push_back(type(e.body));
            return types.function(parts);
          },
          [&](const parser::LetExpr& e) { return type(e.body); },
          [&](const parser::IfExpr& e) {
            expect(e.condition, types.boolean());
            expect(e.else_branch, type(e.then_branch));
            return type(e.then_branch);
          },
          [&](const parser::NegateExpr& e) {
            expect(e.operand, types.integer());
            return types.integer();
          },
          [&](const parser::NotExpr& e) {
            expect(e.operand, types.boolean());
            return types.boolean();
          },
          [&](const parser::LengthExpr& e) {
            expect(e.operand, types.sequence(types.variable()));
            return types.integer();
          },
          [&](const parser::InfixExpr& e) { return infix(id, e); },
          [&](const parser::PrefixExpr& e) { return processes(e.body); },
          [&](const parser::ParallelExpr& e) {
            expect(e.alphabet, events);
            return processes(e.left, e.right);
          },
          [&](const parser::AlphabetParallelExpr& e) {
            expect(e.left_alphabet, events);
            expect(e.right_alphabet, events);
            return processes(e.left, e.right);
          },
          [&](const parser::ExceptionExpr& e) {
            expect(e.alphabet, events);
            return processes(e.left, e.right);
          },
          [&](const parser::SyncChoiceExpr& e) {
            expect(e.alphabet, events);
            return processes(e.left, e.right);
          },
          [&](const parser::SyncInterruptExpr& e) {
            expect(e.alphabet, events);
            return processes(e.left, e.right);
          },
          [&](const parser::LinkParallelExpr& e) {
            ties(e.links);
            return processes(e.left, e.right);
          },
          [&](const parser::RenameExpr& e) {
            ties(e.pairs);
            return processes(e.process);
          },
          [&](const parser::ReplicatedExpr& e) {
            if (e.alphabet) expect(e.alphabet, events);
            return processes(e.body);
          },
          [&](const parser::ReplicatedLinkExpr& e) {
            ties(e.links);
            return processes(e.body);
          },
          [&](const auto&) { return types.any(); },  // only in trees with errors
      },
      tree.exprs[id].node);
}

TypeRef TypeChecker::Impl::collection(ExprId id, const parser::CollectionExpr& e) {
  const auto items = tree.list(e.items);
  if (e.kind == Collection::productions) {
    const TypeRef whole = types.variable(Constraint::yieldable);
    for (const ExprId item : items) {
      expect(item, types.extendable(types.variable(), whole));
    }
    return types.set(whole);
  }
  const TypeRef element = items.empty() ? types.variable() : type(items[0]);
  for (std::size_t i = 1; i < items.size(); ++i) expect(items[i], element);
  if (e.kind == Collection::sequence) return types.sequence(element);
  require(Constraint::set, element, items.empty() ? span(id) : span(items[0]));
  return types.set(element);
}

TypeRef TypeChecker::Impl::apply(ExprId id, const parser::ApplyExpr& e) {
  const auto arguments = tree.list(e.arguments);
  const auto called = unifier.known(type(e.function));
  const TypeRef function = called.value_or(types.any());
  if (types.is_flexible(function)) {
    std::vector<TypeRef> parts;
    for (const ExprId argument : arguments) parts.push_back(type(argument));
    parts.push_back(types.variable());
    const TypeRef result = parts.back();
    agree(types.function(parts), function, span(e.function));
    return result;
  }
  if (types.kind(function) == TypeKind::any) return types.any();
  const auto* name = std::get_if<parser::NameExpr>(&tree.exprs[e.function].node);
  const SymbolId symbol = name != nullptr ? resolution.of_expr[e.function.value] : SymbolId{};
  const std::string called_name =
      symbol ? fmt::format("`{}`", resolution.symbols[symbol].qualified) : "this function";
  if (types.kind(function) != TypeKind::function) {
    report(codes::not_a_function, span(e.function),
           fmt::format("{} has the type `{}`, which is not that of a function",
                       symbol ? called_name : "this", text(function)));
    return types.any();
  }
  const std::vector<TypeRef> parts(types.children(function).begin(),
                                   types.children(function).end());
  if (parts.size() - 1 != arguments.size()) {
    auto& diagnostic =
        report(codes::wrong_argument_count, span(id),
               fmt::format("{} takes {} argument{}, but gets {}", called_name, parts.size() - 1,
                           parts.size() == 2 ? "" : "s", arguments.size()));
    if (symbol && resolution.symbols[symbol].span) {
      diagnostic.notes.push_back({resolution.symbols[symbol].span, "it is defined here"});
    }
    return parts.back();
  }
  for (std::size_t i = 0; i < arguments.size(); ++i) expect(arguments[i], parts[i]);
  return parts.back();
}

TypeRef TypeChecker::Impl::dotted(const PendingDot& pending) {
  const TypeRef dot = reduced(pending);
  if (types.kind(dot) == TypeKind::dot) pending_dots.push_back(pending);
  return dot;
}

TypeRef TypeChecker::Impl::infix(ExprId id, const parser::InfixExpr& e) {
  const auto both = [&](TypeRef operands, TypeRef result) {
    expect(e.left, operands);
    expect(e.right, operands);
    return result;
  };
  switch (e.op) {
    case InfixOp::concat:
      return both(types.sequence(types.variable()), type(e.left));
    case InfixOp::multiply:
    case InfixOp::divide:
    case InfixOp::modulo:
    case InfixOp::add:
    case InfixOp::subtract:
      return both(types.integer(), types.integer());
    case InfixOp::equal:
    case InfixOp::not_equal:
      if (expect(e.right, type(e.left))) require(Constraint::eq, type(e.left), span(id));
      return types.boolean();
    case InfixOp::less:
    case InfixOp::less_equal:
    case InfixOp::greater:
    case InfixOp::greater_equal:
      if (expect(e.right, type(e.left))) require(Constraint::ord, type(e.left), span(id));
      return types.boolean();
    case InfixOp::logical_and:
    case InfixOp::logical_or:
      return both(types.boolean(), types.boolean());
    case InfixOp::dot:
      return dotted({types.dot(type(e.left), type(e.right)), span(e.right)});
    case InfixOp::guard:
      expect(e.left, types.boolean());
      expect(e.right, types.process());
      return types.process();
    case InfixOp::hide:
    case InfixOp::project:
      expect(e.left, types.process());
      expect(e.right, types.set(types.event()));
      return types.process();
    case InfixOp::sequential:
    case InfixOp::sliding_choice:
    case InfixOp::interrupt:
    case InfixOp::external_choice:
    case InfixOp::internal_choice:
    case InfixOp::interleave:
      return both(types.process(), types.process());
    default:  // what the parser turns into other nodes
      return types.any();
  }
}

// Both sides lack the same fields of an event (4.2).
void TypeChecker::Impl::ties(const parser::Ties& ties) {
  const auto from = tree.list(ties.from);
  const auto to = tree.list(ties.to);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const TypeRef events = types.extendable(types.variable(), types.event());
    if (expect(from[i], events)) expect(to[i], events);
  }
}

void TypeChecker::Impl::prefix_event(ExprId id) {
  const auto& e = std::get<parser::PrefixExpr>(tree.exprs[id].node);
  const auto fields = tree.list(e.fields);
  if (fields.empty()) {
    expect(e.channel, types.event());
    return;
  }
  std::vector<TypeRef> parts{type(e.channel)};
  for (const parser::FieldId field : fields) parts.push_back(of_field[field.value]);
  const Span events{span(e.channel).begin, tree.fields[fields.back()].span.end};
  agree(types.event(), types.dots(parts), events);
}

}  // namespace perentie::semantics

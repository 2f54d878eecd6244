// Lowering of value expressions: names, operators, calls, collections and comprehensions.
#include <algorithm>

#include "lower.hpp"
#include "perentie/base/overload.hpp"

namespace perentie::semantics {

using base::overload;
using parser::Collection;
using parser::ExprId;
using parser::InfixOp;
using parser::StatementId;

namespace {

bool is_process_operator(InfixOp op) {
  switch (op) {
    case InfixOp::sequential:
    case InfixOp::sliding_choice:
    case InfixOp::interrupt:
    case InfixOp::external_choice:
    case InfixOp::internal_choice:
    case InfixOp::interleave:
    case InfixOp::hide:
    case InfixOp::project:
      return true;
    default:
      return false;
  }
}

}  // namespace

// What the code of an expression is known to leave, whatever its operands are.
Lowering::Leaves Lowering::leaves(ExprId expr) const {
  return std::visit(overload{
                        [&](const parser::NameExpr&) {
                          const SymbolId symbol = resolution_.of_expr[expr.value];
                          if (!symbol) return Leaves::unknown;
                          const SymbolKind kind = resolution_.symbols[symbol].kind;
                          const bool is_atom =
                              kind == SymbolKind::channel || kind == SymbolKind::constructor;
                          return is_atom ? Leaves::value : Leaves::unknown;
                        },
                        [](const parser::IntExpr&) { return Leaves::value; },
                        [](const parser::BoolExpr&) { return Leaves::value; },
                        [](const parser::CharExpr&) { return Leaves::value; },
                        [](const parser::StringExpr&) { return Leaves::value; },
                        [](const parser::MapExpr&) { return Leaves::value; },
                        [](const parser::NegateExpr&) { return Leaves::value; },
                        [](const parser::NotExpr&) { return Leaves::value; },
                        [](const parser::CollectionExpr& e) {
                          return e.kind == Collection::sequence ? Leaves::unknown : Leaves::value;
                        },
                        [](const parser::RangeExpr& e) {
                          return e.kind == Collection::sequence ? Leaves::unknown : Leaves::value;
                        },
                        [](const parser::InfixExpr& e) {
                          if (e.op == InfixOp::guard || is_process_operator(e.op))
                            return Leaves::process;
                          return e.op == InfixOp::concat ? Leaves::unknown : Leaves::value;
                        },
                        [](const parser::PrefixExpr&) { return Leaves::process; },
                        [](const parser::ParallelExpr&) { return Leaves::process; },
                        [](const parser::AlphabetParallelExpr&) { return Leaves::process; },
                        [](const parser::ExceptionExpr&) { return Leaves::process; },
                        [](const parser::SyncChoiceExpr&) { return Leaves::process; },
                        [](const parser::SyncInterruptExpr&) { return Leaves::process; },
                        [](const parser::LinkParallelExpr&) { return Leaves::process; },
                        [](const parser::RenameExpr&) { return Leaves::process; },
                        [](const parser::ReplicatedExpr&) { return Leaves::process; },
                        [](const parser::ReplicatedLinkExpr&) { return Leaves::process; },
                        [](const auto&) { return Leaves::unknown; },
                    },
                    tree_.exprs[expr].node);
}

void Lowering::canonical(ExprId expr) {
  value(expr);
  if (leaves(expr) == Leaves::unknown) emit(Op::canon);
}

void Lowering::thunk(ExprId expr) {
  const Address at = emit(Op::make_thunk);
  queue([this, at, expr](Address entry) {
    program_.code[at].b = entry;
    value(expr, Tail::yes);
  });
}

// What costs nothing and cannot fail is pushed as it is; everything else becomes a thunk.
void Lowering::lazy(ExprId expr) {
  span_ = tree_.exprs[expr].span;
  std::visit(overload{
                 [&](const parser::NameExpr&) {
                   const SymbolId symbol = resolution_.of_expr[expr.value];
                   const bool is_variable = symbol && !is_timed_builtin(symbol) &&
                                            symbol.value < locations_.size() &&
                                            (locations_[symbol.value].place == Place::local ||
                                             locations_[symbol.value].place == Place::global);
                   if (is_variable) {
                     load_symbol(symbol);
                   } else {
                     thunk(expr);
                   }
                 },
                 [&](const parser::IntExpr& e) { emit_value(values_.make_int(e.value)); },
                 [&](const parser::BoolExpr& e) { emit_value(values_.make_bool(e.value)); },
                 [&](const parser::CharExpr& e) { emit_value(values_.make_char(e.value)); },
                 [&](const parser::StringExpr&) { value(expr); },
                 [&](const parser::LambdaExpr& e) { lambda(expr, e); },
                 [&](const auto&) { thunk(expr); },
             },
             tree_.exprs[expr].node);
}

void Lowering::value(ExprId expr, Tail tail) {
  if (too_deep(expr)) return;
  ++nesting_;
  const base::Span span = tree_.exprs[expr].span;
  span_ = span;
  bool finished = false;  // the branches have returned themselves
  // A comprehension of a sequence is a block that returns; elsewhere it is the value of a thunk.
  const auto in_own_block = [&](const auto& e) {
    if (e.kind != Collection::sequence || e.statements.empty()) return false;
    if (tail == Tail::yes) {
      finished = true;
      return false;
    }
    thunk(expr);
    emit(Op::force);
    return true;
  };
  std::visit(overload{
                 [&](const parser::NameExpr&) {
                   const SymbolId symbol = resolution_.of_expr[expr.value];
                   if (symbol) name(symbol);
                 },
                 [&](const parser::IntExpr& e) { emit_value(values_.make_int(e.value)); },
                 [&](const parser::BoolExpr& e) { emit_value(values_.make_bool(e.value)); },
                 [&](const parser::CharExpr& e) { emit_value(values_.make_char(e.value)); },
                 [&](const parser::StringExpr& e) {
                   emit_value(values_.make_string(tree_.names[e.text]));
                 },
                 [&](const parser::TupleExpr& e) {
                   for (const ExprId item : tree_.list(e.items)) lazy(item);
                   span_ = span;
                   emit(Op::make_tuple, e.items.count);
                 },
                 [&](const parser::MapExpr& e) {
                   const auto keys = tree_.list(e.keys);
                   const auto entries = tree_.list(e.values);
                   for (std::size_t i = 0; i < keys.size(); ++i) {
                     canonical(keys[i]);
                     canonical(entries[i]);
                   }
                   span_ = span;
                   emit(Op::make_map, e.keys.count);
                 },
                 [&](const parser::CollectionExpr& e) {
                   if (in_own_block(e)) return;
                   collection(e);
                 },
                 [&](const parser::RangeExpr& e) {
                   if (in_own_block(e)) return;
                   range(e);
                 },
                 [&](const parser::ApplyExpr&) { apply(expr); },
                 [&](const parser::LambdaExpr& e) { lambda(expr, e); },
                 [&](const parser::LetExpr& e) {
                   let_scope(e);
                   value(e.body, tail);
                   if (tail == Tail::no) emit(Op::leave);
                   close_scope();
                   finished = tail == Tail::yes;
                 },
                 [&](const parser::IfExpr& e) {
                   Label otherwise;
                   Label end;
                   value(e.condition);
                   span_ = tree_.exprs[e.condition].span;
                   emit_jump(Op::jump_if_false, otherwise);
                   value(e.then_branch, tail);
                   if (tail == Tail::no) emit_jump(Op::jump, end);
                   place(otherwise);
                   value(e.else_branch, tail);
                   place(end);
                   finished = tail == Tail::yes;
                 },
                 [&](const parser::NegateExpr& e) {
                   value(e.operand);
                   span_ = span;
                   emit(Op::negate);
                 },
                 [&](const parser::NotExpr& e) {
                   value(e.operand);
                   span_ = span;
                   emit(Op::logical_not);
                 },
                 [&](const parser::LengthExpr& e) {
                   load_symbol(prelude_.length);
                   lazy(e.operand);
                   span_ = span;
                   emit(Op::call, 1);
                 },
                 [&](const parser::InfixExpr&) { infix_chain(expr); },
                 [&](const parser::PrefixExpr&) { is_timed() ? timed_prefix(expr) : prefix(expr); },
                 [&](const parser::ParallelExpr& e) {
                   three(e.left, e.alphabet, e.right, ProcKind::parallel);
                 },
                 [&](const parser::ExceptionExpr& e) {
                   three(e.left, e.alphabet, e.right, ProcKind::exception);
                 },
                 [&](const parser::SyncChoiceExpr& e) {
                   three(e.left, e.alphabet, e.right, ProcKind::sync_choice);
                 },
                 [&](const parser::SyncInterruptExpr& e) {
                   three(e.left, e.alphabet, e.right, ProcKind::sync_interrupt);
                 },
                 [&](const parser::AlphabetParallelExpr& e) {
                   process(e.left);
                   canonical(e.left_alphabet);
                   add_tock();
                   canonical(e.right_alphabet);
                   add_tock();
                   process(e.right);
                   span_ = span;
                   emit(Op::alphabet_parallel);
                 },
                 [&](const parser::LinkParallelExpr& e) {
                   refuse_in_timed_section(span, "a linked parallel");
                   process(e.left);
                   process(e.right);
                   ties(e.links);
                   span_ = span;
                   emit(Op::link_parallel);
                 },
                 [&](const parser::RenameExpr& e) {
                   process(e.process);
                   ties(e.pairs);
                   span_ = span;
                   emit(Op::rename);
                 },
                 [&](const parser::ReplicatedExpr& e) {
                   is_timed() ? timed_replicated(e) : replicated(e);
                 },
                 [&](const parser::ReplicatedLinkExpr& e) {
                   refuse_in_timed_section(span, "a linked parallel");
                   replicated_link(e);
                 },
                 [](const parser::WildcardExpr&) {},
                 [](const parser::CommunicationExpr&) {},
             },
             tree_.exprs[expr].node);
  span_ = span;
  if (!finished) finish(tail);
  --nesting_;
}

void Lowering::name(SymbolId id) {
  if (is_timed_builtin(id)) return apply_to_tock(id);
  const Symbol& symbol = resolution_.symbols[id];
  switch (symbol.kind) {
    case SymbolKind::builtin:
      if (info(symbol.builtin).arguments.empty()) {
        emit(Op::call_builtin, static_cast<std::uint32_t>(symbol.builtin));
      } else {
        emit_value(values_.make_builtin(symbol.builtin));
      }
      break;
    case SymbolKind::channel:
    case SymbolKind::constructor:
      emit_value(values_.make_atom(id));
      break;
    case SymbolKind::unsupported:
    case SymbolKind::module:
      emit(Op::unsupported, id.value);
      break;
    case SymbolKind::function:
      load_symbol(id);
      break;
    default:
      load_symbol(id);
      emit(Op::force);
  }
}

// --- Operators ----------------------------------------------------------------------------------

// Operators that chain to the right, and how far: the operands of `a . b . c`.
std::vector<ExprId> Lowering::right_spine(ExprId expr, InfixOp op) const {
  std::vector<ExprId> operands;
  for (;;) {
    const auto* infix = std::get_if<parser::InfixExpr>(&tree_.exprs[expr].node);
    if (infix == nullptr || infix->op != op) break;
    operands.push_back(infix->left);
    expr = infix->right;
  }
  operands.push_back(expr);
  return operands;
}

// A chain of left-associative operators, from the inside out.
void Lowering::infix_chain(ExprId expr) {
  const auto op_of = [&](ExprId e) -> const parser::InfixExpr* {
    const auto* infix = std::get_if<parser::InfixExpr>(&tree_.exprs[e].node);
    const bool leans_left =
        infix != nullptr && infix->op != InfixOp::dot && infix->op != InfixOp::guard;
    return leans_left ? infix : nullptr;
  };
  const auto& outermost = std::get<parser::InfixExpr>(tree_.exprs[expr].node);
  if (outermost.op == InfixOp::guard) return guard(expr);
  if (outermost.op == InfixOp::dot) {
    const std::vector<ExprId> operands = right_spine(expr, InfixOp::dot);
    for (const ExprId operand : operands) canonical(operand);
    span_ = tree_.exprs[expr].span;
    emit(Op::dot, static_cast<std::uint32_t>(operands.size()));
    return;
  }
  std::vector<ExprId> spine;
  for (ExprId e = expr; op_of(e) != nullptr; e = op_of(e)->left) spine.push_back(e);
  auto next = spine.rbegin();
  if (const auto* items = literal_sequence(*op_of(*next))) {
    // `<e1, .., en>^s` is n cells in front of s.
    for (const ExprId item : tree_.list(items->items)) lazy(item);
    lazy(op_of(*next)->right);
    span_ = tree_.exprs[*next].span;
    emit(Op::make_list, items->items.count);
    ++next;
  } else {
    infix_left(op_of(*next)->op, op_of(*next)->left);
  }
  while (next != spine.rend()) {
    span_ = tree_.exprs[*next].span;
    if (op_of(*next)->op != InfixOp::external_choice || is_timed()) {
      infix_right(*op_of(*next++));
      continue;
    }
    // A chain is one choice: made two by two it would take time that is quadratic in its length.
    std::uint32_t operands = 1;
    for (; next != spine.rend() && op_of(*next)->op == InfixOp::external_choice; ++next) {
      process(op_of(*next)->right);
      span_ = tree_.exprs[*next].span;
      ++operands;
    }
    emit(Op::external_choice, operands);
  }
}

// The left operand of a `^`, if it is a sequence written out.
const parser::CollectionExpr* Lowering::literal_sequence(const parser::InfixExpr& infix) const {
  if (infix.op != InfixOp::concat) return nullptr;
  const auto* e = std::get_if<parser::CollectionExpr>(&tree_.exprs[infix.left].node);
  const bool is_literal = e != nullptr && e->kind == Collection::sequence && e->statements.empty();
  return is_literal ? e : nullptr;
}

namespace {

ProcKind process_kind(InfixOp op) {
  switch (op) {
    case InfixOp::sequential:
      return ProcKind::sequential;
    case InfixOp::sliding_choice:
      return ProcKind::sliding_choice;
    case InfixOp::interrupt:
      return ProcKind::interrupt;
    case InfixOp::external_choice:
      return ProcKind::external_choice;
    case InfixOp::internal_choice:
      return ProcKind::internal_choice;
    case InfixOp::interleave:
      return ProcKind::interleave;
    case InfixOp::hide:
      return ProcKind::hide;
    default:
      return ProcKind::project;
  }
}

Op arithmetic(InfixOp op) {
  switch (op) {
    case InfixOp::multiply:
      return Op::multiply;
    case InfixOp::divide:
      return Op::divide;
    case InfixOp::modulo:
      return Op::modulo;
    case InfixOp::add:
      return Op::add;
    case InfixOp::subtract:
      return Op::subtract;
    case InfixOp::equal:
      return Op::equal;
    case InfixOp::not_equal:
      return Op::equal;
    case InfixOp::less:
      return Op::less;
    case InfixOp::less_equal:
      return Op::less_equal;
    case InfixOp::greater:
      return Op::greater;
    case InfixOp::greater_equal:
      return Op::greater_equal;
    default:
      break;
  }
  PERENTIE_CHECK(false, "an infix operator without meaning in an expression");
  return Op::pop;
}

}  // namespace

// The innermost left operand of a chain.
void Lowering::infix_left(InfixOp op, ExprId left) {
  if (is_process_operator(op)) {
    process(left);
  } else {
    value(left);
  }
}

// With the left operand on the stack: the right operand, and the operation.
void Lowering::infix_right(const parser::InfixExpr& infix) {
  const base::Span span = span_;
  const auto operation = [&](Op op, std::uint32_t b = 0) {
    span_ = span;
    emit(op, b);
  };
  switch (infix.op) {
    case InfixOp::logical_and:
    case InfixOp::logical_or: {
      Label end;
      emit_jump(infix.op == InfixOp::logical_and ? Op::and_jump : Op::or_jump, end);
      value(infix.right);
      operation(Op::check_bool);
      place(end);
      break;
    }
    case InfixOp::concat:
      lazy(infix.right);
      operation(Op::append);
      break;
    case InfixOp::hide:
    case InfixOp::project:
      canonical(infix.right);
      operation(Op::hide, static_cast<std::uint32_t>(process_kind(infix.op)));
      break;
    default:
      if (is_timed() && is_process_operator(infix.op)) {
        timed_infix(infix.op, infix.right);
      } else if (is_process_operator(infix.op)) {
        process(infix.right);
        operation(Op::process_binary, static_cast<std::uint32_t>(process_kind(infix.op)));
      } else {
        value(infix.right);
        operation(arithmetic(infix.op));
        if (infix.op == InfixOp::not_equal) operation(Op::logical_not);
      }
  }
}

// --- Calls --------------------------------------------------------------------------------------

void Lowering::apply(ExprId expr) {
  std::vector<ExprId> groups;  // outermost first
  ExprId callee = expr;
  while (const auto* e = std::get_if<parser::ApplyExpr>(&tree_.exprs[callee].node)) {
    groups.push_back(callee);
    callee = e->function;
  }
  const SymbolId symbol = std::holds_alternative<parser::NameExpr>(tree_.exprs[callee].node)
                              ? resolution_.of_expr[callee.value]
                              : SymbolId{};
  const auto arguments_of = [&](ExprId group) {
    return tree_.list(std::get<parser::ApplyExpr>(tree_.exprs[group].node).arguments);
  };
  if (symbol && apply_builtin(symbol, arguments_of(groups.back()))) {
    groups.pop_back();
  } else {
    value(callee);
  }
  std::uint32_t group_number = 0;
  for (auto group = groups.rbegin(); group != groups.rend(); ++group) {
    // The arguments of a process are part of its name: they are evaluated anyway.
    const bool names_process = symbol && resolution_.symbols[symbol].is_process &&
                               ++group_number == resolution_.symbols[symbol].groups;
    const auto arguments = arguments_of(*group);
    for (const ExprId argument : arguments) {
      if (names_process) {
        canonical(argument);
      } else {
        lazy(argument);
      }
    }
    span_ = tree_.exprs[*group].span;
    emit(Op::call, static_cast<std::uint32_t>(arguments.size()));
  }
}

bool Lowering::apply_builtin(SymbolId id, std::span<const ExprId> arguments) {
  const Symbol& symbol = resolution_.symbols[id];
  if (symbol.kind != SymbolKind::builtin) return false;
  const BuiltinInfo& builtin = info(symbol.builtin);
  if (builtin.arguments.empty() || builtin.arguments.size() != arguments.size()) return false;
  const base::Span span = span_;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (builtin.arguments[i] == 'c') {
      canonical(arguments[i]);
    } else {
      value(arguments[i]);
    }
  }
  span_ = span;
  emit(Op::call_builtin, static_cast<std::uint32_t>(symbol.builtin), arguments.size());
  return true;
}

// --- Collections --------------------------------------------------------------------------------

void Lowering::collection(const parser::CollectionExpr& e) {
  const base::Span span = span_;
  const auto items = tree_.list(e.items);
  const auto statements = tree_.list(e.statements);
  if (e.kind == Collection::sequence) {
    const auto push_items = [&] {
      for (const ExprId item : items) lazy(item);
      span_ = span;
    };
    if (!statements.empty()) {
      sequence_comprehension(
          statements, [&] { push_items(); },
          [&] { emit(Op::make_list, static_cast<std::uint32_t>(items.size())); });
      return;
    }
    push_items();
    emit_value(values_.empty_seq());
    emit(Op::make_list, static_cast<std::uint32_t>(items.size()));
    return;
  }
  emit(Op::acc_begin);
  strict_loop(statements, true, [&] {
    for (const ExprId item : items) {
      canonical(item);
      emit(Op::acc_add);
    }
  });
  span_ = span;
  emit(e.kind == Collection::set ? Op::acc_set : Op::acc_productions);
}

void Lowering::range(const parser::RangeExpr& e) {
  const base::Span span = span_;
  const auto statements = tree_.list(e.statements);
  const auto bounds = [&] {
    canonical(e.first);
    if (e.last) canonical(e.last);
    span_ = span;
  };
  if (e.kind == Collection::set) {
    if (statements.empty()) {
      bounds();
      emit(Op::make_range_set, e.last ? 1 : 0);
      return;
    }
    emit(Op::acc_begin);
    strict_loop(statements, true, [&] {
      bounds();
      emit(Op::make_range_set, e.last ? 1 : 0);
      emit(Op::acc_add);
    });
    span_ = span;
    emit(Op::acc_set);
    emit(Op::call_builtin, static_cast<std::uint32_t>(Builtin::set_union_all), 1);
    return;
  }
  const auto sequence = [&] {
    load_symbol(e.last ? prelude_.from_to : prelude_.from);
    bounds();
    emit(Op::call, e.last ? 2 : 1);
  };
  if (statements.empty()) return sequence();
  sequence_comprehension(
      statements, [&] { sequence(); }, [&] { emit(Op::append); });
}

// --- Statements ---------------------------------------------------------------------------------

// Loops over all bindings at once; for sets and for the operands of processes.
void Lowering::strict_loop(std::span<const StatementId> statements, bool over_sets,
                           const Emit& body) {
  if (statements.empty()) return body();
  const auto rest = statements.subspan(1);
  std::visit(overload{
                 [&](const parser::Filter& s) {
                   Label skip;
                   value(s.condition);
                   emit_jump(Op::jump_if_false, skip);
                   strict_loop(rest, over_sets, body);
                   place(skip);
                 },
                 [&](const parser::Generator& s) {
                   Label done;
                   Label fail;
                   canonical(s.source);
                   emit(Op::iter_begin, over_sets ? 0 : 1);
                   const Address next = here();
                   emit_jump(Op::iter_next, done);
                   emit(Op::enter, open_scope(ScopeKind::binding).value);
                   pattern(s.pattern, fail);
                   strict_loop(rest, over_sets, body);
                   place(fail);
                   emit(Op::leave);
                   close_scope();
                   emit(Op::jump, next);
                   place(done);
                 },
             },
             tree_.statements[statements[0]].node);
}

// A lazy comprehension `<items | statements>` as one block. Each generator has a scope that holds
// the sequence still to go through and a thunk for what follows when it is exhausted; each binding
// has a scope that holds the rest of the sequence. The code for one element ends by returning a
// cell whose tail is a thunk that goes on from there (Wadler's translation of list comprehensions).
struct Lowering::SequenceLoop {
  std::uint32_t source_slot = 0;
  std::uint32_t follow_slot = 0;
  std::uint32_t rest_slot = 0;  // in the binding's scope
  Address next = 0;
  std::vector<Address> resume_uses;  // `make_thunk`s that want the block which goes on
  Label resume;                      // jumps there
};

void Lowering::sequence_comprehension(std::span<const StatementId> statements,
                                      const Emit& push_items, const Emit& link) {
  sequence_level(statements, nullptr, push_items, link);
}

void Lowering::sequence_level(std::span<const StatementId> statements, SequenceLoop* outer,
                              const Emit& push_items, const Emit& link) {
  // Pushes what comes after all elements of this level.
  const auto push_follow = [&] {
    if (outer == nullptr) {
      emit_value(values_.empty_seq());
    } else {
      outer->resume_uses.push_back(emit(Op::make_thunk));
    }
  };
  if (statements.empty()) {
    push_items();
    push_follow();
    link();
    emit(Op::ret);
    return;
  }
  const auto rest = statements.subspan(1);
  if (const auto* s = std::get_if<parser::Filter>(&tree_.statements[statements[0]].node)) {
    Label skip;
    value(s->condition);
    emit_jump(Op::jump_if_false, outer == nullptr ? skip : outer->resume);
    sequence_level(rest, outer, push_items, link);
    place(skip);
    if (outer == nullptr) {
      emit_value(values_.empty_seq());
      emit(Op::ret);
    }
    return;
  }
  const auto& s = std::get<parser::Generator>(tree_.statements[statements[0]].node);
  SequenceLoop loop;
  push_follow();
  emit(Op::enter, open_scope(ScopeKind::binding).value);
  loop.source_slot = add_slot();
  loop.follow_slot = add_slot();
  emit(Op::store, loop.follow_slot);
  lazy(s.source);
  emit(Op::store, loop.source_slot);
  loop.next = here();
  Label exhausted;
  Label fail;
  emit(Op::load, loop.source_slot);
  emit(Op::force);
  span_ = tree_.exprs[s.source].span;
  emit_jump(Op::match_cons, exhausted);
  emit(Op::enter, open_scope(ScopeKind::binding).value);
  loop.rest_slot = add_slot();
  const std::uint32_t head = add_slot();
  emit(Op::store, head);
  emit(Op::store, loop.rest_slot);
  emit(Op::load, head);
  pattern(s.pattern, fail);
  sequence_level(rest, &loop, push_items, link);
  // Go on with the rest of the sequence: reached by jumps and as the block of thunks.
  place(fail);
  place(loop.resume);
  for (const Address use : loop.resume_uses) program_.code[use].b = here();
  emit(Op::load, loop.rest_slot);
  emit(Op::leave);
  close_scope();
  emit(Op::store, loop.source_slot);
  emit(Op::jump, loop.next);
  place(exhausted);
  emit(Op::load, loop.follow_slot);
  emit(Op::force);
  emit(Op::ret);
  close_scope();
}

}  // namespace perentie::semantics

// Lowering of process expressions: prefixes with their fields, operators with sets, replicated
// forms.
#include <algorithm>

#include "lower.hpp"
#include "perentie/base/overload.hpp"

namespace perentie::semantics {

using parser::ExprId;
using parser::FieldId;
using parser::FieldKind;
using parser::ReplicatedOp;

void Lowering::process(ExprId expr, Tail tail) {
  value(expr);
  span_ = tree_.exprs[expr].span;
  if (leaves(expr) != Leaves::process) emit(Op::check_process);
  finish(tail);
}

void Lowering::three(ExprId left, ExprId set, ExprId right, ProcKind kind) {
  const base::Span span = span_;
  process(left);
  canonical(set);
  // An exception is not thrown by the passing of time.
  if (kind != ProcKind::exception) add_tock();
  process(right);
  span_ = span;
  emit(Op::process_ternary, static_cast<std::uint32_t>(kind));
}

void Lowering::guard(ExprId expr) {
  // `b & c & P`: any false condition makes the whole STOP.
  Label stop;
  Label end;
  for (;;) {
    const auto* infix = std::get_if<parser::InfixExpr>(&tree_.exprs[expr].node);
    if (infix == nullptr || infix->op != parser::InfixOp::guard) break;
    value(infix->left);
    span_ = tree_.exprs[infix->left].span;
    emit_jump(Op::jump_if_false, stop);
    expr = infix->right;
  }
  process(expr);
  emit_jump(Op::jump, end);
  place(stop);
  if (is_timed()) {
    apply_to_tock(prelude_.timed_stop);
  } else {
    emit(Op::call_builtin, static_cast<std::uint32_t>(Builtin::stop));
  }
  place(end);
}

// `e1 -> e2 -> .. -> P`: all events first, then the body, then the prefixes from the inside out.
void Lowering::prefix(ExprId expr) {
  std::vector<base::Span> prefixes;
  for (;;) {
    const auto* e = std::get_if<parser::PrefixExpr>(&tree_.exprs[expr].node);
    if (e == nullptr) {
      process(expr);
      break;
    }
    const auto fields = tree_.list(e->fields);
    const bool has_input = std::any_of(fields.begin(), fields.end(), [&](FieldId field) {
      return tree_.fields[field].kind != FieldKind::output;
    });
    span_ = tree_.exprs[expr].span;
    if (has_input) {
      communication(*e);
      break;
    }
    canonical(e->channel);
    for (const FieldId field : fields) canonical(tree_.fields[field].expression);
    span_ = tree_.exprs[e->channel].span;
    if (!fields.empty()) emit(Op::dot, static_cast<std::uint32_t>(fields.size()) + 1);
    emit(Op::check_event);  // before the body is evaluated: the first error is the one to report
    prefixes.push_back(tree_.exprs[expr].span);
    expr = e->body;
  }
  for (auto span = prefixes.rbegin(); span != prefixes.rend(); ++span) {
    span_ = *span;
    emit(Op::prefix);
  }
}

// A prefix with input fields (4.3): `$` fields make an internal choice, the others an external one.
void Lowering::communication(const parser::PrefixExpr& e) {
  const base::Span span = span_;
  const auto fields = tree_.list(e.fields);
  const auto first_other = std::find_if(fields.begin(), fields.end(), [&](FieldId field) {
    return tree_.fields[field].kind != FieldKind::nondet_input;
  });
  const auto chosen = fields.first(static_cast<std::size_t>(first_other - fields.begin()));
  const auto offered = fields.subspan(chosen.size());
  const bool binds = std::any_of(offered.begin(), offered.end(), [&](FieldId field) {
    return tree_.fields[field].pattern && binds_used_variable(tree_.fields[field].pattern);
  });

  const Emit event_then_body = [&] {
    span_ = span;
    emit(Op::check_event);
    process(e.body);
    span_ = span;
    emit(Op::prefix);
  };
  // With the channel and the chosen fields on the stack: one process.
  const Emit offer = [&] {
    if (offered.empty()) return event_then_body();
    emit(Op::acc_begin);
    if (binds) {
      field_loop(offered, true, [&] {
        event_then_body();
        emit(Op::acc_add);
      });
      span_ = span;
      emit(Op::acc_process, static_cast<std::uint32_t>(ProcKind::external_choice));
      return;
    }
    // No variable is used later: one prefix with a set of events, or STOP without any (3.8.3).
    field_loop(offered, true, [&] {
      span_ = span;
      emit(Op::check_event);
      emit(Op::acc_add);
    });
    Label none;
    Label end;
    span_ = span;
    emit(Op::acc_set);
    emit_jump(Op::jump_if_no_events, none);
    process(e.body);
    span_ = span;
    emit(Op::event_set_prefix);
    emit_jump(Op::jump, end);
    place(none);
    emit(Op::pop);
    emit(Op::call_builtin, static_cast<std::uint32_t>(Builtin::stop));
    place(end);
  };

  canonical(e.channel);
  if (chosen.empty()) return offer();
  emit(Op::acc_begin);
  field_loop(chosen, offered.empty(), [&] {
    offer();
    emit(Op::acc_add);
  });
  span_ = span;
  emit(Op::acc_process, static_cast<std::uint32_t>(ProcKind::internal_choice), 1);
}

// The constructor or channel with fields that a pattern names alone, if it does.
SymbolId Lowering::partial_atom(parser::PatternId pattern) const {
  if (!std::holds_alternative<parser::NamePattern>(tree_.patterns[pattern].node)) return {};
  const SymbolId id = resolution_.of_pattern[pattern.value];
  if (!id) return {};
  const Symbol& symbol = resolution_.symbols[id];
  const auto& decl = tree_.decls[symbol.decl].node;
  if (symbol.kind == SymbolKind::channel) {
    return std::get<parser::ChannelDecl>(decl).type ? id : SymbolId{};
  }
  if (symbol.kind != SymbolKind::constructor) return {};
  const auto& datatype = std::get<parser::DatatypeDecl>(decl);
  return tree_.list(datatype.constructors)[symbol.index].type ? id : SymbolId{};
}

// With a partial event on the stack: `leaf` for each way the fields extend it. The last field of
// the prefix (`nothing_follows`) takes all remaining components (4.3.5).
void Lowering::field_loop(std::span<const FieldId> fields, bool nothing_follows, const Emit& leaf) {
  if (fields.empty()) return leaf();
  const parser::Field& field = tree_.fields[fields[0]];
  const auto rest = fields.subspan(1);
  if (field.kind == FieldKind::output) {
    canonical(field.expression);
    span_ = field.span;
    emit(Op::dot, 2);
    return field_loop(rest, nothing_follows, leaf);
  }
  if (const SymbolId symbol = partial_atom(field.pattern); symbol && !field.expression) {
    // `?A.x`: the next fields are those of the constructor.
    emit_value(values_.make_atom(symbol));
    span_ = field.span;
    emit(Op::dot, 2);
    return field_loop(rest, nothing_follows, leaf);
  }
  Label done;
  Label fail;
  if (field.expression) canonical(field.expression);
  span_ = field.span;
  emit(Op::field_begin, field.expression ? 1 : 0, rest.empty() && nothing_follows ? 1 : 0);
  const Address next = here();
  emit_jump(Op::field_next, done);
  emit(Op::enter, open_scope(ScopeKind::binding).value);
  pattern(field.pattern, fail);
  field_loop(rest, nothing_follows, leaf);
  emit(Op::leave);
  emit(Op::jump, next);
  place(fail);
  emit(Op::pop);  // the extended event
  emit(Op::leave);
  emit(Op::jump, next);
  close_scope();
  place(done);
}

namespace {

ProcKind process_kind(ReplicatedOp op) {
  switch (op) {
    case ReplicatedOp::sequential:
      return ProcKind::sequential;
    case ReplicatedOp::external_choice:
      return ProcKind::external_choice;
    case ReplicatedOp::internal_choice:
      return ProcKind::internal_choice;
    case ReplicatedOp::interleave:
      return ProcKind::interleave;
    case ReplicatedOp::parallel:
      return ProcKind::parallel;
    case ReplicatedOp::alphabet_parallel:
      return ProcKind::alphabet_parallel;
    case ReplicatedOp::sync_choice:
      return ProcKind::sync_choice;
  }
  return ProcKind::stop;
}

}  // namespace

void Lowering::replicated(const parser::ReplicatedExpr& e) {
  const base::Span span = span_;
  const bool alphabet_inside = e.op == ReplicatedOp::alphabet_parallel;
  if (e.alphabet && !alphabet_inside) canonical(e.alphabet);
  emit(Op::acc_begin);
  strict_loop(tree_.list(e.statements), e.op != ReplicatedOp::sequential, [&] {
    if (alphabet_inside) canonical(e.alphabet);
    process(e.body);
    span_ = span;
    emit(alphabet_inside ? Op::acc_add_alphabet : Op::acc_add);
  });
  span_ = span;
  emit(Op::acc_process, static_cast<std::uint32_t>(process_kind(e.op)));
}

void Lowering::replicated_link(const parser::ReplicatedLinkExpr& e) {
  const base::Span span = span_;
  emit(Op::acc_begin);
  strict_loop(tree_.list(e.statements), false, [&] {
    ties(e.links);
    process(e.body);
    span_ = span;
    emit(Op::acc_add_link);
  });
  span_ = span;
  emit(Op::acc_link);
}

// The pairs of a renaming or link, in an accumulator.
void Lowering::ties(const parser::Ties& ties) {
  const auto from = tree_.list(ties.from);
  const auto to = tree_.list(ties.to);
  emit(Op::acc_begin);
  strict_loop(tree_.list(ties.statements), true, [&] {
    for (std::size_t i = 0; i < from.size(); ++i) {
      canonical(from[i]);
      canonical(to[i]);
      emit(Op::acc_add_tie);
    }
  });
}

}  // namespace perentie::semantics

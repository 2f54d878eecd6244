// Lowering of timed sections: every process lets time pass (CSPM reference 2.10.4).
//
// The translation keeps the operators and adds the event `tock`: a prefix waits for its event and
// then takes the event's time; choices and interrupts synchronise on `tock`, and so do parallels.
#include <fmt/format.h>

#include "lower.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

using parser::ExprId;
using parser::FieldId;
using parser::FieldKind;
using parser::InfixOp;
using parser::ReplicatedOp;

void Lowering::timed_section(parser::DeclId id, const std::function<void(parser::DeclId)>& declare,
                             const std::function<Location(ExprId)>& declare_duration) {
  const auto& d = std::get<parser::TimedDecl>(tree_.decls[id].node);
  const TimedIndex outside = timed_;
  TimedSection section{resolution_.tocks.at(id.value), {}};
  if (d.duration) section.duration = declare_duration(d.duration);
  timed_sections_.push_back(section);
  timed_ = static_cast<TimedIndex>(timed_sections_.size() - 1);
  for (const parser::DeclId member : tree_.list(d.declarations)) declare(member);
  timed_ = outside;
}

void Lowering::refuse_in_timed_section(base::Span span, std::string_view what) {
  if (!is_timed()) return;
  diagnostics_.report(codes::bad_timed_section, span,
                      fmt::format("{} is not possible in a timed section", what));
}

// --- Constants and sets -------------------------------------------------------------------------

bool Lowering::is_timed_builtin(SymbolId id) const {
  if (timed_ == not_timed) return false;
  const Symbol& symbol = resolution_.symbols[id];
  return id == prelude_.wait || id == prelude_.timed_priority ||
         (symbol.kind == SymbolKind::builtin &&
          (symbol.builtin == Builtin::stop || symbol.builtin == Builtin::skip));
}

void Lowering::apply_to_tock(SymbolId function) {
  const Symbol& symbol = resolution_.symbols[function];
  if (symbol.kind == SymbolKind::builtin) {
    function = symbol.builtin == Builtin::stop ? prelude_.timed_stop : prelude_.timed_skip;
  }
  load_symbol(function);
  emit(Op::force);
  emit_value(tock());
  emit(Op::call, 1);
}

void Lowering::push_tock_set() {
  const ValueId event = tock();
  emit_value(values_.make_sorted_set(std::span(&event, 1)));
}

// The set of events on top gets the time event; nothing outside timed sections.
void Lowering::add_tock() {
  if (!is_timed()) return;
  push_tock_set();
  emit(Op::call_builtin, static_cast<std::uint32_t>(Builtin::set_union), 2);
}

// --- Prefixes -----------------------------------------------------------------------------------

// `e -> P` is the named state X = tock -> X [] e -> tock -> .. -> P.
void Lowering::timed_prefix(ExprId expr) {
  const FunctionId function{static_cast<std::uint32_t>(program_.functions.size())};
  program_.functions.add(FunctionInfo{.span = tree_.exprs[expr].span,
                                      .is_process = true,
                                      .owner = owner_,
                                      .is_timed_prefix = true});
  emit(Op::process_ref, function.value, depth() == 0 ? no_frame : 0);
  queue([this, function, expr](Address entry) {
    program_.functions[function].entry = entry;
    span_ = tree_.exprs[expr].span;
    timed_prefix_body(function, std::get<parser::PrefixExpr>(tree_.exprs[expr].node));
    emit(Op::ret);
  });
}

void Lowering::timed_prefix_body(FunctionId function, const parser::PrefixExpr& e) {
  const base::Span span = span_;
  emit(Op::acc_begin);
  emit_value(tock());
  emit(Op::process_ref, function.value, depth() == 0 ? no_frame : 0);
  emit(Op::prefix);
  emit(Op::acc_add);
  const Emit event_time_body = [&] {
    span_ = span;
    emit(Op::check_event);
    emit_value(tock());
    const Location& duration = timed_sections_[timed_].duration;
    if (duration.place == Place::nowhere) {
      emit_value(values_.make_int(1));
    } else {
      if (duration.place == Place::global) {
        emit(Op::load_global, duration.slot);
      } else {
        emit(Op::load, duration.slot, depth() - duration.depth);
      }
      emit(Op::force);
      emit(Op::copy, 2);
      emit(Op::call, 1);
      emit(Op::force);
    }
    process(e.body);
    span_ = span;
    emit(Op::delayed_prefix);
    emit(Op::acc_add);
  };
  const auto fields = tree_.list(e.fields);
  for (const FieldId field : fields) {
    if (tree_.fields[field].kind == FieldKind::nondet_input) {
      refuse_in_timed_section(tree_.fields[field].span, "a nondeterministic input `$`");
    }
  }
  canonical(e.channel);
  field_loop(fields, true, event_time_body);
  span_ = span;
  emit(Op::acc_process, static_cast<std::uint32_t>(ProcKind::external_choice));
}

// --- Operators ----------------------------------------------------------------------------------

// With the left operand on the stack.
void Lowering::timed_infix(InfixOp op, ExprId right) {
  const base::Span span = span_;
  switch (op) {
    case InfixOp::external_choice:
      process(right);
      push_tock_set();
      apply_to_tock(prelude_.timed_stop);
      span_ = span;
      emit(Op::timed_choice);
      break;
    case InfixOp::interleave:
    case InfixOp::interrupt:
      push_tock_set();
      process(right);
      span_ = span;
      emit(Op::process_ternary,
           static_cast<std::uint32_t>(op == InfixOp::interleave ? ProcKind::parallel
                                                                : ProcKind::sync_interrupt));
      break;
    default: {
      process(right);
      span_ = span;
      const ProcKind kind = op == InfixOp::sequential        ? ProcKind::sequential
                            : op == InfixOp::internal_choice ? ProcKind::internal_choice
                                                             : ProcKind::sliding_choice;
      emit(Op::process_binary, static_cast<std::uint32_t>(kind));
    }
  }
}

// Without operands, `;` is the timed SKIP, and the others but `|~|` are the timed STOP (2.10.5).
void Lowering::timed_replicated(const parser::ReplicatedExpr& e) {
  const base::Span span = span_;
  ProcKind kind = ProcKind::sequential;
  bool has_alphabet = true;  // below the accumulated operands
  bool alphabets_inside = false;
  switch (e.op) {
    case ReplicatedOp::sequential:
      has_alphabet = false;
      break;
    case ReplicatedOp::internal_choice:
      kind = ProcKind::internal_choice;
      has_alphabet = false;
      break;
    case ReplicatedOp::external_choice:
    case ReplicatedOp::sync_choice:
      kind = ProcKind::sync_choice;
      break;
    case ReplicatedOp::interleave:
    case ReplicatedOp::parallel:
      kind = ProcKind::parallel;
      break;
    case ReplicatedOp::alphabet_parallel:
      kind = ProcKind::alphabet_parallel;
      has_alphabet = false;
      alphabets_inside = true;
      break;
  }
  if (has_alphabet && e.alphabet) {
    canonical(e.alphabet);
    add_tock();
  } else if (has_alphabet) {
    push_tock_set();
  }
  Label empty;
  Label end;
  emit(Op::acc_begin);
  strict_loop(tree_.list(e.statements), e.op != ReplicatedOp::sequential, [&] {
    if (alphabets_inside) {
      canonical(e.alphabet);
      add_tock();
    }
    process(e.body);
    span_ = span;
    emit(alphabets_inside ? Op::acc_add_alphabet : Op::acc_add);
  });
  span_ = span;
  if (kind != ProcKind::internal_choice) emit_jump(Op::acc_if_empty, empty);
  emit(Op::acc_process, static_cast<std::uint32_t>(kind));
  emit_jump(Op::jump, end);
  place(empty);
  if (has_alphabet) emit(Op::pop);
  apply_to_tock(kind == ProcKind::sequential ? prelude_.timed_skip : prelude_.timed_stop);
  place(end);
}

}  // namespace perentie::semantics

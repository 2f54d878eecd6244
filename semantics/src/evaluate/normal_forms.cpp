// Evaluation to weak head normal form and to complete values, without recursion: every pending
// step is an entry of the control stack.
#include <algorithm>

#include <fmt/format.h>

#include "machine.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

bool Machine::is_whnf(Word word) const {
  if (!word.is_object()) return true;
  const ObjectKind kind = word.as_object()->kind;
  return kind != ObjectKind::thunk && kind != ObjectKind::blackhole;
}

void Machine::enter_thunk(Object* thunk) {
  if (thunk->kind == ObjectKind::blackhole) {
    // A datatype whose set is asked for while it is being made has infinitely many values.
    const Instruction first = program_.code[thunk->aux];
    if (first.op == Op::datatype_set) {
      push(values_.make_data_set(SymbolId{first.b}));
      return_value();
      return;
    }
    fail(codes::depends_on_itself, "this value depends on itself");
  }
  control_.push_back({ControlKind::update, 0, 0, Word::object(thunk)});
  thunk->kind = ObjectKind::blackhole;
  frame_ = (*thunk)[0];
  pc_ = thunk->aux;
}

bool Machine::canonicalise_top() {
  for (;;) {
    const Word word = settled(top());
    top() = word;
    if (is_canonical(word)) return true;
    Object* object = word.as_object();
    switch (object->kind) {
      case ObjectKind::cell:
        control_.push_back({ControlKind::canon_cells, 1, 0, word});
        top() = (*object)[0];
        break;
      case ObjectKind::tuple:
        control_.push_back({ControlKind::canon_tuple, 1, 0, word});
        top() = (*object)[0];
        break;
      case ObjectKind::closure: {
        const auto scope = canonical_scope((*object)[0]);
        if (!scope) {
          pop();
          control_.push_back({ControlKind::canon_closure, 0, 0, word});
          return identify_scope((*object)[0]);
        }
        const auto group = static_cast<std::uint32_t>((*object)[1].as_integer());
        top() = Word::value(values_.make_function(object->aux, group, *scope));
        return true;
      }
      default:
        pop();
        control_.push_back({ControlKind::canon});
        enter_thunk(object);
        return false;
    }
  }
}

// The heads of a sequence so far are on the stack, evaluated; `tail` follows them.
bool Machine::canonicalise_tail(std::uint32_t heads, Word tail) {
  tail = settled(tail);
  if (tail.is_value()) {
    ValueId seq = tail.as_value();
    if (!values_.is_seq(seq)) {
      fail(codes::wrong_type,
           fmt::format("a sequence is needed, but this is `{}`", describe(tail)));
    }
    for (std::uint32_t i = 0; i < heads; ++i) seq = values_.make_cons(to_value(top(i)), seq);
    replace(heads, seq);
    return true;
  }
  if (tail.is_integer()) {
    fail(codes::wrong_type, fmt::format("a sequence is needed, but this is `{}`", describe(tail)));
  }
  Object* object = tail.as_object();
  if (object->kind == ObjectKind::cell) {
    control_.push_back({ControlKind::canon_cells, heads + 1, 0, tail});
    push((*object)[0]);
    return canonicalise_top();
  }
  if (is_whnf(tail)) {
    fail(codes::wrong_type, fmt::format("a sequence is needed, but this is {}", describe(tail)));
  }
  control_.push_back({ControlKind::canon_tail, heads});
  enter_thunk(object);
  return false;
}

bool Machine::canonicalise_tuple(std::uint32_t done, Word tuple) {
  Object* object = tuple.as_object();
  if (done < object->size) {
    control_.push_back({ControlKind::canon_tuple, done + 1, 0, tuple});
    push((*object)[done]);
    return canonicalise_top();
  }
  replace(done, values_.make_tuple(top_values(done)));
  return true;
}

void Machine::canon_operand(std::size_t index, Address retry_at) {
  control_.push_back(
      {ControlKind::canon_operand, static_cast<std::uint32_t>(index), retry_at, frame_});
  push(operands_[index]);
  if (canonicalise_top()) return_value();
}

// --- Scopes -------------------------------------------------------------------------------------

// Gives a frame and all that enclose it their canonical scopes, from the outermost inwards. Leaves
// a value that is to be dropped.
bool Machine::identify_scope(Word aim) {
  for (;;) {
    Word next;
    for (Word f = aim; f.is_object() && !canonical_scope(f); f = (*f.as_object())[frame_parent]) {
      next = f;
    }
    if (next.is_nothing()) {
      push(Word::integer(0));
      return true;
    }
    Object* frame = next.as_object();
    const ScopeInfo& info = program_.scopes[ScopeId{frame->aux}];
    if (info.identity.empty()) {
      finish_scope(frame, {});
      continue;
    }
    control_.push_back({ControlKind::canon_slot, 1, 0, next, aim});
    push_identity(frame, info.identity[0]);
    return canonicalise_top();
  }
}

// A pattern variable that this activation has not bound (another clause would) identifies nothing.
void Machine::push_identity(Object* frame, std::uint32_t slot) {
  const Word word = (*frame)[frame_slots + slot];
  push(word.is_nothing() ? Word::value(values_.ignored()) : word);
}

bool Machine::identify_slot(std::uint32_t done, Word frame_word, Word aim) {
  Object* frame = frame_word.as_object();
  const ScopeInfo& info = program_.scopes[ScopeId{frame->aux}];
  if (done < info.identity.size()) {
    control_.push_back({ControlKind::canon_slot, done + 1, 0, frame_word, aim});
    push_identity(frame, info.identity[done]);
    return canonicalise_top();
  }
  const std::vector<ValueId> identity = top_values(done);
  operands_.resize(operands_.size() - done);
  finish_scope(frame, identity);
  return identify_scope(aim);
}

}  // namespace perentie::semantics

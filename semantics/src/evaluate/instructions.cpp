// What each instruction does. An instruction that fails or must be repeated has not yet changed the
// operand stack: operands are read first and replaced last.
#include <algorithm>

#include <fmt/format.h>

#include "../maps.hpp"
#include "brief.hpp"
#include "machine.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"
#include "sets.hpp"

namespace perentie::semantics {

// The hot loop: `step` is inlined here.
void Machine::run_instructions() {
  while (running_) {
    if (fuel_-- == 0) safepoint();
    step(program_.code[pc_++]);
  }
}

[[gnu::always_inline]] inline void Machine::step(Instruction in) {
  const Address at = pc_ - 1;
  switch (in.op) {
    case Op::push_value:
      push(ValueId{in.b});
      break;
    case Op::load:
      push((*frame_up(in.a))[frame_slots + in.b]);
      break;
    case Op::load_global:
      push(globals_[in.b]);
      break;
    case Op::store: {
      const Word word = pop();
      (*frame_.as_object())[frame_slots + in.b] = word;
      break;
    }
    case Op::copy:
      push(top(in.b));
      break;
    case Op::pop:
      pop();
      break;
    case Op::force:
      force_top();
      break;
    case Op::canon:
      top() = settled(top());
      if (!is_canonical(top())) {
        control_.push_back({ControlKind::resume, pc_, 0, frame_});
        if (canonicalise_top()) return_value();
      }
      break;

    case Op::enter:
      frame_ = Word::object(new_frame(ScopeId{in.b}, frame_));
      break;
    case Op::leave:
      frame_ = (*frame_.as_object())[frame_parent];
      break;
    case Op::make_thunk: {
      Object* thunk = heap_.allocate(ObjectKind::thunk, in.b, 1);
      (*thunk)[0] = frame_;
      push(Word::object(thunk));
      break;
    }
    case Op::make_closure: {
      Object* closure = heap_.allocate(ObjectKind::closure, in.b, 2);
      (*closure)[0] = frame_;
      (*closure)[1] = Word::integer(0);
      push(Word::object(closure));
      break;
    }
    case Op::process_ref:
      process_constant(in.a, FunctionId{in.b}, at);
      break;
    case Op::call:
      call(in.b, at);
      break;
    case Op::call_builtin:
      apply_builtin(static_cast<Builtin>(in.b), in.a, in.a);
      break;
    case Op::ret:
      return_value();
      break;

    case Op::jump:
      pc_ = in.b;
      break;
    case Op::jump_if_false:
      if (!boolean_at(0)) pc_ = in.b;
      pop();
      break;
    case Op::and_jump:
    case Op::or_jump:
      if (boolean_at(0) == (in.op == Op::or_jump)) {
        pc_ = in.b;
      } else {
        pop();
      }
      break;
    case Op::jump_if_no_events:
      if (value_at(0) == values_.empty_set()) pc_ = in.b;
      break;

    case Op::make_list:
      make_list(in.b);
      break;
    case Op::append:
      append();
      break;
    case Op::make_tuple:
      make_tuple(in.b);
      break;
    case Op::make_map:
      make_map(in.b);
      break;
    case Op::make_range_set:
      make_range_set(in.b != 0);
      break;
    case Op::dot: {
      ValueId value = value_at(0);
      for (std::uint32_t i = 1; i < in.b; ++i) value = data_.append(value_at(i), value);
      replace(in.b, value);
      break;
    }
    case Op::tuple_product:
      replace(in.b, tuple_product(values_, set_operands(in.b)));
      break;
    case Op::dot_product:
      dot_product(in.b);
      break;
    case Op::make_fields: {
      std::vector<ValueId> fields;
      for (const ValueId set : set_operands(in.b)) {
        const std::vector<ValueId> columns = data_.decompose(set);
        fields.insert(fields.end(), columns.begin(), columns.end());
      }
      replace(in.b, values_.make_tuple(fields));
      break;
    }
    case Op::datatype_set:
      datatype_set(SymbolId{in.b});
      break;

    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::modulo:
      arithmetic(in.op);
      break;
    case Op::negate: {
      const std::int64_t value = integer_at(0, "negation");
      top() = checked_integer(-value, false);
      break;
    }
    case Op::logical_not:
      replace(1, values_.make_bool(!boolean_at(0)));
      break;
    case Op::check_bool:
      boolean_at(0);
      break;
    case Op::equal:
    case Op::less:
    case Op::less_equal:
    case Op::greater:
    case Op::greater_equal:
      compare(in.op, at);
      break;

    case Op::acc_begin:
      accumulators_.emplace_back();
      break;
    case Op::acc_if_empty:
      if (accumulators_.back().empty()) {
        accumulators_.pop_back();
        pc_ = in.b;
      }
      break;
    case Op::acc_add:
      accumulators_.back().push_back(value_at(0).bits);
      pop();
      break;
    case Op::acc_add_all: {
      const ValueId set = require_set(value_at(0));
      for (const ValueId v : elements_of(values_, set, "list the elements of")) {
        accumulators_.back().push_back(v.bits);
      }
      pop();
      break;
    }
    case Op::acc_set: {
      std::vector<ValueId> elements;
      for (const std::uint32_t bits : take_accumulator()) elements.push_back(ValueId{bits});
      push(values_.make_set(std::move(elements)));
      break;
    }
    case Op::acc_productions: {
      std::vector<ValueId> all;
      for (const std::uint32_t bits : accumulators_.back()) {
        const std::vector<ValueId> productions = data_.productions(ValueId{bits});
        all.insert(all.end(), productions.begin(), productions.end());
      }
      accumulators_.pop_back();
      push(values_.make_set(std::move(all)));
      break;
    }
    case Op::iter_begin:
      iter_begin(in.b == 0);
      break;
    case Op::iter_next:
      iter_next(in.b);
      break;
    case Op::field_begin:
      field_begin(in.a != 0, in.b != 0);
      break;
    case Op::field_next:
      field_next(in.b);
      break;

    case Op::match_value:
    case Op::match_empty_seq:
    case Op::match_cons:
    case Op::match_ends:
    case Op::match_empty_set:
    case Op::match_single_set:
    case Op::match_tuple:
    case Op::match_dot:
      match(in);
      break;
    case Op::no_match:
      fail_no_match(FunctionId{in.b});
      break;
    case Op::no_match_value:
      fail(codes::no_clause_matches,
           fmt::format("`{}` does not match the pattern", describe(top())));
    case Op::unsupported:
      fail_unsupported(SymbolId{in.b});
      break;

    default:
      process_instruction(in);
      break;
  }
}

// --- Numbers and comparisons --------------------------------------------------------------------

Word Machine::checked_integer(std::int64_t value, bool overflow) {
  if (!overflow && value >= min_integer && value <= max_integer) return Word::integer(value);
  fail(codes::integer_overflow, "an integer of more than 63 bits would be needed");
}

void Machine::arithmetic(Op op) {
  const std::int64_t a = integer_at(1, "arithmetic");
  const std::int64_t b = integer_at(0, "arithmetic");
  std::int64_t result = 0;
  bool overflow = false;
  switch (op) {
    case Op::add:
      overflow = __builtin_add_overflow(a, b, &result);
      break;
    case Op::subtract:
      overflow = __builtin_sub_overflow(a, b, &result);
      break;
    case Op::multiply:
      overflow = __builtin_mul_overflow(a, b, &result);
      break;
    default: {
      if (b == 0) fail(codes::divide_by_zero, "division by zero");
      // Division rounds down, and the remainder has the sign of the divisor (3.2.2).
      std::int64_t quotient = a / b;
      if (a % b != 0 && (a < 0) != (b < 0)) --quotient;
      result = op == Op::divide ? quotient : a - quotient * b;
    }
  }
  replace(2, checked_integer(result, overflow));
}

void Machine::compare(Op op, Address at) {
  top(1) = settled(top(1));
  top() = settled(top());
  const Word a = top(1);
  const Word b = top();
  if (a.is_integer() && b.is_integer() && op != Op::equal) {
    const std::int64_t x = a.as_integer();
    const std::int64_t y = b.as_integer();
    const bool holds = op == Op::less         ? x < y
                       : op == Op::less_equal ? x <= y
                       : op == Op::greater    ? x > y
                                              : x >= y;
    return replace(2, values_.make_bool(holds));
  }
  if (op == Op::equal && !(is_canonical(a) && is_canonical(b))) {
    const auto is_seq = [&](Word w) {
      return w.is_object() ? w.as_object()->kind == ObjectKind::cell
                           : w.is_value() && values_.is_seq(w.as_value());
    };
    const Word empty = Word::value(values_.empty_seq());
    if (is_seq(a) && is_seq(b)) {
      if (a == empty || b == empty) return replace(2, values_.make_bool(false));
      return call_prelude(equal_sequences_);  // element by element: either may be infinite
    }
  }
  if (!is_canonical(a)) return canon_operand(operands_.size() - 2, at);
  if (!is_canonical(b)) return canon_operand(operands_.size() - 1, at);
  if (op == Op::equal) return replace(2, values_.make_bool(a == b));
  const std::optional<Ordering> order =
      compare_inclusion(values_, resolution_, to_value(a), to_value(b));
  if (!order) {
    fail(codes::wrong_type, fmt::format("`{}` and `{}` have no order", describe(a), describe(b)));
  }
  bool holds = false;
  switch (op) {
    case Op::less:
      holds = order == Ordering::less;
      break;
    case Op::less_equal:
      holds = order == Ordering::less || order == Ordering::equal;
      break;
    case Op::greater:
      holds = order == Ordering::greater;
      break;
    default:
      holds = order == Ordering::greater || order == Ordering::equal;
  }
  replace(2, values_.make_bool(holds));
}

// Calls a function of the prelude with the two operands on top.
void Machine::call_prelude(std::uint32_t global) {
  const Object* closure = globals_[global].as_object();
  const FunctionInfo& function = program_.functions[FunctionId{closure->aux}];
  push(Word());  // the place of the callee, below the arguments
  std::rotate(operands_.end() - 3, operands_.end() - 1, operands_.end());
  enter_function(function, 0, Word(), 2);
}

// --- Data ---------------------------------------------------------------------------------------

void Machine::make_list(std::uint32_t items) {
  Word list = pop();
  for (; items > 0; --items) {
    Object* cell = heap_.allocate(ObjectKind::cell, 0, 2);
    (*cell)[0] = pop();
    (*cell)[1] = list;
    list = Word::object(cell);
  }
  push(list);
  force_top();  // of no items: the tail itself
}

void Machine::append() {
  const Word left = settled(top(1));
  if (left == Word::value(values_.empty_seq())) {
    const Word right = top();
    replace(2, right);
    return force_top();
  }
  call_prelude(append_);
}

void Machine::make_tuple(std::uint32_t items) {
  Object* tuple = heap_.allocate(ObjectKind::tuple, 0, items);
  for (std::uint32_t i = 0; i < items; ++i) (*tuple)[i] = top(items - 1 - i);
  replace(items, Word::object(tuple));
}

void Machine::make_map(std::uint32_t entries) {
  const std::vector<ValueId> flat = top_values(2 * std::size_t{entries});
  std::vector<std::pair<ValueId, ValueId>> pairs;
  for (std::size_t i = 0; i < flat.size(); i += 2) pairs.emplace_back(flat[i], flat[i + 1]);
  replace(flat.size(), semantics::make_map(values_, pairs));
}

void Machine::make_range_set(bool bounded) {
  if (!bounded) return replace(1, values_.make_from_set(integer_at(0, "a range")));
  replace(2, range_set(values_, integer_at(1, "a range"), integer_at(0, "a range")));
}

ValueId Machine::require_set(ValueId value) const {
  if (values_.is_set(value)) return value;
  fail(codes::wrong_type,
       fmt::format("a set is needed, but this is `{}`", brief(values_, resolution_, value)));
}

std::vector<ValueId> Machine::set_operands(std::uint32_t count) {
  std::vector<ValueId> sets = top_values(count);
  for (const ValueId set : sets) require_set(set);
  return sets;
}

void Machine::dot_product(std::uint32_t sets) {
  replace(sets, data_.dot_product(set_operands(sets)));
}

// All values of a datatype; if a field ranges over an infinite set, the set is known by name only.
void Machine::datatype_set(SymbolId datatype) {
  const parser::DeclId decl = resolution_.symbols[datatype].decl;
  std::vector<ValueId> all;
  for (const SymbolId constructor : resolution_.members.at(decl.value)) {
    if (fields_in_progress_.contains(constructor.value)) {
      return push(values_.make_data_set(datatype));
    }
    for (const ValueId set : data_.fields(constructor)) {
      if (!is_listed(values_, set)) return push(values_.make_data_set(datatype));
    }
  }
  for (const SymbolId constructor : resolution_.members.at(decl.value)) {
    const std::vector<ValueId> values = data_.productions(values_.make_atom(constructor));
    all.insert(all.end(), values.begin(), values.end());
  }
  push(values_.make_set(std::move(all)));
}

// --- Loops --------------------------------------------------------------------------------------

Machine::Accumulator Machine::take_accumulator() {
  Accumulator accumulator = std::move(accumulators_.back());
  accumulators_.pop_back();
  return accumulator;
}

void Machine::iter_begin(bool over_set) {
  const ValueId collection = value_at(0);
  if (over_set) {
    require_set(collection);
    if (!is_listed(values_, collection) && !lists_nothing(values_, collection)) {
      fail_unlisted(values_, collection,
                    fmt::format("go through {},", brief(values_, resolution_, collection)));
    }
  } else if (!values_.is_seq(collection)) {
    fail(codes::wrong_type, fmt::format("a sequence is needed, but this is `{}`",
                                        brief(values_, resolution_, collection)));
  }
  const ValueId listed =
      over_set && !is_listed(values_, collection) ? values_.empty_set() : collection;
  iterators_.push_back({over_set ? Iterator::Kind::set : Iterator::Kind::sequence, listed});
  pop();
}

void Machine::iter_next(Address done) {
  Iterator& iterator = iterators_.back();
  if (iterator.kind == Iterator::Kind::set) {
    const auto items = values_.items(iterator.collection);
    if (iterator.next < items.size()) return push(items[iterator.next++]);
  } else if (values_.kind(iterator.collection) == ValueKind::cons) {
    const ValueId head = values_.head(iterator.collection);
    iterator.collection = values_.tail(iterator.collection);
    return push(head);
  }
  iterators_.pop_back();
  pc_ = done;
}

void Machine::field_begin(bool last, bool has_set) {
  const ValueId partial = value_at(has_set ? 1 : 0);
  Iterator iterator{Iterator::Kind::field, partial};
  if (has_set) {
    const ValueId set = require_set(value_at(0));
    for (const ValueId component : elements_of(values_, set, "offer the inputs of")) {
      iterator.restricted.push_back({data_.append(partial, component), component});
    }
  } else {
    iterator.extensions = &data_.extensions(partial, last);
  }
  iterators_.push_back(std::move(iterator));
  operands_.resize(operands_.size() - (has_set ? 2 : 1));
}

void Machine::field_next(Address done) {
  Iterator& iterator = iterators_.back();
  const auto& extensions =
      iterator.extensions != nullptr ? *iterator.extensions : iterator.restricted;
  if (iterator.next == extensions.size()) {
    iterators_.pop_back();
    pc_ = done;
    return;
  }
  const DataModel::Extension& extension = extensions[iterator.next++];
  push(extension.value);
  push(extension.component);
}

// --- Patterns -----------------------------------------------------------------------------------

void Machine::match(Instruction in) {
  const Word word = settled(top());
  switch (in.op) {
    case Op::match_value:
      if (settled(top(1)) != word) pc_ = in.b;
      operands_.resize(operands_.size() - 2);
      return;
    case Op::match_empty_seq:
      if (word != Word::value(values_.empty_seq())) pc_ = in.b;
      pop();
      return;
    case Op::match_cons: {
      if (word.is_object() && word.as_object()->kind == ObjectKind::cell) {
        Object* cell = word.as_object();
        top() = (*cell)[1];
        push((*cell)[0]);
      } else if (word.is_value() && values_.kind(word.as_value()) == ValueKind::cons) {
        top() = Word::value(values_.tail(word.as_value()));
        push(values_.head(word.as_value()));
      } else if (word == Word::value(values_.empty_seq())) {
        pop();
        pc_ = in.b;
      } else {
        fail(codes::wrong_type,
             fmt::format("a sequence is needed, but this is `{}`", describe(word)));
      }
      return;
    }
    case Op::match_tuple: {
      const bool is_tuple = word.is_object() && word.as_object()->kind == ObjectKind::tuple;
      const bool is_value = word.is_value() && values_.kind(word.as_value()) == ValueKind::tuple;
      const std::size_t size = is_tuple   ? word.as_object()->size
                               : is_value ? values_.items(word.as_value()).size()
                                          : 0;
      if (size != in.b) {
        fail(codes::wrong_type,
             fmt::format("a tuple of {} items is needed, but this is `{}`", in.b, describe(word)));
      }
      pop();
      for (std::size_t i = size; i > 0; --i) {
        if (is_tuple) {
          push((*word.as_object())[i - 1]);
        } else {
          push(values_.items(word.as_value())[i - 1]);
        }
      }
      return;
    }
    case Op::match_empty_set:
      require_set(value_at(0));
      if (word != Word::value(values_.empty_set())) pc_ = in.b;
      pop();
      return;
    case Op::match_single_set: {
      const ValueId set = require_set(value_at(0));
      if (is_listed(values_, set) && values_.items(set).size() == 1) {
        replace(1, values_.items(set)[0]);
      } else {
        pop();
        pc_ = in.b;
      }
      return;
    }
    case Op::match_ends:
      if (!match_ends(program_.ends_patterns[in.a])) pc_ = in.b;
      return;
    default:
      if (!match_dot(program_.dot_patterns[in.a])) pc_ = in.b;
      return;
  }
}

bool Machine::match_ends(const EndsPattern& pattern) {
  ValueId seq = value_at(0);
  if (!values_.is_seq(seq)) {
    fail(codes::wrong_type, fmt::format("a sequence is needed, but this is `{}`", describe(top())));
  }
  pop();
  std::vector<ValueId> items;
  for (; values_.kind(seq) == ValueKind::cons; seq = values_.tail(seq)) {
    items.push_back(values_.head(seq));
  }
  if (items.size() < std::size_t{pattern.prefix} + pattern.suffix) return false;
  const std::size_t middle_end = items.size() - pattern.suffix;
  for (std::size_t i = items.size(); i > middle_end; --i) push(items[i - 1]);
  push(values_.make_seq(std::span(items).subspan(pattern.prefix, middle_end - pattern.prefix)));
  for (std::size_t i = pattern.prefix; i > 0; --i) push(items[i - 1]);
  return true;
}

// Dot patterns match component by component: an atom opens the application that it heads, a taken
// item is one whole component, and the last taken item is all that remains (1.9.5).
bool Machine::match_dot(const DotItems& pattern) {
  const ValueId value = value_at(0);
  pop();
  std::vector<ValueId> rest{value};  // in reverse order
  const auto open = [&](ValueId dot) {
    rest.pop_back();
    const auto items = values_.items(dot);
    rest.insert(rest.end(), items.rbegin(), items.rend());
  };
  if (values_.kind(value) == ValueKind::dot) open(value);
  std::vector<ValueId> taken;
  for (std::size_t i = 0; i < pattern.items.size(); ++i) {
    if (rest.empty()) return false;
    if (pattern.items[i]) {
      if (values_.kind(rest.back()) == ValueKind::dot) open(rest.back());
      if (rest.back() != values_.make_atom(pattern.items[i])) return false;
      rest.pop_back();
    } else if (i + 1 < pattern.items.size()) {
      taken.push_back(rest.back());
      rest.pop_back();
    } else {
      std::reverse(rest.begin(), rest.end());
      taken.push_back(rest.size() == 1 ? rest[0] : values_.make_dot(rest));
      rest.clear();
    }
  }
  if (!rest.empty()) return false;
  for (auto item = taken.rbegin(); item != taken.rend(); ++item) push(*item);
  return true;
}

void Machine::fail_no_match(FunctionId id) {
  const FunctionInfo& function = program_.functions[id];
  std::string arguments;
  Object* frame = frame_.as_object();
  for (std::uint32_t i = 0; i < function.group_sizes.back(); ++i) {
    const Word word = settled((*frame)[frame_slots + i]);
    arguments += (i > 0 ? ", " : "") + (word.is_nothing() ? "_" : describe(word));
  }
  if (!function.symbol) {
    fail(codes::no_clause_matches,
         fmt::format("the arguments ({}) do not match the lambda's patterns", arguments));
  }
  fail(codes::no_clause_matches,
       fmt::format("no clause of `{0}` matches `{0}({1})`",
                   resolution_.symbols[function.symbol].qualified, arguments));
}

void Machine::external_choice(std::uint32_t operand_count) {
  std::vector<ProcId> operands;
  operands.reserve(operand_count);
  for (std::size_t i = operand_count; i-- > 0;) operands.push_back(process_at(i));
  replace(operand_count, builder_.external_choice(operands));
}

void Machine::delayed_prefix() {
  const EventId event = builder_.event(value_at(3));
  const EventId tock = builder_.event(value_at(2));
  const std::int64_t delay = integer_at(1, "the time of an event");
  if (delay < 0) {
    fail(codes::bad_time, fmt::format("the time that `{}` takes is {}, but must not be negative",
                                      show_value(show_context(), value_at(3)), delay));
  }
  ProcId process = process_at(0);
  for (std::int64_t i = 0; i < delay; ++i) process = processes_.prefix(tock, process);
  replace(4, processes_.prefix(event, process));
}

// The timed STOP adds nothing to a choice that time does not resolve.
void Machine::timed_choice() {
  const ProcId stop = process_at(0);
  const ProcId left = process_at(3);
  const ProcId right = process_at(2);
  if (left == stop || right == stop) {
    replace(4, left == stop ? right : left);
  } else {
    replace(4, builder_.with_alphabet(ProcKind::sync_choice, left, value_at(1), right));
  }
}

void Machine::fail_unsupported(SymbolId id) {
  const Symbol& symbol = resolution_.symbols[id];
  fail(codes::not_supported, fmt::format("`{}` cannot be used: {} are not supported yet",
                                         symbol.qualified, symbol.unsupported_construct));
}

// --- Processes ----------------------------------------------------------------------------------

void Machine::process_instruction(Instruction in) {
  switch (in.op) {
    case Op::check_event:
      builder_.event(value_at(0));
      break;
    case Op::check_process:
      process_at(0);
      break;
    case Op::prefix:
      replace(2, processes_.prefix(builder_.event(value_at(1)), process_at(0)));
      break;
    case Op::delayed_prefix:
      delayed_prefix();
      break;
    case Op::timed_choice:
      timed_choice();
      break;
    case Op::event_set_prefix:
      replace(2, builder_.event_set_prefix(value_at(1), process_at(0)));
      break;
    case Op::process_binary:
      replace(2, builder_.binary(static_cast<ProcKind>(in.b), process_at(1), process_at(0)));
      break;
    case Op::external_choice:
      external_choice(in.b);
      break;
    case Op::process_ternary:
      replace(3, builder_.with_alphabet(static_cast<ProcKind>(in.b), process_at(2), value_at(1),
                                        process_at(0)));
      break;
    case Op::alphabet_parallel:
      replace(4,
              builder_.alphabet_parallel(process_at(3), value_at(2), value_at(1), process_at(0)));
      break;
    case Op::hide:
      replace(2, builder_.hide(static_cast<ProcKind>(in.b), process_at(1), value_at(0)));
      break;
    case Op::acc_add_alphabet: {
      const EventSetId alphabet = builder_.event_set(value_at(1));
      accumulators_.back().push_back(alphabet.value);
      accumulators_.back().push_back(process_at(0).value);
      operands_.resize(operands_.size() - 2);
      break;
    }
    case Op::acc_process:
      replicated(static_cast<ProcKind>(in.b), in.a != 0);
      break;
    case Op::acc_add_tie:
      accumulators_.back().push_back(value_at(1).bits);
      accumulators_.back().push_back(value_at(0).bits);
      operands_.resize(operands_.size() - 2);
      break;
    case Op::rename: {
      const ProcId renamed = builder_.rename(process_at(0), accumulated_ties());
      accumulators_.pop_back();
      replace(1, renamed);
      break;
    }
    case Op::link_parallel: {
      const ProcId linked =
          builder_.link_parallel(process_at(1), accumulated_ties(), process_at(0));
      accumulators_.pop_back();
      replace(2, linked);
      break;
    }
    case Op::acc_add_link: {
      const ProcId operand = process_at(0);
      const Accumulator ties = take_accumulator();
      Accumulator& links = accumulators_.back();
      links.push_back(static_cast<std::uint32_t>(ties.size()));
      links.insert(links.end(), ties.begin(), ties.end());
      links.push_back(operand.value);
      pop();
      break;
    }
    case Op::acc_link:
      replicated_link();
      break;
    default:
      PERENTIE_CHECK(false, "an instruction without meaning");
  }
}

std::vector<Tie> Machine::accumulated_ties() {
  const Accumulator& words = accumulators_.back();
  std::vector<Tie> ties;
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
    ties.emplace_back(ValueId{words[i]}, ValueId{words[i + 1]});
  }
  return ties;
}

void Machine::replicated(ProcKind kind, bool is_choice_of_fields) {
  const Accumulator& words = accumulators_.back();
  if (kind == ProcKind::alphabet_parallel) {
    push(processes_.alphabet_parallel(words));
    accumulators_.pop_back();
    return;
  }
  std::vector<ProcId> operands;
  for (const std::uint32_t bits : words) operands.push_back(values_.as_process(ValueId{bits}));
  const bool has_alphabet = kind == ProcKind::parallel || kind == ProcKind::sync_choice;
  const ValueId alphabet = has_alphabet ? value_at(0) : values_.empty_set();
  const ProcId process = builder_.replicated(kind, operands, alphabet, is_choice_of_fields);
  accumulators_.pop_back();
  replace(has_alphabet ? 1 : 0, process);
}

void Machine::replicated_link() {
  const Accumulator& words = accumulators_.back();
  std::vector<std::pair<std::vector<Tie>, ProcId>> operands;
  for (std::size_t i = 0; i < words.size();) {
    const std::size_t end = i + 1 + words[i];
    std::vector<Tie> ties;
    for (++i; i < end; i += 2) ties.emplace_back(ValueId{words[i]}, ValueId{words[i + 1]});
    operands.emplace_back(std::move(ties), ProcId{words[i++]});
  }
  const ProcId process = builder_.replicated_link(operands);
  accumulators_.pop_back();
  push(process);
}

}  // namespace perentie::semantics

// Frames, functions and calls. A call of a process-valued function is not evaluated: it becomes a
// named term, whose body is evaluated when it is unfolded.
#include <algorithm>

#include <fmt/format.h>

#include "machine.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

// --- Frames and canonical scopes ----------------------------------------------------------------

Object* Machine::new_frame(ScopeId scope, Word parent) {
  const ScopeInfo& info = program_.scopes[scope];
  Object* frame = heap_.allocate(ObjectKind::frame, scope.value, frame_slots + info.slot_count);
  (*frame)[frame_parent] = parent;
  for (const LetMember& member : info.members) {
    Object* object = heap_.allocate(member.is_function ? ObjectKind::closure : ObjectKind::thunk,
                                    member.target, member.is_function ? 2 : 1);
    (*object)[0] = Word::object(frame);
    if (member.is_function) (*object)[1] = Word::integer(0);
    (*frame)[frame_slots + member.slot] = Word::object(object);
  }
  return frame;
}

Object* Machine::frame_up(std::uint32_t hops) const {
  Object* frame = frame_.as_object();
  for (; hops > 0; --hops) frame = (*frame)[frame_parent].as_object();
  return frame;
}

std::optional<std::uint32_t> Machine::canonical_scope(Word frame) {
  if (frame.is_nothing()) return 0;
  const Word canonical = (*frame.as_object())[frame_canonical];
  if (canonical.is_nothing()) return std::nullopt;
  return static_cast<std::uint32_t>(canonical.as_integer());
}

void Machine::finish_scope(Object* frame, std::span<const ValueId> identity) {
  std::vector<std::uint32_t> words{frame->aux, *canonical_scope((*frame)[frame_parent])};
  for (const ValueId value : identity) words.push_back(value.bits);
  const std::uint32_t scope = scopes_.intern(0, words);
  (*frame)[frame_canonical] = Word::integer(scope);
  if (scope >= instances_.size()) instances_.resize(scope + 1);
  if (instances_[scope].is_nothing()) instances_[scope] = Word::object(frame);
}

Word Machine::instantiate(std::uint32_t scope) {
  // Every canonical scope was identified from a frame, which stays its instance.
  PERENTIE_CHECK(scope < instances_.size(), "a canonical scope without an instance");
  return instances_[scope];
}

// --- Calls --------------------------------------------------------------------------------------

void Machine::fail_argument_count(std::size_t wanted, std::size_t given) {
  fail(codes::wrong_type, fmt::format("the function takes {} argument{}, but is given {}", wanted,
                                      wanted == 1 ? "" : "s", given));
}

void Machine::call(std::uint32_t argument_count, Address at) {
  const Word callee = settled(top(argument_count));
  std::uint32_t function_index = 0;
  std::uint32_t group = 0;
  Word scope_frame;
  if (callee.is_object() && callee.as_object()->kind == ObjectKind::closure) {
    Object* closure = callee.as_object();
    function_index = closure->aux;
    scope_frame = (*closure)[0];
    group = static_cast<std::uint32_t>((*closure)[1].as_integer());
  } else if (callee.is_value() && values_.kind(callee.as_value()) == ValueKind::function) {
    function_index = values_.word(callee.as_value(), 0);
    group = values_.word(callee.as_value(), 1);
    scope_frame = instantiate(values_.word(callee.as_value(), 2));
  } else if (callee.is_value() && values_.kind(callee.as_value()) == ValueKind::builtin) {
    return call_builtin(values_.as_builtin(callee.as_value()), argument_count, at);
  } else {
    fail(codes::wrong_type,
         fmt::format("a function is needed, but this is `{}`", describe(callee)));
  }
  const FunctionInfo& function = program_.functions[FunctionId{function_index}];
  if (function.group_sizes[group] != argument_count) {
    fail_argument_count(function.group_sizes[group], argument_count);
  }
  if (group + 1 < function.group_sizes.size()) {
    Object* frame = new_frame(function.group_scopes[group], scope_frame);
    for (std::uint32_t i = 0; i < argument_count; ++i) {
      (*frame)[frame_slots + i] = top(argument_count - 1 - i);
    }
    Object* partial = heap_.allocate(ObjectKind::closure, function_index, 2);
    (*partial)[0] = Word::object(frame);
    (*partial)[1] = Word::integer(group + 1);
    replace(argument_count + 1, Word::object(partial));
  } else if (function.is_process) {
    name_process(FunctionId{function_index}, group, scope_frame, argument_count, at);
  } else {
    enter_function(function, group, scope_frame, argument_count);
  }
}

void Machine::enter_function(const FunctionInfo& function, std::uint32_t group, Word parent,
                             std::uint32_t argument_count) {
  Object* frame = new_frame(function.group_scopes[group], parent);
  for (std::uint32_t i = 0; i < argument_count; ++i) {
    (*frame)[frame_slots + i] = top(argument_count - 1 - i);
  }
  operands_.resize(operands_.size() - argument_count - 1);
  const bool is_tail_call = program_.code[pc_].op == Op::ret;
  if (!is_tail_call) control_.push_back({ControlKind::resume, pc_, 0, frame_});
  frame_ = Word::object(frame);
  pc_ = function.entry;
}

void Machine::name_process(FunctionId id, std::uint32_t group, Word scope_frame,
                           std::uint32_t argument_count, Address at) {
  const FunctionInfo& function = program_.functions[id];
  for (std::uint32_t i = 0; i < argument_count; ++i) {
    const std::size_t index = operands_.size() - argument_count + i;
    if (!function.ignored[i] && !is_canonical(operands_[index])) return canon_operand(index, at);
  }
  const auto scope = canonical_scope(scope_frame);
  if (!scope) {
    control_.push_back({ControlKind::retry, at, 0, frame_});
    if (identify_scope(scope_frame)) return_value();
    return;
  }
  std::vector<ValueId> arguments;
  for (std::uint32_t i = 0; i < argument_count; ++i) {
    arguments.push_back(function.ignored[i] ? values_.ignored() : value_at(argument_count - 1 - i));
  }
  const ValueId name = values_.make_function(id.value, group, *scope);
  const ProcId term = processes_.call(name, arguments);
  const bool is_of_prelude = function.entry < program_.prelude_end;
  replace(argument_count + 1, is_of_prelude ? remember_origin(term) : term);
}

void Machine::process_constant(std::uint32_t hops, FunctionId function, Address at) {
  const Word frame = hops == no_frame ? Word() : Word::object(frame_up(hops));
  const auto scope = canonical_scope(frame);
  if (!scope) {
    control_.push_back({ControlKind::retry, at, 0, frame_});
    if (identify_scope(frame)) return_value();
    return;
  }
  push(processes_.call(values_.make_function(function.value, 0, *scope), {}));
}

// --- Built-ins ----------------------------------------------------------------------------------

// A built-in that is called as a value: its arguments may not be evaluated yet.
void Machine::call_builtin(Builtin builtin, std::uint32_t argument_count, Address at) {
  const std::string_view modes = info(builtin).arguments;
  if (modes.size() != argument_count) fail_argument_count(modes.size(), argument_count);
  for (std::uint32_t i = 0; i < argument_count; ++i) {
    const std::size_t index = operands_.size() - argument_count + i;
    if (!is_canonical(operands_[index])) return canon_operand(index, at);
  }
  apply_builtin(builtin, argument_count + 1, argument_count);
}

// With the evaluated arguments on the stack, and perhaps the built-in itself below them.
void Machine::apply_builtin(Builtin builtin, std::uint32_t operand_count,
                            std::uint32_t argument_count) {
  switch (builtin) {
    case Builtin::seq_null:
    case Builtin::seq_head:
    case Builtin::seq_tail:
      return sequence_builtin(builtin, operand_count);
    case Builtin::stop:
      return replace(operand_count, processes_.stop());
    case Builtin::skip:
      return replace(operand_count, processes_.skip());
    case Builtin::div:
      return replace(operand_count, processes_.div());
    case Builtin::chaos:
      return replace(operand_count, processes_.chaos(builder_.event_set(value_at(0))));
    case Builtin::run:
      return replace(operand_count, processes_.run(builder_.event_set(value_at(0))));
    case Builtin::prioritise:
    case Builtin::prioritise_nocache:
      return replace(operand_count, builder_.prioritise(process_at(1), value_at(0)));
    case Builtin::prioritisepo:
      return replace(operand_count, builder_.prioritise_partial(process_at(3), value_at(2),
                                                                value_at(1), value_at(0)));
    case Builtin::chase:
    case Builtin::chase_nocache:
      return replace(operand_count, remember_origin(processes_.chase(process_at(0))));
    case Builtin::trace_watchdog:
    case Builtin::failure_watchdog:
      return replace(operand_count, remember_origin(processes_.watchdog(
                                        builtin, process_at(2), builder_.event_set(value_at(1)),
                                        builder_.event(value_at(0)))));
    case Builtin::deter:
      return replace(operand_count, remember_origin(processes_.unary(
                                        ProcKind::graph_operator,
                                        static_cast<std::uint32_t>(builtin), process_at(0))));
    default:
      break;
  }
  if (info(builtin).kind == BuiltinKind::opaque) {
    const std::vector<ValueId> arguments = top_values(argument_count);
    if (builtin == Builtin::weak_buffer || builtin == Builtin::signal_buffer) {
      builder_.check_buffer(arguments);
    }
    return replace(operand_count, remember_origin(processes_.opaque(builtin, arguments)));
  }
  if (info(builtin).kind == BuiltinKind::process_function) {  // the compressions
    return replace(operand_count,
                   processes_.unary(ProcKind::compression, static_cast<std::uint32_t>(builtin),
                                    process_at(0)));
  }
  replace(operand_count, builtins_.apply(builtin, top_values(argument_count)));
}

// head, tail and null look at the first cell only.
void Machine::sequence_builtin(Builtin builtin, std::uint32_t operand_count) {
  const Word seq = settled(top());
  const bool is_cell = seq.is_object() && seq.as_object()->kind == ObjectKind::cell;
  if (!is_cell && !(seq.is_value() && values_.is_seq(seq.as_value()))) {
    fail(codes::wrong_type,
         fmt::format("`{}` needs a sequence, but this is `{}`", info(builtin).name, describe(seq)));
  }
  const bool is_empty = seq == Word::value(values_.empty_seq());
  if (builtin == Builtin::seq_null) return replace(operand_count, values_.make_bool(is_empty));
  if (is_empty) {
    fail(codes::empty_sequence, fmt::format("`{}` of the empty sequence", info(builtin).name));
  }
  const bool head = builtin == Builtin::seq_head;
  Word part;
  if (is_cell) {
    part = (*seq.as_object())[head ? 0 : 1];
  } else {
    part = to_word(head ? values_.head(seq.as_value()) : values_.tail(seq.as_value()));
  }
  replace(operand_count, part);
  force_top();
}

// Evaluates the value on top to weak head normal form before the next instruction.
void Machine::force_top() {
  top() = settled(top());
  if (is_whnf(top())) return;
  Object* thunk = pop().as_object();
  control_.push_back({ControlKind::resume, pc_, 0, frame_});
  enter_thunk(thunk);
}

}  // namespace perentie::semantics

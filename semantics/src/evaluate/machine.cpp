// The machine's loop: running blocks, returning values, limits and failures.
#include "machine.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "brief.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"
#include "sets.hpp"

namespace perentie::semantics {
namespace {

// Instructions between two looks at the clock, the memory and the depth.
constexpr std::uint32_t fuel_per_check = 4096;
// Entries of the control stack; a call that is not a tail call takes two.
constexpr std::size_t max_control = 20'000'000;

}  // namespace

Machine::Machine(const Program& program, const Resolution& resolution, std::uint32_t append,
                 std::uint32_t equal_sequences, ValueStore& values, EventTable& events,
                 ProcStore& processes)
    : program_(program),
      resolution_(resolution),
      append_(append),
      equal_sequences_(equal_sequences),
      values_(values),
      events_(events),
      processes_(processes),
      data_(values, resolution, program),
      builder_(values, events, processes, resolution, data_),
      builtins_{values, resolution, data_, show_context()} {
  // The scope of all globals is canonical scope 0.
  scopes_.intern(0, {});
  instances_.emplace_back();
  values_.set_checkpoint([this] { checkpoint(); });
}

void Machine::extend_globals() {
  for (std::size_t slot = globals_.size(); slot < program_.globals.size(); ++slot) {
    const GlobalInit& init = program_.globals[slot];
    const bool is_function = init.kind == GlobalInit::Kind::function;
    Object* object = heap_.allocate(is_function ? ObjectKind::closure : ObjectKind::thunk,
                                    init.target, is_function ? 2 : 1);
    if (is_function) (*object)[1] = Word::integer(0);
    globals_.push_back(Word::object(object));
  }
}

std::optional<ValueId> Machine::run(Address entry, base::Diagnostics& diagnostics) {
  unfolding_origin_.reset();
  return run_in(entry, Word(), diagnostics);
}

std::optional<ValueId> Machine::run_in(Address entry, Word frame, base::Diagnostics& diagnostics) {
  diagnostics_ = &diagnostics;
  limit_.reset();
  budget_.emplace(limits_);
  pc_ = entry;
  frame_ = frame;
  control_.push_back({ControlKind::halt});
  if (!execute()) return std::nullopt;
  return to_value(pop());
}

bool Machine::number_events(std::size_t max) {
  base::Diagnostics unheard;  // whoever uses the channel hears it
  for (const SymbolId channel : resolution_.channels) {
    for (;;) {
      try {
        const auto events = events_of(channel, max);
        if (!events || events->size() > max) return false;
        for (const ValueId event : *events) events_.intern(event);
        max -= events->size();
        break;
      } catch (const NeedFields& need) {
        if (!compute_fields(need.symbol, unheard)) return false;
      } catch (const EvaluationFailure&) {
        return false;
      }
    }
  }
  return true;
}

// Nothing: there are more, or no end of them.
std::optional<std::vector<ValueId>> Machine::events_of(SymbolId channel, std::size_t max) {
  std::size_t count = 1;
  if (data_.has_data(channel)) {
    for (const ValueId field : data_.fields(channel)) {
      if (!is_listed(values_, field)) return std::nullopt;
      count *= cardinality(values_, field);
      if (count > max) return std::nullopt;
    }
  }
  if (count > max) return std::nullopt;
  return data_.productions(values_.make_atom(channel));
}

bool Machine::compute_fields(SymbolId symbol, base::Diagnostics& diagnostics) {
  diagnostics_ = &diagnostics;
  limit_.reset();
  budget_.emplace(limits_);
  unfolding_origin_.reset();
  fields_in_progress_.insert(symbol.value);
  control_.push_back({ControlKind::halt});
  control_.push_back({ControlKind::fields, symbol.value});
  pc_ = program_.field_types.at(symbol.value);
  frame_ = Word();
  if (!execute()) return false;
  pop();
  return true;
}

std::optional<ProcId> Machine::unfold(ProcId call, base::Diagnostics& diagnostics) {
  if (const auto known = unfolded_.find(call.value); known != unfolded_.end()) return known->second;
  const auto words = processes_.words(call);
  const ValueId function{words[0]};
  const FunctionInfo& info = program_.functions[FunctionId{values_.word(function, 0)}];
  Word frame = instantiate(values_.word(function, 2));
  if (!info.group_sizes.empty()) {
    Object* arguments = new_frame(info.group_scopes.back(), frame);
    for (std::size_t i = 1; i < words.size(); ++i) {
      (*arguments)[frame_slots + i - 1] = to_word(ValueId{words[i]});
    }
    frame = Word::object(arguments);
  }
  unfolding_origin_ = origin(call);
  const std::optional<ValueId> body = run_in(info.entry, frame, diagnostics);
  if (!body) return std::nullopt;
  return unfolded_[call.value] = values_.as_process(*body);
}

std::size_t Machine::memory_bytes() const {
  return heap_.bytes() + values_.memory_bytes() + events_.memory_bytes() +
         processes_.memory_bytes() + scopes_.memory_bytes() +
         control_.capacity() * sizeof(Control) + operands_.capacity() * sizeof(Word) +
         unfolded_.size() * 4 * sizeof(void*);
}

// --- The loop -----------------------------------------------------------------------------------

bool Machine::execute() {
  running_ = true;
  while (running_) {
    try {
      run_instructions();
    } catch (const NeedFields& need) {
      if (!need_fields(need.symbol, pc_ - 1)) {
        unwind();
        return false;
      }
    } catch (const EvaluationFailure& failure) {
      report(failure);
      unwind();
      return false;
    } catch (const EvaluationLimit& reached) {
      limit_ = reached.reached;
      unwind();
      return false;
    }
  }
  return true;
}

void Machine::check_depth_and_time() {
  if (control_.size() > max_control) {
    throw EvaluationLimit{{base::LimitKind::depth, max_control / 2}};
  }
  if (const auto reached = budget_->check_time()) throw EvaluationLimit{*reached};
}

// For built-ins that work long without running instructions.
void Machine::checkpoint() const {
  if (!running_) return;
  if (const auto reached = budget_->check_time()) throw EvaluationLimit{*reached};
  if (const auto reached = budget_->check_memory(memory_bytes())) throw EvaluationLimit{*reached};
}

void Machine::safepoint() {
  fuel_ = fuel_per_check;
  check_depth_and_time();
  if (!heap_.wants_collection()) return;
  if (const auto reached = budget_->check_memory(memory_bytes())) throw EvaluationLimit{*reached};
  heap_.collect([this](auto move) {
    for (Word& word : operands_) move(word);
    for (Control& entry : control_) {
      move(entry.w);
      move(entry.v);
    }
    for (Word& word : globals_) move(word);
    for (Word& word : instances_) move(word);
    move(frame_);
  });
}

// The block's value is on top: hand it to whoever waits for it.
void Machine::return_value() {
  for (;;) {
    // A value can be larger than what it took to make it: (x, x) of (y, y) of ..
    if (++returns_ % fuel_per_check == 0) check_depth_and_time();
    const Control entry = control_.back();
    control_.pop_back();
    switch (entry.kind) {
      case ControlKind::halt:
        running_ = false;
        return;
      case ControlKind::resume:
        pc_ = entry.a;
        frame_ = entry.w;
        return;
      case ControlKind::retry:
        pop();
        pc_ = entry.a;
        frame_ = entry.w;
        return;
      case ControlKind::update: {
        Object* thunk = entry.w.as_object();
        thunk->kind = ObjectKind::indirection;
        (*thunk)[0] = top();
        break;
      }
      case ControlKind::canon:
        if (!canonicalise_top()) return;
        break;
      case ControlKind::canon_operand: {
        const Word value = pop();
        operands_[entry.a] = value;
        pc_ = entry.b;
        frame_ = entry.w;
        return;
      }
      case ControlKind::canon_cells:
        if (!canonicalise_tail(entry.a, (*entry.w.as_object())[1])) return;
        break;
      case ControlKind::canon_tail:
        if (!canonicalise_tail(entry.a, pop())) return;
        break;
      case ControlKind::canon_tuple:
        if (!canonicalise_tuple(entry.a, entry.w)) return;
        break;
      case ControlKind::canon_closure: {
        pop();
        Object* closure = entry.w.as_object();
        const auto scope = canonical_scope((*closure)[0]);
        const auto group = static_cast<std::uint32_t>((*closure)[1].as_integer());
        push(values_.make_function(closure->aux, group, *scope));
        break;
      }
      case ControlKind::canon_slot:
        if (!identify_slot(entry.a, entry.w, entry.v)) return;
        break;
      case ControlKind::fields: {
        const ValueId tuple = to_value(top());
        const auto sets = values_.items(tuple);
        data_.set_fields(SymbolId{entry.a}, {sets.begin(), sets.end()});
        fields_in_progress_.erase(entry.a);
        break;
      }
    }
  }
}

// The fields of a channel or constructor, then the instruction again.
bool Machine::need_fields(SymbolId symbol, Address retry_at) {
  if (!fields_in_progress_.insert(symbol.value).second) {
    report({&codes::depends_on_itself, fmt::format("the fields of `{}` depend on themselves",
                                                   resolution_.symbols[symbol].qualified)});
    return false;
  }
  control_.push_back({ControlKind::retry, retry_at, 0, frame_});
  control_.push_back({ControlKind::fields, symbol.value});
  pc_ = program_.field_types.at(symbol.value);
  frame_ = Word();
  return true;
}

// --- Failures -----------------------------------------------------------------------------------

// After a failure: thunks under evaluation become thunks again, so that they can be tried anew.
void Machine::unwind() {
  for (const Control& entry : control_) {
    if (entry.kind == ControlKind::update) entry.w.as_object()->kind = ObjectKind::thunk;
  }
  control_.clear();
  operands_.clear();
  accumulators_.clear();
  iterators_.clear();
  fields_in_progress_.clear();
  running_ = false;
}

// The place of the failing instruction, or of the call that led into the prelude.
base::Span Machine::failure_span() const {
  if (pc_ - 1 >= program_.prelude_end) return program_.spans[pc_ - 1];
  for (auto entry = control_.rbegin(); entry != control_.rend(); ++entry) {
    const bool is_return = entry->kind == ControlKind::resume || entry->kind == ControlKind::retry;
    if (is_return && entry->a > program_.prelude_end) return program_.spans[entry->a - 1];
  }
  return unfolding_origin_.value_or(program_.spans[pc_ - 1]);
}

// Terms that fail later, in the step rules or in the prelude, are traced back to the script.
ProcId Machine::remember_origin(ProcId term) {
  origins_.try_emplace(term.value, failure_span());
  return term;
}

std::optional<base::Span> Machine::origin(ProcId term) const {
  const auto found = origins_.find(term.value);
  return found == origins_.end() ? std::nullopt : std::optional(found->second);
}

void Machine::report(const EvaluationFailure& failure) {
  auto& report = diagnostics_->report(*failure.code, failure_span(), failure.message);
  if (shows_calls_) report.notes = call_stack();
}

// --- Operands -----------------------------------------------------------------------------------

Word Machine::to_word(ValueId value) const {
  return values_.kind(value) == ValueKind::integer ? Word::integer(values_.as_int(value))
                                                   : Word::value(value);
}

ValueId Machine::to_value(Word word) {
  PERENTIE_CHECK(is_canonical(word), "a value was expected, but it is not evaluated");
  return word.is_integer() ? values_.make_int(word.as_integer()) : word.as_value();
}

std::vector<ValueId> Machine::top_values(std::size_t count) {
  std::vector<ValueId> values;
  for (std::size_t i = count; i > 0; --i) values.push_back(to_value(top(i - 1)));
  return values;
}

Word Machine::settled(Word word) {
  while (word.is_object() && word.as_object()->kind == ObjectKind::indirection) {
    word = (*word.as_object())[0];
  }
  return word;
}

std::int64_t Machine::integer_at(std::size_t below, std::string_view operation) {
  if (top(below).is_integer()) return top(below).as_integer();
  fail(codes::wrong_type,
       fmt::format("{} needs a number, but this is `{}`", operation, describe(top(below))));
}

bool Machine::boolean_at(std::size_t below) {
  const Word word = top(below);
  if (word.is_value() && values_.kind(word.as_value()) == ValueKind::boolean) {
    return values_.as_bool(word.as_value());
  }
  fail(codes::wrong_type, fmt::format("a condition is needed, but this is `{}`", describe(word)));
}

ProcId Machine::process_at(std::size_t below) {
  const Word word = top(below);
  if (word.is_value() && values_.kind(word.as_value()) == ValueKind::process) {
    return values_.as_process(word.as_value());
  }
  fail(codes::wrong_type, fmt::format("a process is needed, but this is `{}`", describe(word)));
}

}  // namespace perentie::semantics

// The calls that are being evaluated, for messages about what goes wrong in them (CSPM
// reference 3.9).
//
// The machine's control stack says where evaluation goes on, and in which frame; the frame's scope
// says which function it belongs to, and its first slots are the arguments. Calls in tail position
// have left no trace: the function that was called last stands for them.
#include <algorithm>

#include <fmt/format.h>

#include "brief.hpp"
#include "machine.hpp"

namespace perentie::semantics {
namespace {

// Longer stacks lose their middle.
constexpr std::size_t max_shown = 20;
constexpr std::size_t max_items = 8;

}  // namespace

// What is known of something that need not be evaluated: `<1, 2, …>`.
std::string Machine::describe(Word word) {
  word = settled(word);
  if (word.is_nothing()) return "_";
  if (is_canonical(word)) return brief(values_, resolution_, to_value(word));
  const auto item = [&](Word part) {
    part = settled(part);
    return is_canonical(part) ? brief(values_, resolution_, to_value(part)) : std::string("…");
  };
  std::string text;
  switch (word.as_object()->kind) {
    case ObjectKind::cell:
      for (std::size_t i = 0; word.is_object() && i < max_items; ++i) {
        Object* cell = word.as_object();
        if (cell->kind != ObjectKind::cell) break;
        text += (i > 0 ? ", " : "") + item((*cell)[0]);
        word = settled((*cell)[1]);
      }
      return fmt::format("<{}{}>", text, word == Word::value(values_.empty_seq()) ? "" : ", …");
    case ObjectKind::tuple:
      for (std::uint32_t i = 0; i < word.as_object()->aux; ++i) {
        text += (i > 0 ? ", " : "") + item((*word.as_object())[i]);
      }
      return fmt::format("({})", text);
    case ObjectKind::closure:
      return "a function";
    default:
      return "…";
  }
}

// The call that a frame belongs to, such as `f(1)(2)`; empty outside functions.
std::string Machine::call_around(Word frame) {
  std::string arguments;
  for (; frame.is_object(); frame = (*frame.as_object())[frame_parent]) {
    Object* object = frame.as_object();
    const ScopeInfo& scope = program_.scopes[ScopeId{object->aux}];
    if (scope.kind != ScopeKind::arguments) continue;
    const FunctionInfo& function = program_.functions[scope.function];
    const auto group =
        static_cast<std::size_t>(std::ranges::find(function.group_scopes, ScopeId{object->aux}) -
                                 function.group_scopes.begin());
    std::string own;
    for (std::uint32_t i = 0; i < function.group_sizes[group]; ++i) {
      own += (i > 0 ? ", " : "") + describe((*object)[frame_slots + i]);
    }
    arguments = fmt::format("({}){}", own, arguments);
    if (group > 0) continue;
    return (function.symbol ? resolution_.symbols[function.symbol].qualified
                            : fmt::format("(\\{} @ …)", function.parameters)) +
           arguments;
  }
  return {};
}

// The innermost call first.
std::vector<base::Note> Machine::call_stack() {
  std::vector<base::Note> notes;
  Word at = frame_;
  for (auto entry = control_.rbegin(); entry != control_.rend(); ++entry) {
    Address address = 0;
    if (entry->kind == ControlKind::resume) {
      address = entry->a - 1;
    } else if (entry->kind == ControlKind::retry) {
      address = entry->a;
    } else if (entry->kind == ControlKind::canon_operand) {
      address = entry->b;
    } else {
      continue;
    }
    if (entry->w == at) continue;
    const std::string call = call_around(at);
    at = entry->w;
    if (call.empty() || address < program_.prelude_end) continue;
    notes.push_back({program_.spans[address], fmt::format("in `{}`, which is needed here", call)});
  }
  if (const std::string call = call_around(at); !call.empty()) {
    notes.push_back({std::nullopt, fmt::format("in `{}`", call)});
  }
  if (notes.size() > max_shown) {
    const auto middle = notes.begin() + max_shown / 2;
    const std::size_t left_out = notes.size() - max_shown;
    *middle = {std::nullopt, fmt::format("(and {} more)", left_out + 1)};
    notes.erase(middle + 1, middle + 1 + static_cast<std::ptrdiff_t>(left_out));
  }
  return notes;
}

}  // namespace perentie::semantics

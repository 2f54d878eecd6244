// The names of process terms, as FDR prints them (CSPM reference 3.8.2).
//
// A name is the path to a definition: the definitions around it with their arguments, `ANNON(..)`
// for the variables of fields and generators in between, `(\x @ …)` for lambdas. Arguments come
// from the frames that the definition captured, everything else from where it stands in the text.
#include <fmt/format.h>

#include "machine.hpp"
#include "perentie/semantics/show.hpp"

namespace perentie::semantics {

// The arguments that a frame holds, as `1, 2`.
std::string Machine::frame_values(std::uint32_t scope) const {
  std::string text;
  for (const std::uint32_t word : scopes_.words(scope).subspan(2)) {
    text += (text.empty() ? "" : ", ") + show_value(show_context(), ValueId{word});
  }
  return text;
}

SymbolId Machine::definition_around(SymbolId definition) const {
  const auto found = program_.owners.find(definition.value);
  return found == program_.owners.end() ? SymbolId{} : found->second;
}

std::string Machine::scope_prefix(std::uint32_t scope, SymbolId innermost) const {
  std::string prefix;
  SymbolId around = innermost;
  // Constants have no frame: they are between the definitions that have one.
  const auto pass_constants = [&](SymbolId up_to) {
    for (; around && around != up_to; around = definition_around(around)) {
      if (resolution_.symbols[around].kind == SymbolKind::constant) {
        prefix = resolution_.symbols[around].qualified + "::" + prefix;
      }
    }
  };
  const auto info_of = [&](std::uint32_t s) -> const ScopeInfo& {
    return program_.scopes[ScopeId{scopes_.words(s)[0]}];
  };
  while (scope != 0) {
    const ScopeInfo& info = info_of(scope);
    std::string values = frame_values(scope);
    scope = scopes_.words(scope)[1];
    const bool binds_nothing = info.kind == ScopeKind::binding && info.identity.empty();
    if (info.kind == ScopeKind::let || binds_nothing) continue;
    const SymbolId function = info.function ? program_.functions[info.function].symbol : SymbolId{};
    if (!function) {
      pass_constants(info.owner);
      prefix = (info.function ? fmt::format("(\\{} @ …)::", values)
                              : fmt::format("ANNON({})::", values)) +
               prefix;
      continue;
    }
    pass_constants(function);
    // The argument groups of one call follow each other.
    while (scope != 0 && info_of(scope).function == info.function) {
      values = fmt::format("{})({}", frame_values(scope), values);
      scope = scopes_.words(scope)[1];
    }
    prefix = fmt::format("{}({})::", resolution_.symbols[function].qualified, values) + prefix;
    around = definition_around(function);
  }
  pass_constants({});
  return prefix;
}

std::string Machine::function_name(ValueId function) const {
  const FunctionInfo& info = program_.functions[FunctionId{values_.word(function, 0)}];
  std::uint32_t scope = values_.word(function, 2);
  std::string applied;  // the argument groups that it has already
  for (std::uint32_t group = values_.word(function, 1); group > 0; --group) {
    applied = fmt::format("({}){}", frame_values(scope), applied);
    scope = scopes_.words(scope)[1];
  }
  if (info.is_timed_prefix) {
    return fmt::format("{}i{}", scope_prefix(scope, info.owner), values_.word(function, 0));
  }
  if (!info.symbol) {
    return fmt::format("{}(\\{} @ …)", scope_prefix(scope, info.owner), info.parameters);
  }
  return scope_prefix(scope, definition_around(info.symbol)) +
         resolution_.symbols[info.symbol].qualified + applied;
}

bool Machine::takes_arguments(ValueId function) const {
  return !program_.functions[FunctionId{values_.word(function, 0)}].group_sizes.empty();
}

std::string Machine::call_name(ProcId call) const {
  return function_name(ValueId{processes_.word(call, 0)});
}

base::Span Machine::definition_span(ProcId call) const {
  return program_.functions[FunctionId{values_.word(ValueId{processes_.word(call, 0)}, 0)}].span;
}

}  // namespace perentie::semantics

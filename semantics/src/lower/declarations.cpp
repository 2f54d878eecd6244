// Lowering of declarations: global slots, `let` scopes, functions, and declared types.
#include <algorithm>

#include "../pattern_names.hpp"
#include "lower.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/parser/print.hpp"

namespace perentie::semantics {

using base::overload;
using parser::DeclId;
using parser::ExprId;
using parser::PatternId;

// --- Globals ------------------------------------------------------------------------------------

void Lowering::declarations(parser::DeclList list) {
  // Slots first: definitions refer to each other in any order.
  for (const DeclId id : tree_.list(list)) declare_global(id);
  emit_pending();
}

std::uint32_t Lowering::new_global(GlobalInit init) {
  program_.globals.push_back(init);
  return static_cast<std::uint32_t>(program_.globals.size() - 1);
}

void Lowering::global_thunk(SymbolId symbol, std::function<void()> emit_value) {
  const std::uint32_t slot = new_global({GlobalInit::Kind::thunk});
  if (symbol) set_location(symbol, {Place::global, 0, slot});
  queue([this, symbol, slot, emit_value = std::move(emit_value)](Address entry) {
    program_.globals[slot].target = entry;
    owner_ = symbol;
    emit_value();
  });
}

void Lowering::declare_global(DeclId id) {
  std::visit(
      overload{
          [&](const parser::PatternDecl& d) { declare_global_pattern(d); },
          [&](const parser::FunctionDecl&) {
            const SymbolId symbol = resolution_.of_decl[id.value];
            const FunctionId function = add_function(symbol, id);
            const std::uint32_t slot = new_global({GlobalInit::Kind::function, function.value});
            set_location(symbol, {Place::global, 0, slot});
          },
          [&](const parser::ChannelDecl& d) {
            if (!d.type) return;
            for (const SymbolId channel : resolution_.members.at(id.value)) {
              field_types(channel, d.type);
            }
          },
          [&](const parser::DatatypeDecl& d) {
            const SymbolId symbol = resolution_.of_decl[id.value];
            global_thunk(symbol, [this, symbol, id, is_subtype = d.is_subtype] {
              if (is_subtype) {
                subtype_set(id);
              } else {
                emit(Op::datatype_set, symbol.value);
              }
              emit(Op::ret);
            });
            if (d.is_subtype) return;
            const auto constructors = tree_.list(d.constructors);
            for (std::uint32_t i = 0; i < constructors.size(); ++i) {
              if (constructors[i].type) {
                field_types(resolution_.members.at(id.value)[i], constructors[i].type);
              }
            }
          },
          [&](const parser::NametypeDecl& d) {
            global_thunk(resolution_.of_decl[id.value], [this, type = d.type] {
              type_set(type);
              emit(Op::ret);
            });
          },
          [&](const parser::ModuleDecl& d) {
            // A parameterised module has no values of its own.
            if (!d.parameters.empty()) return;
            declare_members(d);
          },
          [&](const parser::InstanceDecl&) {
            const ModuleInstance& instance = resolution_.instances.at(id.value);
            for (const DeclId parameter : instance.parameters) declare_global(parameter);
            declare_members(std::get<parser::ModuleDecl>(tree_.decls[instance.module].node));
          },
          [&](const parser::TimedDecl&) {
            timed_section(
                id, [this](DeclId member) { declare_global(member); },
                [this](ExprId duration) {
                  const auto slot = static_cast<std::uint32_t>(program_.globals.size());
                  global_thunk({}, [this, duration] { value(duration, Tail::yes); });
                  return Location{Place::global, 0, slot};
                });
          },
          [](const auto&) {},
      },
      tree_.decls[id].node);
}

void Lowering::declare_members(const parser::ModuleDecl& module) {
  for (const DeclId member : tree_.list(module.private_declarations)) declare_global(member);
  for (const DeclId member : tree_.list(module.exported_declarations)) declare_global(member);
}

SymbolId Lowering::single_name(PatternId pattern) const {
  const bool is_name = std::holds_alternative<parser::NamePattern>(tree_.patterns[pattern].node);
  return is_name ? resolution_.of_pattern[pattern.value] : SymbolId{};
}

std::vector<SymbolId> Lowering::declared_variables(PatternId pattern) const {
  std::vector<SymbolId> variables;
  for_each_name(tree_, pattern, [&](PatternId id, const parser::NamePattern&) {
    const SymbolId symbol = resolution_.of_pattern[id.value];
    if (symbol && resolution_.symbols[symbol].kind == SymbolKind::constant) {
      variables.push_back(symbol);
    }
  });
  return variables;
}

void Lowering::declare_global_pattern(const parser::PatternDecl& d) {
  if (const SymbolId symbol = single_name(d.pattern)) {
    if (resolution_.symbols[symbol].is_process) {
      const FunctionId function = add_process_constant(symbol, d.value);
      set_location(symbol, {Place::process_constant, 0, function.value});
    } else {
      global_thunk(symbol, [this, expr = d.value] { value(expr, Tail::yes); });
    }
    return;
  }
  const auto source = static_cast<std::uint32_t>(program_.globals.size());
  global_thunk({}, [this, expr = d.value] { value(expr, Tail::yes); });
  for (const SymbolId variable : declared_variables(d.pattern)) {
    global_thunk(variable, [this, pattern = d.pattern, variable, source] {
      pattern_variable(pattern, variable, [this, source] { emit(Op::load_global, source); });
    });
  }
}

// One variable of a declared pattern: match again, then take the variable. Matching is repeated for
// every variable that is used, but only evaluates what the pattern demands (1.9.9).
void Lowering::pattern_variable(PatternId declared, SymbolId variable,
                                const std::function<void()>& load_source) {
  // Inside, the pattern's variables are those of this match.
  std::vector<std::pair<SymbolId, Location>> outside;
  for (const SymbolId symbol : declared_variables(declared)) {
    outside.emplace_back(symbol, locations_[symbol.value]);
  }
  Label fail;
  emit(Op::enter, open_scope(ScopeKind::binding).value);
  load_source();
  pattern(declared, fail);
  load_symbol(variable);
  emit(Op::force);
  emit(Op::ret);
  place(fail);
  load_source();
  emit(Op::canon);
  emit(Op::no_match_value);
  close_scope();
  for (const auto& [symbol, location] : outside) set_location(symbol, location);
}

// --- Let ----------------------------------------------------------------------------------------

void Lowering::let_scope(const parser::LetExpr& let) {
  emit(Op::enter, open_scope(ScopeKind::let).value);
  for (const DeclId id : tree_.list(let.declarations)) let_member(id);
}

void Lowering::let_thunk(std::uint32_t slot, std::function<void()> emit_value) {
  const ScopeId scope = current_scope();
  const std::size_t member = program_.scopes[scope].members.size();
  program_.scopes[scope].members.push_back({slot, false, 0});
  queue([this, scope, member, emit_value = std::move(emit_value)](Address entry) {
    program_.scopes[scope].members[member].target = entry;
    emit_value();
  });
}

void Lowering::let_member(DeclId id) {
  const parser::Decl& decl = tree_.decls[id];
  if (std::holds_alternative<parser::FunctionDecl>(decl.node)) {
    const SymbolId symbol = resolution_.of_decl[id.value];
    const std::uint32_t slot = add_slot();
    set_location(symbol, {Place::local, depth(), slot});
    program_.owners[symbol.value] = owner_;
    const FunctionId function = add_function(symbol, id);
    program_.scopes[current_scope()].members.push_back({slot, true, function.value});
    return;
  }
  if (std::holds_alternative<parser::TimedDecl>(decl.node)) {
    timed_section(
        id, [this](DeclId member) { let_member(member); },
        [this](ExprId duration) {
          const std::uint32_t slot = add_slot();
          let_thunk(slot, [this, duration] { value(duration, Tail::yes); });
          return Location{Place::local, depth(), slot};
        });
    return;
  }
  const auto* d = std::get_if<parser::PatternDecl>(&decl.node);
  if (d == nullptr) return;  // annotations, imports
  if (const SymbolId symbol = single_name(d->pattern)) {
    program_.owners[symbol.value] = owner_;
    if (resolution_.symbols[symbol].is_process) {
      const FunctionId function = add_process_constant(symbol, d->value);
      set_location(symbol, {Place::process_constant, depth(), function.value});
    } else {
      const std::uint32_t slot = add_slot();
      set_location(symbol, {Place::local, depth(), slot});
      let_thunk(slot, [this, symbol, expr = d->value] {
        owner_ = symbol;
        value(expr, Tail::yes);
      });
    }
    return;
  }
  const std::uint32_t source = add_slot();
  const std::uint32_t let_depth = depth();
  let_thunk(source, [this, expr = d->value] { value(expr, Tail::yes); });
  for (const SymbolId variable : declared_variables(d->pattern)) {
    const std::uint32_t slot = add_slot();
    set_location(variable, {Place::local, depth(), slot});
    let_thunk(slot, [this, pattern = d->pattern, variable, source, let_depth] {
      pattern_variable(pattern, variable,
                       [this, source, let_depth] { emit(Op::load, source, depth() - let_depth); });
    });
  }
}

// --- Functions ----------------------------------------------------------------------------------

FunctionId Lowering::add_process_constant(SymbolId symbol, ExprId value) {
  const FunctionId function = program_.functions.add(FunctionInfo{
      .symbol = symbol, .span = *resolution_.symbols[symbol].span, .is_process = true});
  queue([this, symbol, function, value](Address entry) {
    program_.functions[function].entry = entry;
    owner_ = symbol;
    process(value, Tail::yes);
  });
  return function;
}

FunctionId Lowering::add_function(SymbolId symbol, DeclId id) {
  const auto& decl = std::get<parser::FunctionDecl>(tree_.decls[id].node);
  const auto clauses = tree_.list(decl.clauses);
  FunctionInfo info{.symbol = symbol,
                    .span = tree_.decls[id].span,
                    .is_process = resolution_.symbols[symbol].is_process};
  const FunctionId function{static_cast<std::uint32_t>(program_.functions.size())};
  std::uint32_t first = 0;
  for (const std::uint32_t size : tree_.list(clauses[0].group_sizes)) {
    ScopeInfo scope{.kind = ScopeKind::arguments, .slot_count = size, .function = function};
    info.ignored.assign(size, true);
    for (std::uint32_t i = 0; i < size; ++i) {
      for (const parser::Clause& clause : clauses) {
        if (!is_ignored(tree_.list(clause.parameters)[first + i])) info.ignored[i] = false;
      }
      if (!info.ignored[i]) scope.identity.push_back(i);
    }
    first += size;
    info.group_sizes.push_back(size);
    info.group_scopes.push_back(program_.scopes.add(std::move(scope)));
  }
  program_.functions.add(std::move(info));
  queue([this, symbol, function, id](Address entry) {
    program_.functions[function].entry = entry;
    owner_ = symbol;
    function_block(function, std::get<parser::FunctionDecl>(tree_.decls[id].node));
  });
  return function;
}

void Lowering::function_block(FunctionId function, const parser::FunctionDecl& decl) {
  const std::vector<ScopeId> groups = program_.functions[function].group_scopes;
  for (const ScopeId group : groups) enter_static(group);
  for (const parser::Clause& c : tree_.list(decl.clauses)) clause(function, c);
  span_ = decl.name.span;
  emit(Op::no_match, function.value);
}

void Lowering::clause(FunctionId function, const parser::Clause& clause) {
  const auto parameters = tree_.list(clause.parameters);
  const std::vector<std::uint32_t> sizes = program_.functions[function].group_sizes;
  const std::uint32_t outermost = depth() + 1 - static_cast<std::uint32_t>(sizes.size());
  Label fail;
  std::size_t next = 0;
  for (std::uint32_t group = 0; group < sizes.size(); ++group) {
    for (std::uint32_t slot = 0; slot < sizes[group]; ++slot, ++next) {
      const PatternId parameter = parameters[next];
      if (is_ignored(parameter)) continue;
      const Location argument{Place::local, outermost + group, slot};
      const SymbolId symbol = single_name(parameter);
      if (symbol && resolution_.symbols[symbol].kind == SymbolKind::variable) {
        set_location(symbol, argument);  // the argument is the variable
        continue;
      }
      emit(Op::load, slot, depth() - argument.depth);
      pattern(parameter, fail);
    }
  }
  const bool is_process = program_.functions[function].is_process;
  if (is_process) {
    process(clause.body, Tail::yes);
  } else {
    value(clause.body, Tail::yes);
  }
  place(fail);
}

void Lowering::lambda(ExprId expr, const parser::LambdaExpr& lambda) {
  const auto parameters = tree_.list(lambda.parameters);
  const auto size = static_cast<std::uint32_t>(parameters.size());
  const FunctionId function{static_cast<std::uint32_t>(program_.functions.size())};
  ScopeInfo scope{
      .kind = ScopeKind::arguments, .slot_count = size, .function = function, .owner = owner_};
  FunctionInfo info{.span = tree_.exprs[expr].span, .group_sizes = {size}, .owner = owner_};
  for (std::uint32_t i = 0; i < size; ++i) {
    info.ignored.push_back(is_ignored(parameters[i]));
    info.parameters += i > 0 ? ", " : "";
    info.parameters += info.ignored[i] ? "_" : parser::print(tree_, parameters[i], {.width = 0});
    if (!info.ignored[i]) scope.identity.push_back(i);
  }
  info.group_scopes.push_back(program_.scopes.add(std::move(scope)));
  program_.functions.add(std::move(info));
  emit(Op::make_closure, function.value);
  queue([this, function, lambda](Address entry) {
    program_.functions[function].entry = entry;
    enter_static(program_.functions[function].group_scopes[0]);
    Label fail;
    std::uint32_t slot = 0;
    for (const PatternId parameter : tree_.list(lambda.parameters)) {
      const SymbolId symbol = single_name(parameter);
      if (symbol && resolution_.symbols[symbol].kind == SymbolKind::variable) {
        set_location(symbol, {Place::local, depth(), slot});
      } else if (!is_ignored(parameter)) {
        emit(Op::load, slot);
        pattern(parameter, fail);
      }
      ++slot;
    }
    value(lambda.body, Tail::yes);
    place(fail);
    emit(Op::no_match, function.value);
  });
}

// --- Declared types -----------------------------------------------------------------------------

void Lowering::field_types(SymbolId symbol, ExprId type) {
  queue([this, symbol, type](Address entry) {
    program_.field_types[symbol.value] = entry;
    const std::vector<ExprId> operands = right_spine(type, parser::InfixOp::dot);
    for (const ExprId operand : operands) type_set(operand);
    span_ = tree_.exprs[type].span;
    emit(Op::make_fields, static_cast<std::uint32_t>(operands.size()));
    emit(Op::ret);
  });
}

// A type expression as a set: dots and tuples of types are products (2.3.2).
void Lowering::type_set(ExprId type) {
  const std::vector<ExprId> operands = right_spine(type, parser::InfixOp::dot);
  if (operands.size() > 1) {
    for (const ExprId operand : operands) type_set(operand);
    span_ = tree_.exprs[type].span;
    emit(Op::dot_product, static_cast<std::uint32_t>(operands.size()));
    return;
  }
  const auto* tuple = std::get_if<parser::TupleExpr>(&tree_.exprs[type].node);
  if (tuple == nullptr) return canonical(type);
  for (const ExprId item : tree_.list(tuple->items)) type_set(item);
  span_ = tree_.exprs[type].span;
  emit(Op::tuple_product, tuple->items.count);
}

// `subtype S = C.te | ..`: the productions of each `C.te` (2.3.7).
void Lowering::subtype_set(DeclId id) {
  const auto& d = std::get<parser::DatatypeDecl>(tree_.decls[id].node);
  emit(Op::acc_begin);
  const auto constructors = tree_.list(d.constructors);
  for (std::size_t i = 0; i < constructors.size(); ++i) {
    const parser::Constructor& c = constructors[i];
    span_ = c.name.span;
    const ValueId atom = values_.make_atom(resolution_.members.at(id.value)[i]);
    std::uint32_t sets = 1;
    emit_value(values_.make_sorted_set(std::span(&atom, 1)));
    if (c.type) {
      for (const ExprId operand : right_spine(c.type, parser::InfixOp::dot)) {
        type_set(operand);
        ++sets;
      }
    }
    if (sets > 1) emit(Op::dot_product, sets);
    emit(Op::acc_add_all);
  }
  emit(Op::acc_productions);
}

}  // namespace perentie::semantics

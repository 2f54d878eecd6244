// Blocks, scopes and variables of the lowering, and its public steps.
#include "lower.hpp"

#include <utility>

#include <fmt/format.h>

#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

using parser::ExprId;

namespace {

// How deep expressions may nest. The parser refuses more than this between brackets; this limit is
// for chains that nest without brackets, such as `c?x -> c?y -> ..`.
constexpr std::uint32_t max_nesting = 2'000;

}  // namespace

Lowering::Lowering(const parser::SyntaxTree& tree, const Resolution& resolution,
                   const PreludeFunctions& prelude, ValueStore& values, Program& program,
                   base::Diagnostics& diagnostics)
    : tree_(tree),
      resolution_(resolution),
      prelude_(prelude),
      values_(values),
      program_(program),
      diagnostics_(diagnostics) {}

// --- Emission -----------------------------------------------------------------------------------

Address Lowering::emit(Op op, std::uint32_t b, std::size_t a) {
  PERENTIE_CHECK(a <= Instruction::max_a, "an instruction operand does not fit");
  program_.code.emplace_back(op, static_cast<std::uint32_t>(a), b);
  program_.spans.push_back(span_);
  return here() - 1;
}

void Lowering::emit_jump(Op op, Label& label, std::size_t a) {
  label.uses.push_back(emit(op, 0, a));
}

void Lowering::place(const Label& label) {
  for (const Address use : label.uses) program_.code[use].b = here();
}

bool Lowering::too_deep(ExprId expr) {
  if (nesting_ < max_nesting) return false;
  diagnostics_.report(
      codes::nested_too_deeply, tree_.exprs[expr].span,
      fmt::format("this expression is nested more than {} levels deep", max_nesting));
  return true;
}

// --- Scopes and variables -----------------------------------------------------------------------

ScopeId Lowering::open_scope(ScopeKind kind) {
  const ScopeId scope = program_.scopes.add(ScopeInfo{.kind = kind, .owner = owner_});
  enter_static(scope);
  return scope;
}

void Lowering::enter_static(ScopeId scope) {
  static_scopes_.push_back({scope, scope_, depth() + 1});
  scope_ = static_cast<ScopeIndex>(static_scopes_.size() - 1);
}

std::uint32_t Lowering::add_slot() {
  return program_.scopes[static_scopes_[scope_].scope].slot_count++;
}

void Lowering::set_location(SymbolId symbol, Location location) {
  if (symbol.value >= locations_.size()) locations_.resize(resolution_.symbols.size());
  locations_[symbol.value] = location;
}

std::uint32_t Lowering::add_variable(SymbolId symbol) {
  const std::uint32_t slot = add_slot();
  program_.scopes[static_scopes_[scope_].scope].identity.push_back(slot);
  set_location(symbol, {Place::local, depth(), slot});
  return slot;
}

std::uint32_t Lowering::global_slot(SymbolId symbol) const {
  PERENTIE_CHECK(
      symbol.value < locations_.size() && locations_[symbol.value].place == Place::global,
      "a global symbol without a slot");
  return locations_[symbol.value].slot;
}

void Lowering::load_symbol(SymbolId symbol) {
  PERENTIE_CHECK(symbol.value < locations_.size(), "a symbol without a location");
  const Location& location = locations_[symbol.value];
  switch (location.place) {
    case Place::nowhere:
      PERENTIE_CHECK(false, "a variable is used outside its scope");
      break;
    case Place::global:
      emit(Op::load_global, location.slot);
      break;
    case Place::local:
      emit(Op::load, location.slot, depth() - location.depth);
      break;
    case Place::process_constant:
      emit(Op::process_ref, location.slot,
           location.depth == 0 ? no_frame : depth() - location.depth);
      break;
  }
}

// --- Blocks -------------------------------------------------------------------------------------

Address Lowering::expression(ExprId expr) {
  const Address entry = here();
  canonical(expr);
  emit(Op::ret);
  emit_pending();
  return entry;
}

Address Lowering::process_expression(ExprId expr, parser::DeclId timed_section) {
  if (timed_section) {
    timed_ = static_cast<TimedIndex>(timed_sections_.size());
    timed_sections_.push_back(
        {resolution_.tocks.at(timed_section.value), {}, /*has_timed_operators=*/false});
  }
  const Address entry = here();
  process(expr);
  emit(Op::ret);
  emit_pending();
  return entry;
}

void Lowering::emit_pending() {
  while (!pending_.empty()) {
    const Pending block = std::move(pending_.back());
    pending_.pop_back();
    scope_ = block.scope;
    timed_ = block.timed;
    owner_ = block.owner;
    block.emit(here());
  }
  scope_ = no_scope;
  timed_ = not_timed;
  owner_ = SymbolId{};
}

}  // namespace perentie::semantics

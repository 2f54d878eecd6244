// The core language: code for a small stack machine with call by need.
//
// A program is one array of instructions. Blocks begin at an address and end with `ret`; functions,
// thunks and constants name the address of their block. Variables are slots of frames; a frame
// belongs to a static scope and links to the frame of the enclosing one.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "perentie/base/id.hpp"
#include "perentie/base/source.hpp"
#include "perentie/semantics/process.hpp"
#include "perentie/semantics/symbols.hpp"
#include "perentie/semantics/value.hpp"

namespace perentie::semantics {

enum class Op : std::uint8_t {
#define PERENTIE_INSTRUCTION(id, operands) id,
#include "instructions.def"
#undef PERENTIE_INSTRUCTION
};

/// An operation with a small and a large operand.
struct Instruction {
  Instruction(Op operation, std::uint32_t small, std::uint32_t large)
      : op(operation), a(small & max_a), b(large) {}

  static constexpr std::uint32_t max_a = 0xFF'FFFF;

  Op op : 8;
  std::uint32_t a : 24;
  std::uint32_t b;
};
static_assert(sizeof(Instruction) == 8);

using Address = std::uint32_t;
/// As the number of links of `process_ref`: the constant is global and has no frame.
inline constexpr std::uint32_t no_frame = 0xFF'FFFF;
using FunctionId = base::Id<struct FunctionTag>;
using ScopeId = base::Id<struct ScopeTag>;

enum class ScopeKind : std::uint8_t {
  arguments,  ///< one argument group of a function or lambda, with its pattern variables
  binding,    ///< the variables of a field, generator or pattern
  let,        ///< the definitions of a `let`
};

/// A definition of a `let` block: what `enter` puts into its slot.
struct LetMember {
  std::uint32_t slot;
  bool is_function;      ///< otherwise a thunk
  std::uint32_t target;  ///< a FunctionId or the address of a thunk's block
};

struct ScopeInfo {
  ScopeKind kind;
  std::uint32_t slot_count = 0;
  /// The slots whose values identify an activation: pattern variables that are used somewhere
  /// (CSPM reference 3.8.1, 3.8.2). Argument slots come first.
  std::vector<std::uint32_t> identity = {};
  std::vector<LetMember> members = {};
  FunctionId function = {};  ///< of `arguments`
  SymbolId owner = {};       ///< the definition in whose body the scope is
};

/// A function, a lambda, or (with no groups) a constant whose value is a process.
struct FunctionInfo {
  SymbolId symbol = {};  ///< none: a lambda, or the state before a timed prefix
  base::Span span = {};
  std::vector<std::uint32_t> group_sizes = {};
  std::vector<ScopeId> group_scopes = {};
  Address entry = 0;
  bool is_process = false;
  SymbolId owner = {};             ///< without `symbol`: the definition around
  std::string parameters = {};     ///< of a lambda, as written
  bool is_timed_prefix = false;    ///< `X = tock -> X [] e -> P` (2.10.4)
  std::vector<bool> ignored = {};  ///< of the last group: arguments that no clause looks at
};

/// A sequence pattern `<p1,..>^m^<q1,..>`: how many elements at each end.
struct EndsPattern {
  std::uint32_t prefix = 0;
  std::uint32_t suffix = 0;
};

/// A dot pattern, flattened: an atom to match, or (none) one field to take; the last item that
/// takes takes all remaining fields (1.9.5).
struct DotItems {
  std::vector<SymbolId> items;
};

/// What a global slot holds before anything is evaluated.
struct GlobalInit {
  enum class Kind : std::uint8_t { thunk, function };
  Kind kind;
  std::uint32_t target = 0;  ///< the address of the block, or the FunctionId
};

struct Program {
  std::vector<Instruction> code;
  std::vector<base::Span> spans;  ///< by address
  base::Store<FunctionId, FunctionInfo> functions;
  base::Store<ScopeId, ScopeInfo> scopes;
  std::vector<EndsPattern> ends_patterns;
  std::vector<DotItems> dot_patterns;
  std::vector<GlobalInit> globals;
  /// The block that evaluates the declared fields of a channel or constructor, by symbol; absent
  /// for those without data. It leaves a tuple of field sets.
  std::unordered_map<std::uint32_t, Address> field_types;
  /// The definition around a definition in a `let`, by symbol.
  std::unordered_map<std::uint32_t, SymbolId> owners;
  Address prelude_end = 0;  ///< code before this address belongs to the prelude
};

/// A listing for `dump --phase core`.
std::string list_code(const Program& program, const Resolution& resolution,
                      const ValueStore& values);

}  // namespace perentie::semantics

// Symbols: what every name of a script stands for, once scopes are resolved.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "perentie/base/id.hpp"
#include "perentie/parser/ast.hpp"
#include "perentie/semantics/builtins.hpp"

namespace perentie::semantics {

using SymbolId = base::Id<struct SymbolTag>;

enum class SymbolKind : std::uint8_t {
  builtin,
  constant,  ///< `x = e`, or one variable of `p = e`
  function,  ///< `f(..) = e`
  channel,
  constructor,
  datatype,  ///< or subtype: the set of its values
  nametype,
  variable,     ///< bound by a function's, lambda's, field's or generator's pattern
  module,       ///< or an instance of one
  unsupported,  ///< declared by a construct that is not supported yet; an error where it is used
};

struct Symbol {
  SymbolKind kind;
  base::NameId name;
  std::string qualified;           ///< as printed: `M::x` for a member of a module
  std::optional<base::Span> span;  ///< where it is defined; none for built-ins
  Builtin builtin{};               ///< of a `builtin`
  parser::DeclId decl = {};        ///< of everything declared
  std::uint32_t index = 0;         ///< of a constructor or channel: its place in the declaration
  std::uint32_t groups = 0;        ///< of a function: how many argument groups it takes
  std::string_view unsupported_construct =
      {};  ///< of an `unsupported`: which, such as "timed sections"
  bool is_used = false;
  bool is_process = false;  ///< a constant or function whose (final) value is a process
};

/// The members of a module by name.
struct ModuleMembers {
  std::unordered_map<base::NameId, SymbolId> exported;
  std::unordered_map<base::NameId, SymbolId> private_;
  parser::DeclId decl;  ///< the `ModuleDecl`: for an instance, its copy of the module's
  /// A parameterised module: it has no values and no channels, only its instances have.
  bool is_parameterised = false;
};

/// `instance N = M(e1, ..)`: the copy of `M` that is `N`, and a definition `p = e` for each
/// parameter. Both are declarations of the tree that are in none of its lists (2.9.5, 2.9.6).
struct ModuleInstance {
  parser::DeclId module;
  std::vector<parser::DeclId> parameters;
};

/// What name resolution found: side tables beside the (unchanged) syntax tree, by node id.
struct Resolution {
  base::Store<SymbolId, Symbol> symbols;
  std::vector<SymbolId> of_expr;  ///< a NameExpr: what it refers to
  std::vector<SymbolId>
      of_pattern;  ///< a NamePattern: the variable it binds or the atom it matches
  std::vector<SymbolId>
      of_decl;  ///< a function, datatype, nametype, module or instance: its symbol
  std::vector<SymbolId> of_type;  ///< a NamedType: the datatype or other definition that it names
  /// By SymbolId of what has a type annotation: the AnnotationDecl.
  std::unordered_map<std::uint32_t, parser::DeclId> annotations;
  std::vector<SymbolId> channels;  ///< all channels, in order of declaration
  /// By DeclId: the channels of a channel declaration, the constructors that a datatype declares or
  /// a subtype names.
  std::unordered_map<std::uint32_t, std::vector<SymbolId>> members;
  std::unordered_map<std::uint32_t, ModuleMembers> modules;  ///< by SymbolId of module or instance
  std::unordered_map<std::uint32_t, ModuleInstance> instances;  ///< by DeclId of the instance
  std::unordered_map<std::uint32_t, SymbolId> tocks;  ///< by DeclId of a timed section: its `tock`
  std::unordered_map<std::string, SymbolId> prelude;  ///< the functions of the prelude
};

}  // namespace perentie::semantics

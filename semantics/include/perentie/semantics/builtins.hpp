// The built-in names of CSPM: constants, functions, processes and process functions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace perentie::semantics {

enum class Builtin : std::uint8_t {
#define PERENTIE_BUILTIN(id, name, kind, import, arguments) id,
#include "perentie/semantics/builtins.def"
#undef PERENTIE_BUILTIN
};

enum class BuiltinKind : std::uint8_t {
  constant,
  process_constant,
  function,
  process_function,
  opaque,   ///< a process function; its process can be named, but its transitions are not supported
  prelude,  ///< defined in the prelude, in CSPM
};

/// Which declaration brings the name into scope (CSPM reference 2.5.3, 2.10.3).
enum class Import : std::uint8_t { no, transparent, external, either, timed };

struct BuiltinInfo {
  std::string_view name;
  BuiltinKind kind;
  Import import;
  std::string_view arguments;  ///< one letter per argument, see builtins.def
};

inline constexpr auto builtin_table = std::to_array<BuiltinInfo>({
#define PERENTIE_BUILTIN(id, name, kind, import, arguments) \
  {name, BuiltinKind::kind, Import::import, arguments},
#include "perentie/semantics/builtins.def"
#undef PERENTIE_BUILTIN
});

constexpr const BuiltinInfo& info(Builtin builtin) {
  return builtin_table[static_cast<std::size_t>(builtin)];
}

}  // namespace perentie::semantics

// The infix operators of CSPM with their levels and associativity (CSPM reference 1.7).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace perentie::parser {

enum class InfixOp : std::uint8_t {
#define PERENTIE_INFIX(id, spelling, level, associativity) id,
#include "perentie/parser/operators.def"
#undef PERENTIE_INFIX
};

enum class Associativity : std::uint8_t { left, right, none };

struct InfixInfo {
  std::string_view spelling;
  std::uint8_t level;  ///< a smaller level binds tighter
  Associativity associativity;
};

inline constexpr auto infix_table = std::to_array<InfixInfo>({
#define PERENTIE_INFIX(id, spelling, level, associativity) \
  {spelling, level, Associativity::associativity},
#include "perentie/parser/operators.def"
#undef PERENTIE_INFIX
});

constexpr const InfixInfo& info(InfixOp op) { return infix_table[static_cast<std::size_t>(op)]; }

/// Levels of what is not in the table: the printer compares them with the operators'.
inline constexpr std::uint8_t level_postfix = 2;      ///< `f(..)`, `P[[..]]`, and every atom
inline constexpr std::uint8_t level_length = 4;       ///< `#s`
inline constexpr std::uint8_t level_negate = 6;       ///< `-x`
inline constexpr std::uint8_t level_not = 8;          ///< `not b`
inline constexpr std::uint8_t level_replicated = 23;  ///< `[] x:S @ P`
inline constexpr std::uint8_t level_open = 25;        ///< `let`, `if`, `\x @ e`

}  // namespace perentie::parser

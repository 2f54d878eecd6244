// Tokens: what the lexer hands to the grammar.
//
// Newlines that separate declarations are tokens; all others are gone, and so are comments. `<` and
// `>` are already told apart into comparisons and brackets of sequences (CSPM reference 1.1, 1.5).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/base/source.hpp"
#include "perentie/parser/ast.hpp"

namespace perentie::parser {

enum class TokenKind : std::uint8_t {
#define PERENTIE_TOKEN(id, token_class, spelling, before, after, operand) id,
#include "perentie/parser/token_kinds.def"
#undef PERENTIE_TOKEN
};

enum class TokenClass : std::uint8_t { symbol, keyword, special };

struct TokenInfo {
  std::string_view id;
  TokenClass token_class;
  std::string_view spelling;
  bool soaks_before;  ///< newlines before the token vanish
  bool soaks_after;   ///< newlines after the token vanish
  bool ends_operand;  ///< `<` after the token is less-than
};

const TokenInfo& info(TokenKind kind);

/// How messages call a kind: "`->`" with backquotes where it is a text, otherwise "a name".
std::string describe(TokenKind kind);

/// What stands between `:[` and `]` (1.6.3).
enum class PropertyWord : std::uint8_t {
  deadlock_free,
  livelock_free,
  divergence_free,
  deterministic,
  has_trace,
  tau_priority,
  partial_order_reduce,
};

struct Token {
  TokenKind kind;
  /// Identifiers, strings, includes and print lines: a `NameId` (the text, with escapes resolved).
  /// Characters: the byte. Integers: an index into `TokenStream::integers`. `refines` and
  /// `property_model`: a `Model`; `property`: a `PropertyWord`; `property_reduction`: a
  /// `PartialOrderMode`.
  std::uint32_t value = 0;
  base::Span span;

  NameId name() const { return NameId{value}; }
};

/// The largest integer of CSPM values: they have 63 bits (docs/decisions/0006-integers.md).
inline constexpr std::int64_t largest_integer = (std::int64_t{1} << 62) - 1;

/// The tokens of a text, or of a script with its includes; the last one is `end_of_file`.
struct TokenStream {
  std::vector<Token> tokens;
  std::vector<std::int64_t> integers;
};

}  // namespace perentie::parser

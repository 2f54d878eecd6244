// Tokens: what the lexer hands to the grammar.
#pragma once

#include <cstdint>
#include <string_view>

#include "perentie/base/source.hpp"

namespace perentie::parser {

enum class TokenKind : std::uint8_t {
#define PERENTIE_TOKEN(id, spelling) id,
#include "perentie/parser/token_kinds.def"
#undef PERENTIE_TOKEN
};

/// How messages and `dump --phase tokens` call a kind: "`->`", "identifier", "end of file".
std::string_view spelling(TokenKind kind);

struct Token {
  TokenKind kind;
  /// Identifiers: the name. Character literals: the byte. Integer and string literals: an index into
  /// `TokenStream`.
  std::uint32_t value = 0;
  base::Span span;
};

}  // namespace perentie::parser

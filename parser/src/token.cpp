#include "perentie/parser/token.hpp"

#include <array>
#include <cstddef>

#include <fmt/format.h>

namespace perentie::parser {
namespace {

constexpr bool soak = true;
constexpr bool keep = false;
constexpr bool ends = true;
constexpr bool open = false;

constexpr auto token_table = std::to_array<TokenInfo>({
#define PERENTIE_TOKEN(id, token_class, spelling, before, after, operand) \
  {#id, TokenClass::token_class, spelling, before, after, operand},
#include "perentie/parser/token_kinds.def"
#undef PERENTIE_TOKEN
});

}  // namespace

const TokenInfo& info(TokenKind kind) { return token_table[static_cast<std::size_t>(kind)]; }

std::string describe(TokenKind kind) {
  const TokenInfo& i = info(kind);
  const bool is_text = i.token_class != TokenClass::special || i.spelling.size() <= 2;
  return is_text ? fmt::format("`{}`", i.spelling) : std::string(i.spelling);
}

}  // namespace perentie::parser

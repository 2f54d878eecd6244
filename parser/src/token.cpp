#include "perentie/parser/token.hpp"
namespace perentie::parser {
std::string_view spelling(TokenKind) { return ""; }
}  // namespace perentie::parser

#include "recovery.hpp"

namespace perentie::parser {
namespace {

using K = TokenKind;

bool starts_declaration(K kind) {
  switch (kind) {
    case K::channel_:
    case K::assert_:
    case K::datatype_:
    case K::subtype_:
    case K::nametype_:
    case K::external_:
    case K::transparent_:
    case K::module_:
    case K::exports_:
    case K::endmodule_:
    case K::instance_:
    case K::timed_:
    case K::print_:
      return true;
    default:
      return false;
  }
}

/// Whether the line that begins at `t` has a `=` or `::` outside brackets.
bool looks_like_definition(const Token* t) {
  int depth = 0;
  for (; t->kind != K::newline && t->kind != K::end_of_file && depth >= 0; ++t) {
    switch (t->kind) {
      case K::define:
      case K::annotate:
        if (depth == 0) return true;
        break;
      case K::left_paren:
      case K::left_brace:
      case K::left_sequence:
        ++depth;
        break;
      case K::right_paren:
      case K::right_brace:
      case K::right_sequence:
        --depth;
        break;
      case K::let_:
      case K::within_:
        return false;
      default:
        break;
    }
  }
  return false;
}

int change_of_lets(K kind) { return kind == K::let_ ? 1 : kind == K::within_ ? -1 : 0; }

}  // namespace

const Token* recover(const Token* first, const Token* where, bool in_timed_section,
                     const base::SourceMap& sources) {
  const base::FileId file = sources.file_of(first->span.begin);
  const std::uint32_t column = sources.position(first->span.begin).column;
  const auto is_outside = [&](const Token* t) {
    return sources.file_of(t->span.begin) != file ||
           sources.position(t->span.begin).column <= column;
  };
  int lets = 0;
  for (const Token* t = first; t < where; ++t) lets += change_of_lets(t->kind);
  int braces = 0;
  for (const Token* t = where; t->kind != K::end_of_file; ++t) {
    lets += change_of_lets(t->kind);
    if (t->kind == K::left_brace) ++braces;
    if (t->kind == K::right_brace && --braces < 0 && in_timed_section) return t;
    if (t->kind != K::newline) continue;
    const Token* next = t + 1;
    if (!starts_declaration(next->kind) && !looks_like_definition(next)) continue;
    if (lets <= 0 || is_outside(next)) return t;
  }
  while (where->kind != K::end_of_file) ++where;
  return where;
}

}  // namespace perentie::parser

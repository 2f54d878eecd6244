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

bool same_line(const Token& a, const Token& b, const base::SourceMap& sources) {
  return sources.file_of(a.span.end) == sources.file_of(b.span.begin) &&
         sources.text({a.span.end, b.span.begin}).find('\n') == std::string_view::npos;
}

/// Whether the line of text that begins at `t` has a `=` or `::`, and no `let` or `within` before
/// it.
bool looks_like_definition(const Token* t, const base::SourceMap& sources) {
  for (const Token* begin = t; t == begin || same_line(*(t - 1), *t, sources); ++t) {
    if (t->kind == K::define || t->kind == K::annotate) return true;
    if (t->kind == K::let_ || t->kind == K::within_ || t->kind == K::end_of_file) return false;
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
  const auto begins_next = [&](const Token* t) {
    return (starts_declaration(t->kind) || looks_like_definition(t, sources)) &&
           (lets <= 0 || is_outside(t));
  };
  const Token* line = first_of_line(first, where, sources);
  for (const Token* t = first; t < line; ++t) lets += change_of_lets(t->kind);
  if (line != first && begins_next(line)) return line;
  for (const Token* t = line; t < where; ++t) lets += change_of_lets(t->kind);

  int braces = 0;
  for (const Token* t = where; t->kind != K::end_of_file; ++t) {
    lets += change_of_lets(t->kind);
    if (t->kind == K::left_brace) ++braces;
    if (t->kind == K::right_brace && --braces < 0 && in_timed_section) return t;
    if (t > where && !same_line(*(t - 1), *t, sources) && begins_next(t)) return t;
  }
  while (where->kind != K::end_of_file) ++where;
  return where;
}

const Token* first_of_line(const Token* first, const Token* where, const base::SourceMap& sources) {
  const Token* t = where;
  while (t > first && same_line(*(t - 1), *t, sources)) --t;
  return t;
}

}  // namespace perentie::parser

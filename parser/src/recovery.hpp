// Where to go on after a syntax error.
#pragma once

#include "perentie/base/source.hpp"
#include "perentie/parser/token.hpp"

namespace perentie::parser {

/// Where the next declaration probably begins: at the first line, that of `where` included, which
/// starts like one and stands no further right than the failed declaration, which began at `first`,
/// or is outside its `let`s. Also at the `}` that closes the timed section around it, if it stands
/// in one; otherwise at the end of the text.
const Token* recover(const Token* first, const Token* where, bool in_timed_section,
                     const base::SourceMap& sources);

/// The first token from `first` on that stands on the same line of the text as `where`.
const Token* first_of_line(const Token* first, const Token* where, const base::SourceMap& sources);

}  // namespace perentie::parser

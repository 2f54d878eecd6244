// Where to go on after a syntax error.
#pragma once

#include "perentie/base/source.hpp"
#include "perentie/parser/token.hpp"

namespace perentie::parser {

/// The token at or after `where` before which the next declaration probably begins: the newline in
/// front of a line that starts like one and stands no further right than the failed declaration,
/// which began at `first`, or is outside its `let`s. Also the `}` that closes the timed section
/// around it, if it stands in one; otherwise the end of the text.
const Token* recover(const Token* first, const Token* where, bool in_timed_section,
                     const base::SourceMap& sources);

}  // namespace perentie::parser

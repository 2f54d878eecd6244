// The lexer: a source text to tokens.
//
// Longest match, then the rules that need context: which newlines separate declarations, whether
// `<` and `>` are brackets, the words of `:[..]`, whole `include` and `print` lines (CSPM reference
// 1.1 - 1.6). It never fails: what cannot be read becomes an `error` token and a diagnostic.
#pragma once

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/interner.hpp"
#include "perentie/base/source.hpp"
#include "perentie/parser/token.hpp"

namespace perentie::parser {

/// The tokens of one file; includes stay `include_` tokens. Names and strings go into `names`.
TokenStream lex(base::FileId file, const base::SourceMap& sources, base::Interner& names,
                base::Diagnostics& diagnostics);

}  // namespace perentie::parser

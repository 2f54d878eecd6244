// A script and its includes as one stream of tokens.
//
// The tokens of an included file stand where the include was, between two newline tokens, so that
// no expression goes on across the boundary (CSPM reference 1.1.10, 2.8). A file that is included
// twice is read twice.
#pragma once

#include <functional>
#include <string>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/interner.hpp"
#include "perentie/base/source.hpp"
#include "perentie/parser/token.hpp"

namespace perentie::parser {

using Load = std::function<base::FileText(const std::string& path)>;

TokenStream lex_with_includes(base::FileId root, base::SourceMap& sources, base::Interner& names,
                              base::Diagnostics& diagnostics, const Load& load);

}  // namespace perentie::parser

// An expression or assertion that is all of a text.
#pragma once

#include <optional>

#include "builder/builder.hpp"

namespace perentie::parser {

/// None if there were errors, which the builder's diagnostics then hold.
ExprId read_whole_expression(Builder& builder);
std::optional<Assertion> read_whole_assertion(Builder& builder);

/// The tokens of a stretch of a text that is not read as a script of its own.
TokenStream lex_stretch(base::Span stretch, const base::SourceMap& sources, base::Interner& names,
                        base::Diagnostics& diagnostics);

}  // namespace perentie::parser

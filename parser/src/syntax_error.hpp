// From "this was expected there" to a message that helps: what was found, the bracket that is still
// open, and what people usually mean when they write that.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "builder/builder.hpp"
#include "grammar/grammar.hpp"

namespace perentie::parser {

/// Runs a piece of grammar on the declaration that begins at `first`, then reports what it threw
/// and what is left of patterns. The result is where an exception arose, if one did. Either way the
/// builder is ready for the next declaration.
std::optional<const Token*> attempt(Builder& builder, const Token* first,
                                    const std::function<void()>& read);

/// Reports an error in the declaration that begins at `first`. Silent at unreadable text, which the
/// lexer has reported.
void report_syntax_error(const grammar::SyntaxError& error, const Token* first, bool in_let,
                         BuildContext& context);

}  // namespace perentie::parser

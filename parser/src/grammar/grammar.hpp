// The face of the grammar towards parse.cpp: no Boost in sight.
//
// Each function reads one thing from `first` on, calling the builder, and returns where it stopped.
// The tokens end with `end_of_file`. They throw SyntaxError, TooDeep or Abandoned, and leave the
// builder to be `abandon`ed then.
#pragma once

#include <string>

#include "builder/builder.hpp"
#include "perentie/parser/token.hpp"

namespace perentie::parser::grammar {

struct SyntaxError {
  const Token* where;
  std::string expected;  ///< such as "an expression" or "`)`"
};

struct ModuleHead {
  Identifier name;
  PatternList parameters;
};

/// One declaration that is neither a block, an include nor a print line.
const Token* parse_declaration(const Token* first, const Token* last, Builder& b);
/// An assertion without the word `assert`.
const Token* parse_assertion(const Token* first, const Token* last, Builder& b);
const Token* parse_expression(const Token* first, const Token* last, Builder& b, ExprId& result);
/// `module M(p, ..)` with the newline after it.
const Token* parse_module_head(const Token* first, const Token* last, Builder& b,
                               ModuleHead& result);
/// `Timed (f) {`
const Token* parse_timed_head(const Token* first, const Token* last, Builder& b, ExprId& result);

}  // namespace perentie::parser::grammar

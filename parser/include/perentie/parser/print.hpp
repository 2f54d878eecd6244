// The pretty printer: syntax tree to CSPM text.
//
// Parentheses are those that the operator table makes necessary. Printed text parses back to the
// same tree. Short things stay on one line; what is longer is broken where CSPM lets a line end.
#pragma once

#include <cstddef>
#include <string>

#include "perentie/parser/ast.hpp"

namespace perentie::parser {

struct PrintOptions {
  /// Lines are kept within so many columns where possible; 0: no line is broken that need not be.
  std::size_t width = 100;
};

/// The whole script, with a newline at its end unless it is empty. Includes stay spliced in.
std::string print_script(const SyntaxTree& tree, const PrintOptions& options = {});

// Single parts, without a newline at the end.
std::string print(const SyntaxTree& tree, ExprId expression, const PrintOptions& options = {});
std::string print(const SyntaxTree& tree, PatternId pattern, const PrintOptions& options = {});
std::string print(const SyntaxTree& tree, TypeId type, const PrintOptions& options = {});
std::string print(const SyntaxTree& tree, DeclId declaration, const PrintOptions& options = {});
/// Without the word `assert`, as tools name an assertion: `not P :[deadlock free [F]]` (2.6.10).
std::string print(const SyntaxTree& tree, const Assertion& assertion,
                  const PrintOptions& options = {});

}  // namespace perentie::parser

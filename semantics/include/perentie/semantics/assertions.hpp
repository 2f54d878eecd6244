// The assertions and prints of a script, as data for whoever checks them (CSPM reference 2.6, 2.7).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "perentie/base/source.hpp"
#include "perentie/parser/ast.hpp"

namespace perentie::semantics {

struct ScriptAssertion {
  std::string text;  ///< as tools name it: without `assert`
  base::Span span;
  parser::Assertion assertion;
  parser::DeclId timed_section = {};  ///< the innermost around it, if there is one
};

struct ScriptPrint {
  std::string text;
  base::Span span;
  parser::ExprId expression;  ///< none: the text does not parse, which was a warning
};

/// Those of a tree in the order of the script, timed sections included.
std::vector<ScriptAssertion> assertions_of(const parser::SyntaxTree& tree);
std::vector<ScriptPrint> prints_of(const parser::SyntaxTree& tree);

}  // namespace perentie::semantics

// A second copy of a declaration in the same tree, with nodes of its own.
//
// A module's instance is a copy of the module: side tables are by node id, so what an instance's
// names stand for, and what its types are, does not depend on other instances (2.9.6).
#pragma once

#include "perentie/parser/ast.hpp"

namespace perentie::parser {

/// Copies a declaration with everything in it; spans and names are those of the original.
/// References into the tree's stores and lists are invalid afterwards, ids are not.
DeclId copy_declaration(SyntaxTree& tree, DeclId declaration);

}  // namespace perentie::parser

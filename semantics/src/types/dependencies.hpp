// Groups of declarations that refer to each other: the strongly connected components, each after
// those that it refers to (CSPM reference 3.1.8).
#pragma once

#include <vector>

#include "perentie/parser/ast.hpp"
#include "perentie/semantics/symbols.hpp"

namespace perentie::semantics {

/// The symbols that a declaration gives.
std::vector<SymbolId> defined_symbols(const parser::SyntaxTree& tree, const Resolution& resolution,
                                      parser::DeclId decl);

/// Indices into `decls`; those of one group refer to each other. What declares types comes first in
/// its group, otherwise the order is that of `decls`.
std::vector<std::vector<std::uint32_t>> dependency_groups(const parser::SyntaxTree& tree,
                                                          const Resolution& resolution,
                                                          std::span<const parser::DeclId> decls);

}  // namespace perentie::semantics

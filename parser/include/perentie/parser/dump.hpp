// Dumps of tokens and trees, and the comparison of trees.
//
// A dump has one token or node a line, with its position, and depends on nothing but the input:
// `perentie dump --phase tokens|ast` prints it, golden tests compare it.
#pragma once

#include <string>

#include "perentie/base/interner.hpp"
#include "perentie/base/source.hpp"
#include "perentie/parser/ast.hpp"
#include "perentie/parser/token.hpp"

namespace perentie::parser {

/// `line:col kind text` for each token.
std::string dump_tokens(const TokenStream& stream, const base::Interner& names,
                        const base::SourceMap& sources);

/// `kind details @line:col` for each node, children indented below it. Nodes of other files than
/// the first are given with the name of theirs.
std::string dump_ast(const SyntaxTree& tree, const base::SourceMap& sources);
std::string dump_ast(const SyntaxTree& tree, ExprId expression, const base::SourceMap& sources);
std::string dump_ast(const SyntaxTree& tree, const Assertion& assertion,
                     const base::SourceMap& sources);

/// Whether two scripts, expressions or assertions are the same but for where they stand.
bool same_tree(const SyntaxTree& a, const SyntaxTree& b);
bool same_tree(const SyntaxTree& a, ExprId in_a, const SyntaxTree& b, ExprId in_b);
bool same_tree(const SyntaxTree& a, const Assertion& in_a, const SyntaxTree& b,
               const Assertion& in_b);

}  // namespace perentie::parser

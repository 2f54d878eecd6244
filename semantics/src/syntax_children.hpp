// The nodes directly below a node of the syntax tree, in the order in which types are inferred:
// what binds variables comes before what uses them.
#pragma once

#include <cstdint>
#include <vector>

#include "perentie/parser/ast.hpp"

namespace perentie::semantics {

struct SyntaxNode {
  enum class Kind : std::uint8_t { expr, pattern, statement, field, decl, clause };
  Kind kind;
  std::uint32_t id;         // of a clause: its function's declaration
  std::uint32_t index = 0;  // of a clause: its place
};

/// Appends the children. Modules and instances have none here: their members are declarations of
/// their own.
void append_children(const parser::SyntaxTree& tree, SyntaxNode node,
                     std::vector<SyntaxNode>& children);

}  // namespace perentie::semantics

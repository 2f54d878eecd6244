// Which definitions are processes: decides which calls become named states (CSPM reference 3.8.1).
#pragma once

#include "perentie/parser/ast.hpp"
#include "perentie/semantics/symbols.hpp"

namespace perentie::semantics {

/// Marks `is_process` on the constants and functions whose (final) value is a process, as far as
/// the shape of the script shows it: a definition is one if some branch of it is a process
/// expression, a process, or a call of one, or if it stands where only a process can stand. To be
/// called whenever declarations were added and resolved.
void mark_processes(const parser::SyntaxTree& tree, Resolution& resolution);

}  // namespace perentie::semantics

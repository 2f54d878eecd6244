// Random syntax trees of every shape that a script can have.
//
// A tree is made from a list of numbers, its choices; when they run out, everything left is a leaf.
// So a property draws a list of numbers, and a shorter list with smaller numbers is a simpler tree.
#pragma once

#include <cstdint>
#include <vector>

#include "perentie/parser/ast.hpp"

namespace perentie::parser {

/// A script; no two declarations of one list define the same function, which would merge.
SyntaxTree random_script(const std::vector<std::uint32_t>& choices);

}  // namespace perentie::parser

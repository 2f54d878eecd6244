// A uniform view of the tree: for every node a label that says all but its children and its place,
// and the children in the order of the text. Dumps print it, comparison compares it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "perentie/parser/ast.hpp"

namespace perentie::parser {

/// The script itself is std::monostate.
using NodeRef = std::variant<std::monostate, ExprId, PatternId, StatementId, FieldId, TypeId,
                             DeclId, const Clause*, const Constructor*, const Assertion*>;

struct Child {
  std::string_view role;  ///< empty where the order says enough
  NodeRef node;
};

struct NodeView {
  std::string label;
  std::optional<Span> span;
  std::vector<Child> children;
};

/// Views hold pointers into the tree's lists: the tree must not grow meanwhile.
NodeView view(const SyntaxTree& tree, const NodeRef& node);

}  // namespace perentie::parser

// The names in a pattern, from left to right.
#pragma once

#include <vector>

#include "perentie/base/overload.hpp"
#include "perentie/parser/ast.hpp"

namespace perentie::semantics {

/// Calls `visit(PatternId, const NamePattern&)` for every name in a pattern. Dots and `^` may chain
/// without bound, so the walk has its own stack.
template <class Visit>
void for_each_name(const parser::SyntaxTree& tree, parser::PatternId root, Visit visit) {
  std::vector<parser::PatternId> stack{root};
  const auto push = [&](parser::PatternList list) {
    const auto items = tree.list(list);
    stack.insert(stack.end(), items.rbegin(), items.rend());
  };
  const auto push_two = [&](parser::PatternId left, parser::PatternId right) {
    stack.push_back(right);
    stack.push_back(left);
  };
  while (!stack.empty()) {
    const parser::PatternId id = stack.back();
    stack.pop_back();
    std::visit(base::overload{
                   [&](const parser::NamePattern& p) { visit(id, p); },
                   [&](const parser::TuplePattern& p) { push(p.items); },
                   [&](const parser::SequencePattern& p) { push(p.items); },
                   [&](const parser::SetPattern& p) { push(p.items); },
                   [&](const parser::ConcatPattern& p) { push_two(p.left, p.right); },
                   [&](const parser::DotPattern& p) { push_two(p.left, p.right); },
                   [&](const parser::DoublePattern& p) { push_two(p.left, p.right); },
                   [](const auto&) {},
               },
               tree.patterns[id].node);
  }
}

}  // namespace perentie::semantics

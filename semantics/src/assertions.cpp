#include "perentie/semantics/assertions.hpp"

#include "perentie/parser/print.hpp"

namespace perentie::semantics {
namespace {

// Calls `visit` for every declaration at the top level and in timed sections (2.6.9).
template <class Visit>
void for_each_declaration(const parser::SyntaxTree& tree, parser::DeclList list, bool is_timed,
                          Visit visit) {
  for (const parser::DeclId id : tree.list(list)) {
    const parser::Decl& decl = tree.decls[id];
    visit(decl, is_timed);
    if (const auto* timed = std::get_if<parser::TimedDecl>(&decl.node)) {
      for_each_declaration(tree, timed->declarations, true, visit);
    }
  }
}

}  // namespace

std::vector<ScriptAssertion> assertions_of(const parser::SyntaxTree& tree) {
  std::vector<ScriptAssertion> found;
  for_each_declaration(tree, tree.declarations, false, [&](const parser::Decl& decl, bool timed) {
    const auto* d = std::get_if<parser::AssertDecl>(&decl.node);
    if (d == nullptr) return;
    found.push_back(
        {parser::print(tree, d->assertion, {.width = 0}), decl.span, d->assertion, timed});
  });
  return found;
}

std::vector<ScriptPrint> prints_of(const parser::SyntaxTree& tree) {
  std::vector<ScriptPrint> found;
  for_each_declaration(tree, tree.declarations, false, [&](const parser::Decl& decl, bool) {
    const auto* d = std::get_if<parser::PrintDecl>(&decl.node);
    if (d != nullptr) {
      found.push_back({std::string(tree.names[d->text]), decl.span, d->expression});
    }
  });
  return found;
}

}  // namespace perentie::semantics

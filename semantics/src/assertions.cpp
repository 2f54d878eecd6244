#include "perentie/semantics/assertions.hpp"

#include "perentie/parser/print.hpp"

namespace perentie::semantics {
namespace {

// Calls `visit` for every declaration at the top level and in timed sections (2.6.9).
template <class Visit>
void for_each_declaration(const parser::SyntaxTree& tree, parser::DeclList list,
                          parser::DeclId timed_section, Visit visit) {
  for (const parser::DeclId id : tree.list(list)) {
    const parser::Decl& decl = tree.decls[id];
    visit(decl, timed_section);
    if (const auto* timed = std::get_if<parser::TimedDecl>(&decl.node)) {
      for_each_declaration(tree, timed->declarations, id, visit);
    }
  }
}

}  // namespace

std::vector<ScriptAssertion> assertions_of(const parser::SyntaxTree& tree) {
  std::vector<ScriptAssertion> found;
  for_each_declaration(tree, tree.declarations, {},
                       [&](const parser::Decl& decl, parser::DeclId timed_section) {
                         const auto* d = std::get_if<parser::AssertDecl>(&decl.node);
                         if (d == nullptr) return;
                         found.push_back({parser::print(tree, d->assertion, {.width = 0}),
                                          decl.span, d->assertion, timed_section});
                       });
  return found;
}

std::vector<ScriptPrint> prints_of(const parser::SyntaxTree& tree) {
  std::vector<ScriptPrint> found;
  for_each_declaration(tree, tree.declarations, {}, [&](const parser::Decl& decl, parser::DeclId) {
    const auto* d = std::get_if<parser::PrintDecl>(&decl.node);
    if (d != nullptr) {
      found.push_back({std::string(tree.names[d->text]), decl.span, d->expression});
    }
  });
  return found;
}

}  // namespace perentie::semantics

#include "dependencies.hpp"

#include <algorithm>
#include <unordered_map>

#include "../pattern_names.hpp"
#include "../syntax_children.hpp"
#include "perentie/base/overload.hpp"
#include "perentie/lts/strong_components.hpp"

namespace perentie::semantics {
namespace {

using base::overload;
using parser::DeclId;
using parser::ExprId;
using parser::PatternId;

// Calls `visit` for every symbol that a declaration mentions.
template <class Visit>
void for_each_reference(const parser::SyntaxTree& tree, const Resolution& resolution, DeclId decl,
                        Visit visit) {
  std::vector<SyntaxNode> stack{{SyntaxNode::Kind::decl, decl.value}};
  while (!stack.empty()) {
    const SyntaxNode node = stack.back();
    stack.pop_back();
    SymbolId symbol;
    if (node.kind == SyntaxNode::Kind::expr) symbol = resolution.of_expr[node.id];
    if (node.kind == SyntaxNode::Kind::pattern) symbol = resolution.of_pattern[node.id];
    if (symbol) visit(symbol);
    if (node.kind == SyntaxNode::Kind::decl) {
      const auto* d = std::get_if<parser::DatatypeDecl>(&tree.decls[DeclId{node.id}].node);
      if (d != nullptr && d->is_subtype) {
        for (const SymbolId constructor : resolution.members.at(node.id)) visit(constructor);
      }
    }
    append_children(tree, node, stack);
  }
}

bool declares_types(const parser::Decl& decl) {
  return std::holds_alternative<parser::ChannelDecl>(decl.node) ||
         std::holds_alternative<parser::DatatypeDecl>(decl.node) ||
         std::holds_alternative<parser::NametypeDecl>(decl.node);
}

}  // namespace

std::vector<SymbolId> defined_symbols(const parser::SyntaxTree& tree, const Resolution& resolution,
                                      DeclId decl) {
  std::vector<SymbolId> symbols;
  const auto members = [&] {
    const auto found = resolution.members.find(decl.value);
    if (found != resolution.members.end()) symbols = found->second;
  };
  std::visit(overload{
                 [&](const parser::PatternDecl& d) {
                   for_each_name(tree, d.pattern, [&](PatternId id, const parser::NamePattern&) {
                     const SymbolId symbol = resolution.of_pattern[id.value];
                     if (symbol && resolution.symbols[symbol].kind == SymbolKind::constant) {
                       symbols.push_back(symbol);
                     }
                   });
                 },
                 [&](const parser::FunctionDecl&) { symbols = {resolution.of_decl[decl.value]}; },
                 [&](const parser::ChannelDecl&) { members(); },
                 [&](const parser::DatatypeDecl& d) {
                   if (!d.is_subtype) members();
                   symbols.push_back(resolution.of_decl[decl.value]);
                 },
                 [&](const parser::NametypeDecl&) { symbols = {resolution.of_decl[decl.value]}; },
                 [](const auto&) {},
             },
             tree.decls[decl].node);
  return symbols;
}

std::vector<std::vector<std::uint32_t>> dependency_groups(const parser::SyntaxTree& tree,
                                                          const Resolution& resolution,
                                                          std::span<const DeclId> decls) {
  std::unordered_map<std::uint32_t, std::uint32_t> definer;  // by SymbolId
  for (std::uint32_t i = 0; i < decls.size(); ++i) {
    for (const SymbolId symbol : defined_symbols(tree, resolution, decls[i])) {
      definer.emplace(symbol.value, i);
    }
  }
  std::vector<std::vector<std::uint32_t>> successors(decls.size());
  for (std::uint32_t i = 0; i < decls.size(); ++i) {
    for_each_reference(tree, resolution, decls[i], [&](SymbolId symbol) {
      const auto found = definer.find(symbol.value);
      if (found != definer.end()) successors[i].push_back(found->second);
    });
  }
  std::vector<std::vector<std::uint32_t>> groups = lts::strong_components(successors);
  for (auto& group : groups) {
    std::stable_partition(group.begin(), group.end(),
                          [&](std::uint32_t i) { return declares_types(tree.decls[decls[i]]); });
  }
  return groups;
}

}  // namespace perentie::semantics

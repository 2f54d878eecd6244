// The public steps of type inference.
#include "dependencies.hpp"
#include "inference.hpp"

namespace perentie::semantics {

using NodeKind = SyntaxNode::Kind;

TypeChecker::TypeChecker(const parser::SyntaxTree& tree, const Resolution& resolution)
    : impl_(std::make_unique<Impl>(tree, resolution)) {}

TypeChecker::~TypeChecker() = default;

void TypeChecker::declare(parser::DeclList signatures, base::Diagnostics& diagnostics) {
  Impl& impl = *impl_;
  const parser::SyntaxTree& tree = impl.tree;
  const Resolution& resolution = impl.resolution;
  impl.diagnostics = &diagnostics;
  impl.make_room();
  std::unordered_map<std::string_view, SymbolId> builtins;
  for (std::uint32_t i = 0; i < resolution.symbols.size(); ++i) {
    const Symbol& symbol = resolution.symbols[SymbolId{i}];
    const bool is_builtin = symbol.kind == SymbolKind::builtin ||
                            (symbol.kind == SymbolKind::unsupported && !symbol.decl);
    if (is_builtin) builtins.emplace(tree.names[symbol.name], SymbolId{i});
  }
  for (const auto& [name, symbol] : resolution.prelude) builtins.insert_or_assign(name, symbol);
  for (const DeclId id : tree.list(signatures)) {
    const auto& d = std::get<parser::AnnotationDecl>(tree.decls[id].node);
    for (const parser::Identifier& name : tree.list(d.names)) {
      const auto found = builtins.find(tree.names[name.name]);
      if (found == builtins.end()) continue;
      Impl::TypeVariables variables;
      impl.of_symbol[found->second.value] = impl.annotated_type(d, variables);
    }
  }
}

void TypeChecker::check_declarations(parser::DeclList declarations,
                                     base::Diagnostics& diagnostics) {
  impl_->diagnostics = &diagnostics;
  impl_->make_room();
  std::vector<Impl::Item> items;
  impl_->collect(declarations, 0, {}, items);
  for (const Impl::Item& item : items) {
    const auto symbols = defined_symbols(impl_->tree, impl_->resolution, item.decl);
    impl_->top_level.insert(impl_->top_level.end(), symbols.begin(), symbols.end());
  }
  impl_->schedule_groups(items, true);
  impl_->run();
}

bool TypeChecker::check_expression(ExprId expr, base::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  impl_->diagnostics = &diagnostics;
  impl_->make_room();
  impl_->tasks.push_back({Impl::Task::Kind::enter, {NodeKind::expr, expr.value}});
  impl_->run();
  impl_->settle_pending_dots();
  return diagnostics.error_count() == errors;
}

bool TypeChecker::check_process(ExprId expr, base::Diagnostics& diagnostics) {
  return check_expression(expr, diagnostics) && impl_->expect(expr, impl_->types.process());
}

const std::vector<SymbolId>& TypeChecker::top_level() const { return impl_->top_level; }

std::string TypeChecker::show(ExprId expr) const { return impl_->text(impl_->type(expr), true); }

std::optional<std::string> TypeChecker::show(SymbolId symbol) const {
  if (symbol.value >= impl_->of_symbol.size()) return std::nullopt;
  const TypeRef type = impl_->of_symbol[symbol.value].type;
  if (!type) return std::nullopt;
  return impl_->text(type, true);
}

bool TypeChecker::is_process(SymbolId symbol) const {
  if (symbol.value >= impl_->of_symbol.size()) return false;
  TypeStore& types = impl_->types;
  TypeRef type = impl_->of_symbol[symbol.value].type;
  if (!type) return false;
  type = types.find(type);
  for (std::uint32_t i = 0; i < impl_->resolution.symbols[symbol].groups; ++i) {
    if (types.kind(type) != TypeKind::function) return false;
    type = types.find(types.children(type).back());
  }
  return types.kind(type) == TypeKind::process;
}

}  // namespace perentie::semantics

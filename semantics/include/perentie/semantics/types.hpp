// Step 4: the types of a script, inferred before anything of it is evaluated (CSPM reference 3.1).
//
// Definitions are taken by strongly connected components in the order of their dependencies; those
// at the top level, and annotated ones anywhere, are polymorphic. An error makes what it concerns
// agree with everything, so that it is reported once.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/parser/ast.hpp"
#include "perentie/semantics/symbols.hpp"

namespace perentie::semantics {

class TypeChecker {
 public:
  /// The tree and the resolution may grow between calls.
  TypeChecker(const parser::SyntaxTree& tree, const Resolution& resolution);
  ~TypeChecker();
  /// Gives the built-ins the types that annotations say, by name.
  void declare(parser::DeclList signatures, base::Diagnostics& diagnostics);

  /// Infers the types of declarations; errors are T-codes.
  void check_declarations(parser::DeclList declarations, base::Diagnostics& diagnostics);
  /// Infers the type of an expression. False after an error.
  bool check_expression(parser::ExprId expr, base::Diagnostics& diagnostics);
  /// The same of an expression that has to be a process.
  bool check_process(parser::ExprId expr, base::Diagnostics& diagnostics);

  /// What the declarations define at their top level and in their modules, in order.
  const std::vector<SymbolId>& top_level() const;
  /// Types as FDR prints them, such as `Eq a => (a, {a}) -> Bool`.
  std::string show(parser::ExprId expr) const;
  /// Nothing for a symbol that has no type, such as a module.
  std::optional<std::string> show(SymbolId symbol) const;
  /// Whether the value of a constant, or the final result of a function, is a process.
  bool is_process(SymbolId symbol) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace perentie::semantics

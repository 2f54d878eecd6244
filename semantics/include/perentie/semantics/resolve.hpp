// Step 3: from a syntax tree to the symbols that its names stand for.
#pragma once

#include <memory>

#include "perentie/base/diagnostic.hpp"
#include "perentie/parser/ast.hpp"
#include "perentie/semantics/symbols.hpp"

namespace perentie::semantics {

/// Resolves a script, and afterwards expressions in the script's scope. The tree may grow between
/// calls (an expression typed by a user is parsed into it); nodes already there do not change.
class Resolver {
 public:
  /// Opens the scope of the built-ins, whose names it interns.
  explicit Resolver(parser::SyntaxTree& tree);
  ~Resolver();

  /// Resolves the prelude in the scope of the built-ins. To be called first.
  void resolve_prelude(parser::DeclList declarations, base::Diagnostics& diagnostics);
  /// Resolves the declarations of a script; errors are N-codes (CSPM reference 2.1-2.9).
  void resolve_script(parser::DeclList declarations, base::Diagnostics& diagnostics);
  /// Resolves one expression in the script's scope.
  void resolve_expression(parser::ExprId expr, base::Diagnostics& diagnostics);

  const Resolution& result() const;
  Resolution& result();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace perentie::semantics

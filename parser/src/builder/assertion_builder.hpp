// Assertions: a claim about processes and its options (CSPM reference 2.6).
#pragma once

#include <optional>

#include "builder/context.hpp"

namespace perentie::parser {

class AssertionBuilder {
 public:
  explicit AssertionBuilder(BuildContext& context) : context_(&context) {}

  void begin(std::optional<const Token*> negation, ExprId process);
  void refinement(const Token* sign, ExprId implementation);
  void property(const Token* word, std::optional<const Token*> parameter);
  void trace(const Token* word, std::optional<const Token*> parameter, ExprList trace);
  void tau_priority(const Token* word, ExprId set);
  void reduction(const Token* word, std::optional<const Token*> parameter);
  /// A property where only an option may stand.
  void second_property(const Token* word);

  const Assertion& finished() const { return assertion_; }

 private:
  void once(bool given, const Token* word);
  std::optional<Model> model(std::optional<const Token*> parameter);

  BuildContext* context_;
  ExprId process_;
  Assertion assertion_{};
};

}  // namespace perentie::parser

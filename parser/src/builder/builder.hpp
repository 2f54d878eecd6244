// All that the grammar's actions call, and how a declaration is begun and given up.
#pragma once

#include "builder/assertion_builder.hpp"
#include "builder/context.hpp"
#include "builder/conversion.hpp"
#include "builder/declaration_builder.hpp"
#include "builder/operator_run.hpp"
#include "builder/type_builder.hpp"

namespace perentie::parser {

struct Builder {
  explicit Builder(BuildContext build_context)
      : context(std::move(build_context)),
        converter(context),
        expressions(context, converter),
        types(context),
        declarations(context, converter),
        assertions(context) {}
  Builder(const Builder&) = delete;  // its parts refer to `context`
  Builder& operator=(const Builder&) = delete;

  /// Forgets everything unfinished but the declarations: after an error, or before something new.
  void abandon() {
    context.scratch.clear();
    context.depth = 0;
    converter.clear();
    expressions.clear();
    types.clear();
    declarations.leave_all_lets();
  }

  BuildContext context;
  Converter converter;
  ExpressionBuilder expressions;
  TypeBuilder types;
  DeclarationBuilder declarations;
  AssertionBuilder assertions;
};

}  // namespace perentie::parser

// Declarations: made one by one, then gathered into the list of their script, module, timed section
// or `let`, where consecutive clauses of one function become one declaration (CSPM reference 2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "builder/context.hpp"
#include "builder/conversion.hpp"

namespace perentie::parser {

/// What follows the left side of a definition: `= value`, or `, n2, n3 :: constraints => type`.
struct DefinitionRest {
  ExprId value;  ///< none: an annotation
  IdentifierList more_names;
  ListRef<Constraint> constraints;
  TypeId type;
};

/// An annotated type with its constraints.
struct AnnotatedType {
  ListRef<Constraint> constraints;
  TypeId type;
};

/// The blocks around a declaration, as far as they restrict it (2.6.9, 2.7, 2.9.2).
enum class Place : std::uint8_t { script, timed_section, module };

class DeclarationBuilder {
 public:
  DeclarationBuilder(BuildContext& context, Converter& converter)
      : context_(&context), converter_(&converter) {}

  struct Mark {
    std::size_t declarations, clauses;
  };
  Mark mark() const { return {declarations_.size(), clauses_.size()}; }
  /// Moves the declarations made since the mark into the tree.
  DeclList take(Mark mark);
  void drop(Mark mark);

  void set_place(Place place) { place_ = place; }
  bool in_let() const { return let_depth_ > 0; }
  void enter_let() { ++let_depth_; }
  void leave_let() { --let_depth_; }
  void leave_all_lets() { let_depth_ = 0; }

  void definition(ExprId left, DefinitionRest rest);
  void channel(const Token* keyword, IdentifierList names, std::optional<ExprId> type);
  Constructor constructor(const Token* name, std::optional<ExprId> type) const;
  void datatype(const Token* keyword, const Token* name, ListRef<Constructor> constructors);
  void nametype(const Token* keyword, const Token* name, ExprId type);
  void import(const Token* keyword, IdentifierList names);
  void instance(const Token* keyword, const Token* name, const Token* module_first,
                QualifiedName module, std::optional<ExprList> arguments);
  void assertion(const Token* keyword, const Assertion& assertion);
  void print(const Token* token, ExprId expression);
  void timed(Span span, ExprId duration, DeclList declarations);
  void module(Span span, Identifier name, PatternList parameters, DeclList hidden,
              DeclList exported);
  /// Of the declaration made last.
  void set_span(Span span);

 private:
  void declare(Decl decl);
  void define_function(ExprId left, ExprId value);
  void annotate(ExprId left, const DefinitionRest& rest);
  std::optional<Identifier> plain_name(ExprId e, std::string_view purpose);
  DeclId take_function(std::size_t first, std::size_t last);
  bool continues(const Decl& first, const Decl& next) const;
  void check_annotated_channels(std::size_t first);

  BuildContext* context_;
  Converter* converter_;
  std::vector<Decl> declarations_;  // a function here has one clause, an index into `clauses_`
  std::vector<Clause> clauses_;
  std::uint32_t let_depth_ = 0;
  Place place_ = Place::script;
};

}  // namespace perentie::parser

// From expressions to patterns, communication fields and statements.
//
// A parser cannot know in advance whether `f(x, <y>)` begins a definition or is an expression, so
// patterns, fields and generators are read as expressions and converted here (CSPM reference 1.9,
// 3.5, 4.3). Nodes that only a pattern, field or generator may contain are *suspects* until one
// takes them; who is left at the end of a declaration is reported.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "builder/context.hpp"

namespace perentie::parser {

/// An expression in a run, with the parentheses around it.
struct Operand {
  ExprId expr;
  Span span;
};

class Converter {
 public:
  explicit Converter(BuildContext& context) : context_(&context) {}

  PatternId pattern(ExprId e);
  /// `e <- source`, or for lack of a source: `e` is itself `p : S`, or a filter.
  StatementId statement(ExprId e, std::optional<ExprId> source);

  /// `left ? right` and its like: a communication, or one more field of the one on the left.
  ExprId communication(FieldKind kind, Span token, Operand left, Operand right);
  /// The fields of a communication that `->` takes.
  FieldList take_fields(ExprId communication);

  /// For nodes just made.
  void suspect(ExprId e) { suspects_.push_back({e, false}); }
  void report_suspects();
  void clear();

 private:
  struct Suspect {
    ExprId expr;
    bool acquitted;
  };

  PatternId convert(ExprId e);
  PatternId convert_negation(ExprId e);
  PatternId convert_collection(ExprId e);
  PatternId convert_infix(ExprId e);
  PatternId convert_dots(ExprId e);
  PatternId convert_concat(ExprId e);
  PatternList convert_all(ExprList items);
  PatternId refuse(const base::DiagnosticCode& code, Span span, std::string message);
  unsigned variable_parts(PatternId p) const;

  void add_field(FieldKind kind, Span token, ExprId component, bool in_parentheses);
  std::optional<ExprId> restricting_set(ExprId& component);
  void acquit(ExprId e);

  const Expr& at(ExprId e) const { return context_->tree.exprs[e]; }
  template <class Node>
  PatternId add(Span span, Node node) {
    return context_->tree.patterns.add({span, std::move(node)});
  }

  BuildContext* context_;
  std::vector<Suspect> suspects_;  // in the order of their ids
  std::vector<FieldId> fields_;    // of the communications that no `->` has taken yet
  bool in_field_ = false;
  bool refused_ = false;      // the pattern being converted has been reported
  bool any_refused_ = false;  // or another one of this declaration
};

/// Whether parentheses stood around the first or last operand of an infix node. Spans tell: that of
/// the node covers the parentheses, that of the operand does not.
bool left_in_parentheses(const SyntaxTree& tree, ExprId node, ExprId left);
bool right_in_parentheses(const SyntaxTree& tree, ExprId node, ExprId right);

}  // namespace perentie::parser

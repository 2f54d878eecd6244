// Expressions as runs: operands with prefix and infix operators between them, folded by the
// operator table while they are read.
//
// A pending operator is a node whose operands are still missing. An infix operator first completes
// all pending ones that bind tighter, or as tight and to the left; a prefix operator waits for what
// follows it. So `if c then t else`, `let .. within`, `\x @` and `[] s @` are prefix operators at
// the loosest levels: they reach as far right as possible by being completed last (CSPM
// reference 1.7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "builder/context.hpp"
#include "builder/conversion.hpp"
#include "perentie/parser/operators.hpp"

namespace perentie::parser {

/// `..` and what follows it in a range.
struct RangeEnd {
  ExprId last;  ///< none: unbounded
};

/// What follows `P [A` or `P [a`: `|| B]`, or `<-> b, .. | statements]`.
struct BracketRest {
  ExprId alphabet;  ///< B; none: it is a link
  ExprId first_to;  ///< b
  ExprList more_ties;
  std::optional<StatementList> statements;
};

class ExpressionBuilder {
 public:
  ExpressionBuilder(BuildContext& context, Converter& converter)
      : context_(&context), converter_(&converter) {}

  /// Where the operators of a run begin; runs nest.
  struct Run {
    std::size_t operands, operators, outer_base;
    std::uint32_t depth;
    bool outer_complained;
  };
  Run begin_run(const Token* first);
  ExprId end_run(const Run& run);
  void abandon_run(const Run& run);

  // Operands (operands.cpp)
  void operand(const Token* first, ExprId expr, const Token* last) {
    operands_.push_back({expr, cover(first, last)});
  }
  void apply(ExprList arguments, const Token* close);
  void rename(ExprList pairs, std::optional<StatementList> statements, const Token* close);
  ExprId name(QualifiedName name, const Token* last);
  ExprId literal(const Token* token);
  ExprId paren(const Token* open, ExprList items, const Token* close);
  ExprId map(const Token* open, ExprList pairs, const Token* close);
  ExprId collection(const Token* open, ExprList items, std::optional<RangeEnd> range,
                    std::optional<StatementList> statements, const Token* close);

  // Prefix operators
  void unary(const Token* op);
  void if_head(const Token* op, ExprId condition, ExprId then_branch);
  void let_head(const Token* op, DeclList declarations);
  void lambda_head(const Token* op, PatternList parameters);
  void replicated_head(const Token* op, StatementList statements);
  void alphabet_head(const Token* op, StatementList statements, ExprId alphabet);
  void bracket_head(const Token* op, ExprId alphabet, StatementList statements);
  void link_head(const Token* op, ExprList ties, std::optional<StatementList> tie_statements,
                 StatementList statements);

  // Infix operators
  void infix(const Token* op);
  void bracket_infix(const Token* open, ExprId alphabet, const Token* close);
  void square_infix(const Token* open, ExprId first, BracketRest rest);

  void clear();

 private:
  struct Operator {
    Expr node;  // its operands are still missing; its span is that of its first token
    std::uint8_t level;
    Associativity associativity;  // of infix operators
    bool is_prefix;
  };

  void push_prefix(const Token* op, std::uint8_t level, Expr node);
  void push_infix(InfixOp op, Expr node);
  void reduce();
  ExprId finish_infix(Expr node, Operand left, Operand right);
  ExprId finish_simple(InfixExpr infix, Span op, Operand left, Operand right);
  ExprId finish_prefix_arrow(Span span, Operand left, ExprId body);
  ExprId finish_hiding(InfixOp op, Span span, Operand left, Operand right);
  void warn_about_comparison(ExprId right);
  void complain_about_association(const Operator& first, const Operator& second);
  Ties ties(std::span<const ExprId> pairs, std::optional<StatementList> statements);

  BuildContext* context_;
  Converter* converter_;
  std::vector<Operand> operands_;
  std::vector<Operator> operators_;
  std::size_t base_ = 0;     // where the operators of the innermost run begin
  bool complained_ = false;  // about association, in the innermost run
};

}  // namespace perentie::parser

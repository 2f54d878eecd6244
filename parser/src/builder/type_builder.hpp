// Types in annotations: runs of operands and infix operators, folded as expressions are.
//
// `.` binds tighter than `=>` and `=>*`, and those tighter than `->`; all associate to the right
// (CSPM reference 1.8). The arguments of a function type are what one pair of parentheses holds.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "builder/context.hpp"

namespace perentie::parser {

class TypeBuilder {
 public:
  explicit TypeBuilder(BuildContext& context) : context_(&context) {}

  struct Run {
    std::size_t operands, operators, outer_base;
    std::uint32_t depth;
  };
  Run begin_run(const Token* first);
  TypeId end_run(const Run& run);
  void abandon_run(const Run& run);

  void name(QualifiedName name, const Token* last);
  void group(const Token* open, TypeList items, const Token* close);
  void set(const Token* open, TypeId element, const Token* close);
  void sequence(const Token* open, TypeId element, const Token* close);
  void map(const Token* open, TypeId key, TypeId value, const Token* close);
  void infix(const Token* op);

  Constraint constraint(const Token* constraint, const Token* variable);

  void clear();

 private:
  struct Operand {
    TypeId type;                    // none: `()`, good only for a function without arguments
    Span span;                      // with the parentheses
    std::optional<TypeList> group;  // what the parentheses hold, if the operand is nothing else
  };

  void reduce();
  TypeId type_of(const Operand& operand);
  template <class Node>
  TypeId add(Span span, Node node) {
    return context_->tree.types.add({span, node});
  }

  BuildContext* context_;
  std::vector<Operand> operands_;
  std::vector<const Token*> operators_;
  std::size_t base_ = 0;
};

}  // namespace perentie::parser

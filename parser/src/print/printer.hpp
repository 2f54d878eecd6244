// Printer: fills a Document from parts of the tree.
//
// A step replaces one task by the smaller tasks it consists of, on a stack of our own: trees may
// hold chains of any length. Where an expression stands decides about its parentheses: how loose an
// infix operator may be there, and which operator comes right after it, since `-`, `if` or `[] s @`
// would take that one into their operand.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "perentie/parser/ast.hpp"
#include "print/document.hpp"

namespace perentie::parser {

class Printer {
 public:
  Printer(const SyntaxTree& tree, Document& document) : tree_(tree), document_(document) {}

  void script();
  void print(ExprId e) { run(Task::expression(e, {})); }
  void print(PatternId p) { run(Task::pattern(p, {})); }
  void print(TypeId t) { run(Task::type(t, loosest)); }
  void print(DeclId d) { run(Task::declaration(d)); }
  void print(const Assertion& assertion);

 private:
  static constexpr std::uint8_t loosest = 255;
  static constexpr std::uint8_t no_operator = 255;

  /// Where in a run of operands an expression stands. At the start hiding needs no parentheses
  /// before an operator that gives way to it (1.7.7); what is to the right is indented when it is
  /// broken.
  enum class Side : std::uint8_t { start, left, right };

  /// Where an expression or pattern stands.
  struct Place {
    std::uint8_t level = loosest;            ///< the loosest operator that needs no parentheses
    std::uint8_t followed_by = no_operator;  ///< the level of the operator right after it
    bool in_sequence = false;                ///< directly inside `<..>`, where `>` is a bracket
    Side side = Side::start;
  };

  struct Task {
    enum class Kind : std::uint8_t {
      text,
      line,
      fill,
      hard_line,
      open_group,
      close_group,
      indent,
      dedent,
      expression,
      pattern,
      type,
      declaration,
    };
    Kind kind;
    Place place{};
    std::uint32_t id = 0;
    std::string_view text{};

    static Task expression(ExprId e, Place p) { return {Kind::expression, p, e.value, {}}; }
    static Task pattern(PatternId e, Place p) { return {Kind::pattern, p, e.value, {}}; }
    static Task type(TypeId t, std::uint8_t level) { return {Kind::type, {level}, t.value, {}}; }
    static Task declaration(DeclId d) { return {Kind::declaration, {}, d.value, {}}; }
  };

  // Tasks of the current step, in order of the text.
  void text(std::string_view t) { plan_.push_back({Task::Kind::text, {}, 0, t}); }
  void own(std::string t) { text(document_.keep(std::move(t))); }
  void mark(Task::Kind kind) { plan_.push_back({kind, {}, 0, {}}); }
  void line() { mark(Task::Kind::line); }
  void fill() { mark(Task::Kind::fill); }
  void hard_line() { mark(Task::Kind::hard_line); }
  void open_group() { mark(Task::Kind::open_group); }
  void close_group() { mark(Task::Kind::close_group); }
  void indent() { mark(Task::Kind::indent); }
  void dedent() { mark(Task::Kind::dedent); }
  void expression(ExprId e, Place p) { plan_.push_back(Task::expression(e, p)); }
  void pattern(PatternId p, Place place) { plan_.push_back(Task::pattern(p, place)); }
  void type(TypeId t, std::uint8_t level) { plan_.push_back(Task::type(t, level)); }
  void declaration(DeclId d) { plan_.push_back(Task::declaration(d)); }

  void run(const Task& task);
  void flush();
  void drain();
  void step(const Task& task);

  // print_expression.cpp
  void print_expression(ExprId e, Place place);
  void print_operand(const Expr& expr, Place place);
  void print_prefix_operator(const Expr& expr, Place place);
  void print_infix(ExprId e, Place place);
  void print_infix_operator(const Expr& expr, Place place);
  void print_communication(const PrefixExpr& prefix, Place place);
  void print_field(const Field& field, std::uint8_t followed_by, bool in_sequence);
  void print_items(std::span<const ExprId> items, bool in_sequence);
  void print_statements(StatementList statements, bool colon, bool in_sequence);
  void print_such_that(StatementList statements, bool in_sequence);
  void print_statement(StatementId s, bool colon, bool in_sequence);
  void print_ties(const Ties& ties, std::string_view arrow, bool in_sequence);
  void print_replicated(const ReplicatedExpr& e, Place place);
  bool fits_after_colon(ExprId e) const;

  // print_pattern.cpp
  void print_pattern(PatternId p, Place place);
  void print_patterns(std::span<const PatternId> items, bool in_sequence);

  // print_declaration.cpp
  void print_type(TypeId t, std::uint8_t level);
  void print_types(std::span<const TypeId> types);
  void print_declaration(DeclId d);
  void print_declarations(DeclList declarations);
  void print_function(const FunctionDecl& function);
  void print_value(ExprId value);
  void print_module(const ModuleDecl& module);
  void plan_assertion(const Assertion& assertion);
  void print_identifiers(std::span<const Identifier> names);
  bool begins_with_not(ExprId e) const;
  bool soaks_newline_before(PatternId p) const;

  void print_name(QualifiedName name);
  void print_operand_name(QualifiedName name);
  std::string_view name(NameId n) const { return tree_.names[n]; }

  const SyntaxTree& tree_;
  Document& document_;
  std::vector<Task> stack_;
  std::vector<Task> plan_;
};

std::string quote(char c);
std::string quote(std::string_view text);

}  // namespace perentie::parser

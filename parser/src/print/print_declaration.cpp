// Declarations, assertions and types.
#include "perentie/base/overload.hpp"
#include "perentie/parser/spelling.hpp"
#include "print/printer.hpp"

namespace perentie::parser {
namespace {

// The levels of types: `.`, then `=>` and `=>*`, then `->`; all to the right (1.8).
constexpr std::uint8_t level_dot = 1;
constexpr std::uint8_t level_yield = 2;
constexpr std::uint8_t level_function = 3;

}  // namespace

// ---------------------------------------------------------------------------------------------
// Declarations

void Printer::print_declarations(DeclList declarations) {
  bool first = true;
  for (const DeclId d : tree_.list(declarations)) {
    if (!first) hard_line();
    declaration(d);
    first = false;
  }
}

void Printer::print_declaration(DeclId d) {
  const auto separated = [&](std::string_view keyword, IdentifierList names) {
    text(keyword);
    print_identifiers(tree_.list(names));
  };
  std::visit(base::overload{
                 [&](const PatternDecl& n) {
                   const bool parentheses = soaks_newline_before(n.pattern);
                   if (parentheses) text("(");
                   pattern(n.pattern, {});
                   if (parentheses) text(")");
                   print_value(n.value);
                 },
                 [&](const FunctionDecl& n) { print_function(n); },
                 [&](const AnnotationDecl& n) {
                   separated("", n.names);
                   // `print` and a blank would begin a print line.
                   const bool is_print = name(tree_.list(n.names)[0].name) == "print";
                   text(is_print ? ":: " : " :: ");
                   const std::span<const Constraint> constraints = tree_.list(n.constraints);
                   if (!constraints.empty()) text("(");
                   for (std::size_t i = 0; i < constraints.size(); ++i) {
                     if (i > 0) text(", ");
                     text(name(constraints[i].constraint.name));
                     text(" ");
                     text(name(constraints[i].variable.name));
                   }
                   if (!constraints.empty()) text(") => ");
                   type(n.type, loosest);
                 },
                 [&](const ChannelDecl& n) {
                   separated("channel ", n.names);
                   if (!n.type) return;
                   text(" : ");
                   expression(n.type, {});
                 },
                 [&](const DatatypeDecl& n) {
                   open_group();
                   indent();
                   text(n.is_subtype ? "subtype " : "datatype ");
                   text(name(n.name.name));
                   text(" =");
                   bool first = true;
                   for (const Constructor& constructor : tree_.list(n.constructors)) {
                     if (!first) fill();
                     text(first ? " " : "| ");
                     text(name(constructor.name.name));
                     if (constructor.type) text(".");
                     if (constructor.type) expression(constructor.type, {});
                     first = false;
                   }
                   dedent();
                   close_group();
                 },
                 [&](const NametypeDecl& n) {
                   text("nametype ");
                   text(name(n.name.name));
                   print_value(n.type);
                 },
                 [&](const ImportDecl& n) {
                   separated(n.is_external ? "external " : "transparent ", n.names);
                 },
                 [&](const AssertDecl& n) {
                   text("assert ");
                   plan_assertion(n.assertion);
                 },
                 [&](const PrintDecl& n) {
                   text("print ");
                   text(name(n.text));
                 },
                 [&](const ModuleDecl& n) { print_module(n); },
                 [&](const InstanceDecl& n) {
                   text("instance ");
                   text(name(n.name.name));
                   text(" = ");
                   print_name(n.module);
                   if (n.arguments.empty()) return;
                   text("(");
                   print_items(tree_.list(n.arguments), false);
                   text(")");
                 },
                 [&](const TimedDecl& n) {
                   text("Timed ");
                   if (n.duration) {
                     text("(");
                     expression(n.duration, {});
                     text(") ");
                   }
                   text("{");
                   if (!n.declarations.empty()) {
                     indent();
                     hard_line();
                     print_declarations(n.declarations);
                     dedent();
                   }
                   hard_line();
                   text("}");
                 },
             },
             tree_.decls[d].node);
}

void Printer::print_function(const FunctionDecl& function) {
  bool first = true;
  for (const Clause& clause : tree_.list(function.clauses)) {
    if (!first) hard_line();
    text(name(function.name.name));
    std::span<const PatternId> parameters = tree_.list(clause.parameters);
    for (const std::uint32_t size : tree_.list(clause.group_sizes)) {
      text("(");
      print_patterns(parameters.first(size), false);
      text(")");
      parameters = parameters.subspan(size);
    }
    print_value(clause.body);
    first = false;
  }
}

/// ` = e`, on the same line or on lines of its own.
void Printer::print_value(ExprId value) {
  text(" =");
  open_group();
  indent();
  line();
  expression(value, {});
  dedent();
  close_group();
}

void Printer::print_module(const ModuleDecl& module) {
  const auto part = [&](DeclList declarations) {
    if (!declarations.empty()) {
      indent();
      hard_line();
      print_declarations(declarations);
      dedent();
    }
    hard_line();
  };
  text("module ");
  text(name(module.name.name));
  if (!module.parameters.empty()) {
    text("(");
    print_patterns(tree_.list(module.parameters), false);
    text(")");
  }
  part(module.private_declarations);
  text("exports");
  part(module.exported_declarations);
  text("endmodule");
}

void Printer::print_identifiers(std::span<const Identifier> names) {
  bool first = true;
  for (const Identifier& n : names) {
    if (!first) text(", ");
    text(name(n.name));
    first = false;
  }
}

// ---------------------------------------------------------------------------------------------
// Assertions

void Printer::plan_assertion(const Assertion& assertion) {
  const auto process = [&](ExprId e) {
    // A `not` that begins the expression would negate the assertion.
    const bool parentheses = !assertion.negated && begins_with_not(e);
    if (parentheses) text("(");
    expression(e, {});
    if (parentheses) text(")");
  };
  const auto with_model = [&](std::string_view property, std::optional<Model> model) {
    line();
    text(":[");
    text(property);
    if (model) {
      text(" [");
      text(spelling(*model));
      text("]");
    }
    text("]");
  };
  open_group();
  indent();
  if (assertion.negated) text("not ");
  std::visit(base::overload{
                 [&](const RefinementAssertion& n) {
                   process(n.specification);
                   line();
                   text("[");
                   text(spelling(n.model));
                   text("= ");
                   expression(n.implementation, {});
                 },
                 [&](const PropertyAssertion& n) {
                   process(n.process);
                   with_model(spelling(n.property), n.model);
                 },
                 [&](const HasTraceAssertion& n) {
                   process(n.process);
                   with_model(spelling(PropertyWord::has_trace), n.model);
                   text(": <");
                   print_items(tree_.list(n.trace), true);
                   text(">");
                 },
             },
             assertion.claim);
  if (assertion.options.tau_priority) {
    line();
    text(":[tau priority]: ");
    expression(assertion.options.tau_priority, {});
  }
  if (assertion.options.partial_order_reduce) {
    line();
    text(":[partial order reduce [");
    text(spelling(*assertion.options.partial_order_reduce));
    text("]]");
  }
  dedent();
  close_group();
}

bool Printer::begins_with_not(ExprId e) const {
  while (true) {
    const ExprId first = std::visit(base::overload{
                                        [](const InfixExpr& n) { return n.left; },
                                        [](const ParallelExpr& n) { return n.left; },
                                        [](const AlphabetParallelExpr& n) { return n.left; },
                                        [](const ExceptionExpr& n) { return n.left; },
                                        [](const SyncChoiceExpr& n) { return n.left; },
                                        [](const SyncInterruptExpr& n) { return n.left; },
                                        [](const LinkParallelExpr& n) { return n.left; },
                                        [](const PrefixExpr& n) { return n.channel; },
                                        [](const ApplyExpr& n) { return n.function; },
                                        [](const RenameExpr& n) { return n.process; },
                                        [](const auto&) { return ExprId{}; },
                                    },
                                    tree_.exprs[e].node);
    if (!first) return std::holds_alternative<NotExpr>(tree_.exprs[e].node);
    e = first;
  }
}

// ---------------------------------------------------------------------------------------------
// Types

void Printer::print_type(TypeId t, std::uint8_t place) {
  const auto infix = [&](std::uint8_t level, TypeId left, std::string_view op, TypeId right) {
    const bool parentheses = level > place;
    if (parentheses) text("(");
    type(left, static_cast<std::uint8_t>(level - 1));
    text(op);
    type(right, level);
    if (parentheses) text(")");
  };
  std::visit(
      base::overload{
          [&](const NamedType& n) { print_name(n.name); },
          [&](const SetType& n) {
            text("{");
            type(n.element, loosest);
            text("}");
          },
          [&](const SequenceType& n) {
            text("<");
            type(n.element, loosest);
            text(">");
          },
          [&](const TupleType& n) {
            text("(");
            print_types(tree_.list(n.items));
            text(")");
          },
          [&](const MapType& n) {
            text("(| ");
            type(n.key, level_dot);
            text(" => ");
            type(n.value, loosest);
            text(" |)");
          },
          [&](const DotType& n) { infix(level_dot, n.left, ".", n.right); },
          [&](const YieldType& n) { infix(level_yield, n.argument, " => ", n.result); },
          [&](const ExtendableType& n) { infix(level_yield, n.argument, " =>* ", n.result); },
          [&](const FunctionType& n) {
            const bool parentheses = level_function > place;
            if (parentheses) text("(");
            text("(");
            print_types(tree_.list(n.arguments));
            text(") -> ");
            type(n.result, loosest);
            if (parentheses) text(")");
          },
      },
      tree_.types[t].node);
}

void Printer::print_types(std::span<const TypeId> types) {
  bool first = true;
  for (const TypeId t : types) {
    if (!first) text(", ");
    type(t, loosest);
    first = false;
  }
}

}  // namespace perentie::parser

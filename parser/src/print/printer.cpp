#include "print/printer.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "perentie/parser/print.hpp"

namespace perentie::parser {

void Printer::run(const Task& task) {
  plan_.push_back(task);
  drain();
}

void Printer::drain() {
  flush();
  while (!stack_.empty()) {
    const Task next = stack_.back();
    stack_.pop_back();
    step(next);
    flush();
  }
}

// What was planned comes next, in order.
void Printer::flush() {
  stack_.insert(stack_.end(), plan_.rbegin(), plan_.rend());
  plan_.clear();
}

void Printer::step(const Task& task) {
  switch (task.kind) {
    case Task::Kind::text:
      return document_.text(task.text);
    case Task::Kind::line:
      return document_.line();
    case Task::Kind::fill:
      return document_.fill();
    case Task::Kind::hard_line:
      return document_.hard_line();
    case Task::Kind::open_group:
      return document_.open_group();
    case Task::Kind::close_group:
      return document_.close_group();
    case Task::Kind::indent:
      return document_.indent();
    case Task::Kind::dedent:
      return document_.dedent();
    case Task::Kind::expression:
      return print_expression(ExprId{task.id}, task.place);
    case Task::Kind::pattern:
      return print_pattern(PatternId{task.id}, task.place);
    case Task::Kind::type:
      return print_type(TypeId{task.id}, task.place.level);
    case Task::Kind::declaration:
      return print_declaration(DeclId{task.id});
  }
}

void Printer::script() {
  for (const DeclId d : tree_.list(tree_.declarations)) {
    run(Task::declaration(d));
    document_.hard_line();
  }
}

void Printer::print(const Assertion& assertion) {
  plan_assertion(assertion);
  drain();
}

void Printer::print_name(QualifiedName name) {
  bool first = true;
  for (const NameId part : tree_.list(name)) {
    if (!first) text("::");
    text(this->name(part));
    first = false;
  }
}

// A name that may come to begin a line: there `print` would take the rest of it as its text
// (1.3.5).
void Printer::print_operand_name(QualifiedName name) {
  const std::span<const NameId> parts = tree_.list(name);
  const bool guarded = parts.size() == 1 && this->name(parts[0]) == "print";
  if (guarded) text("(");
  print_name(name);
  if (guarded) text(")");
}

// Escapes as the lexer reads them: `\n`, `\r`, `\t`, and the character itself for others.
std::string quote(char c, char mark) {
  switch (c) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return c == mark || c == '\\' ? std::string{'\\', c} : std::string{c};
  }
}

std::string quote(char c) { return fmt::format("'{}'", quote(c, '\'')); }

std::string quote(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += quote(c, '"');
  return quoted + "\"";
}

// ---------------------------------------------------------------------------------------------
// The public functions

std::string print_script(const SyntaxTree& tree, const PrintOptions& options) {
  Document document;
  Printer(tree, document).script();
  return document.layout(options.width);
}

namespace {

template <class Part>
std::string print_part(const SyntaxTree& tree, const Part& part, const PrintOptions& options) {
  Document document;
  Printer(tree, document).print(part);
  return document.layout(options.width);
}

}  // namespace

std::string print(const SyntaxTree& tree, ExprId expression, const PrintOptions& options) {
  return print_part(tree, expression, options);
}
std::string print(const SyntaxTree& tree, PatternId pattern, const PrintOptions& options) {
  return print_part(tree, pattern, options);
}
std::string print(const SyntaxTree& tree, TypeId type, const PrintOptions& options) {
  return print_part(tree, type, options);
}
std::string print(const SyntaxTree& tree, DeclId declaration, const PrintOptions& options) {
  return print_part(tree, declaration, options);
}
std::string print(const SyntaxTree& tree, const Assertion& assertion, const PrintOptions& options) {
  return print_part(tree, assertion, options);
}

}  // namespace perentie::parser

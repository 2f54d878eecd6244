#include "dump/node_view.hpp"

#include <span>

#include <fmt/format.h>

#include "perentie/base/overload.hpp"
#include "perentie/parser/spelling.hpp"
#include "print/printer.hpp"

namespace perentie::parser {
namespace {

constexpr std::string_view name_of(Collection kind) {
  switch (kind) {
    case Collection::set:
      return "set";
    case Collection::sequence:
      return "sequence";
    case Collection::productions:
      return "productions";
  }
  return {};
}

constexpr std::string_view name_of(ReplicatedOp op) {
  switch (op) {
    case ReplicatedOp::sequential:
      return ";";
    case ReplicatedOp::external_choice:
      return "[]";
    case ReplicatedOp::internal_choice:
      return "|~|";
    case ReplicatedOp::interleave:
      return "|||";
    case ReplicatedOp::parallel:
      return "[| |]";
    case ReplicatedOp::alphabet_parallel:
      return "||";
    case ReplicatedOp::sync_choice:
      return "[+ +]";
  }
  return {};
}

constexpr std::string_view name_of(FieldKind kind) {
  switch (kind) {
    case FieldKind::input:
      return "input ?";
    case FieldKind::output:
      return "output !";
    case FieldKind::nondet_input:
      return "nondeterministic input $";
  }
  return {};
}

/// Fills one view.
class Viewer {
 public:
  Viewer(const SyntaxTree& tree, NodeView& view) : tree_(tree), view_(view) {}

  void see(std::monostate) {
    label("script");
    children(tree_.list(tree_.declarations));
  }
  void see(ExprId e);
  void see(PatternId p);
  void see(StatementId s);
  void see(FieldId f);
  void see(TypeId t);
  void see(DeclId d);
  void see(const Clause* clause);
  void see(const Constructor* constructor);
  void see(const Assertion* assertion);

 private:
  void label(std::string text) { view_.label = std::move(text); }
  template <class Id>
  void child(Id node, std::string_view role = {}) {
    if (!node.is_none()) view_.children.push_back({role, node});
  }
  template <class Id>
  void children(std::span<const Id> nodes, std::string_view role = {}) {
    for (const Id node : nodes) child(node, role);
  }
  void ties(const Ties& ties) {
    const std::span<const ExprId> to = tree_.list(ties.to);
    std::size_t i = 0;
    for (const ExprId from : tree_.list(ties.from)) {
      child(from, "from");
      child(to[i++], "to");
    }
    children(tree_.list(ties.statements));
  }
  std::string qualified(QualifiedName name) const {
    std::string text;
    for (const NameId part : tree_.list(name)) {
      if (!text.empty()) text += "::";
      text += tree_.names[part];
    }
    return text;
  }
  std::string names(IdentifierList list) const {
    std::string text;
    for (const Identifier& n : tree_.list(list)) {
      if (!text.empty()) text += ", ";
      text += tree_.names[n.name];
    }
    return text;
  }
  std::string_view name(NameId n) const { return tree_.names[n]; }
  std::string string(NameId n) const { return quote(tree_.names[n]); }

  const SyntaxTree& tree_;
  NodeView& view_;
};

void Viewer::see(ExprId e) {
  const Expr& expr = tree_.exprs[e];
  view_.span = expr.span;
  const auto bracketed = [&](std::string_view op, ExprId left, ExprId alphabet, ExprId right) {
    label(fmt::format("infix {}", op));
    child(left);
    child(alphabet, "alphabet");
    child(right);
  };
  std::visit(
      base::overload{
          [&](const NameExpr& n) { label(fmt::format("name {}", qualified(n.name))); },
          [&](const IntExpr& n) { label(fmt::format("integer {}", n.value)); },
          [&](const BoolExpr& n) { label(fmt::format("boolean {}", n.value)); },
          [&](const CharExpr& n) {
            label(fmt::format("character {}", quote(static_cast<char>(n.value))));
          },
          [&](const StringExpr& n) { label(fmt::format("string {}", string(n.text))); },
          [&](const TupleExpr& n) {
            label("tuple");
            children(tree_.list(n.items));
          },
          [&](const MapExpr& n) {
            label("map");
            const std::span<const ExprId> values = tree_.list(n.values);
            std::size_t i = 0;
            for (const ExprId key : tree_.list(n.keys)) {
              child(key, "key");
              child(values[i++], "value");
            }
          },
          [&](const CollectionExpr& n) {
            label(std::string(name_of(n.kind)));
            children(tree_.list(n.items));
            children(tree_.list(n.statements));
          },
          [&](const RangeExpr& n) {
            label(fmt::format("range {}", name_of(n.kind)));
            child(n.first, "first");
            child(n.last, "last");
            children(tree_.list(n.statements));
          },
          [&](const ApplyExpr& n) {
            label("call");
            child(n.function, "function");
            children(tree_.list(n.arguments));
          },
          [&](const LambdaExpr& n) {
            label("lambda");
            children(tree_.list(n.parameters));
            child(n.body, "body");
          },
          [&](const LetExpr& n) {
            label("let");
            children(tree_.list(n.declarations));
            child(n.body, "body");
          },
          [&](const IfExpr& n) {
            label("if");
            child(n.condition, "condition");
            child(n.then_branch, "then");
            child(n.else_branch, "else");
          },
          [&](const NegateExpr& n) {
            label("negate");
            child(n.operand);
          },
          [&](const NotExpr& n) {
            label("not");
            child(n.operand);
          },
          [&](const LengthExpr& n) {
            label("length");
            child(n.operand);
          },
          [&](const InfixExpr& n) {
            label(fmt::format("infix {}", info(n.op).spelling));
            child(n.left);
            child(n.right);
          },
          [&](const PrefixExpr& n) {
            label("prefix");
            child(n.channel, "channel");
            children(tree_.list(n.fields));
            child(n.body, "body");
          },
          [&](const ParallelExpr& n) { bracketed("[| |]", n.left, n.alphabet, n.right); },
          [&](const ExceptionExpr& n) { bracketed("[| |>", n.left, n.alphabet, n.right); },
          [&](const SyncChoiceExpr& n) { bracketed("[+ +]", n.left, n.alphabet, n.right); },
          [&](const SyncInterruptExpr& n) { bracketed("/+ +\\", n.left, n.alphabet, n.right); },
          [&](const AlphabetParallelExpr& n) {
            label("infix [ || ]");
            child(n.left);
            child(n.left_alphabet, "left alphabet");
            child(n.right_alphabet, "right alphabet");
            child(n.right);
          },
          [&](const LinkParallelExpr& n) {
            label("infix [ <-> ]");
            child(n.left);
            ties(n.links);
            child(n.right);
          },
          [&](const RenameExpr& n) {
            label("rename");
            child(n.process);
            ties(n.pairs);
          },
          [&](const ReplicatedExpr& n) {
            label(fmt::format("replicated {}", name_of(n.op)));
            child(n.alphabet, "alphabet");
            children(tree_.list(n.statements));
            child(n.body, "body");
          },
          [&](const ReplicatedLinkExpr& n) {
            label("replicated [ <-> ]");
            ties(n.links);
            children(tree_.list(n.statements), "over");
            child(n.body, "body");
          },
          [&](const WildcardExpr&) { label("wildcard"); },
          [&](const CommunicationExpr& n) {
            label("communication");
            child(n.channel, "channel");
            children(tree_.list(n.fields));
          },
      },
      expr.node);
}

void Viewer::see(PatternId p) {
  const Pattern& pattern = tree_.patterns[p];
  view_.span = pattern.span;
  const auto pair = [&](std::string_view op, PatternId left, PatternId right) {
    label(fmt::format("pattern {}", op));
    child(left);
    child(right);
  };
  const auto list = [&](std::string_view kind, PatternList items) {
    label(fmt::format("pattern {}", kind));
    children(tree_.list(items));
  };
  std::visit(
      base::overload{
          [&](const NamePattern& n) { label(fmt::format("pattern name {}", qualified(n.name))); },
          [&](const WildcardPattern&) { label("pattern _"); },
          [&](const IntPattern& n) { label(fmt::format("pattern integer {}", n.value)); },
          [&](const BoolPattern& n) { label(fmt::format("pattern boolean {}", n.value)); },
          [&](const CharPattern& n) {
            label(fmt::format("pattern character {}", quote(static_cast<char>(n.value))));
          },
          [&](const StringPattern& n) { label(fmt::format("pattern string {}", string(n.text))); },
          [&](const TuplePattern& n) { list("tuple", n.items); },
          [&](const SequencePattern& n) { list("sequence", n.items); },
          [&](const SetPattern& n) { list("set", n.items); },
          [&](const ConcatPattern& n) { pair("^", n.left, n.right); },
          [&](const DotPattern& n) { pair(".", n.left, n.right); },
          [&](const DoublePattern& n) { pair("@@", n.left, n.right); },
      },
      pattern.node);
}

void Viewer::see(StatementId s) {
  const Statement& statement = tree_.statements[s];
  view_.span = statement.span;
  if (const auto* generator = std::get_if<Generator>(&statement.node)) {
    label("generator");
    child(generator->pattern);
    child(generator->source, "from");
  } else {
    label("filter");
    child(std::get<Filter>(statement.node).condition);
  }
}

void Viewer::see(FieldId f) {
  const Field& field = tree_.fields[f];
  view_.span = field.span;
  label(std::string(name_of(field.kind)));
  child(field.pattern);
  child(field.expression, field.kind == FieldKind::output ? "" : "from");
}

void Viewer::see(TypeId t) {
  const Type& type = tree_.types[t];
  view_.span = type.span;
  const auto pair = [&](std::string_view op, TypeId left, TypeId right) {
    label(fmt::format("type {}", op));
    child(left);
    child(right);
  };
  std::visit(base::overload{
                 [&](const NamedType& n) { label(fmt::format("type name {}", qualified(n.name))); },
                 [&](const SetType& n) {
                   label("type set");
                   child(n.element);
                 },
                 [&](const SequenceType& n) {
                   label("type sequence");
                   child(n.element);
                 },
                 [&](const TupleType& n) {
                   label("type tuple");
                   children(tree_.list(n.items));
                 },
                 [&](const MapType& n) { pair("map", n.key, n.value); },
                 [&](const DotType& n) { pair(".", n.left, n.right); },
                 [&](const YieldType& n) { pair("=>", n.argument, n.result); },
                 [&](const ExtendableType& n) { pair("=>*", n.argument, n.result); },
                 [&](const FunctionType& n) {
                   label("type function");
                   children(tree_.list(n.arguments));
                   child(n.result, "result");
                 },
             },
             type.node);
}

void Viewer::see(const Clause* clause) {
  view_.span = clause->span;
  label(fmt::format("clause ({})", fmt::join(tree_.list(clause->group_sizes), ")(")));
  children(tree_.list(clause->parameters));
  child(clause->body, "body");
}

void Viewer::see(const Constructor* constructor) {
  view_.span = constructor->name.span;
  label(fmt::format("constructor {}", name(constructor->name.name)));
  child(constructor->type);
}

void Viewer::see(const Assertion* assertion) {
  const std::string_view negation = assertion->negated ? "not " : "";
  const auto with_model = [&](std::string_view property, std::optional<Model> model) {
    label(model ? fmt::format("{}{} [{}]", negation, property, spelling(*model))
                : fmt::format("{}{}", negation, property));
  };
  std::visit(base::overload{
                 [&](const RefinementAssertion& n) {
                   label(fmt::format("{}refinement [{}=", negation, spelling(n.model)));
                   child(n.specification, "specification");
                   child(n.implementation, "implementation");
                 },
                 [&](const PropertyAssertion& n) {
                   with_model(spelling(n.property), n.model);
                   child(n.process);
                 },
                 [&](const HasTraceAssertion& n) {
                   with_model(spelling(PropertyWord::has_trace), n.model);
                   child(n.process);
                   children(tree_.list(n.trace), "event");
                 },
             },
             assertion->claim);
  child(assertion->options.tau_priority, "tau priority");
  if (assertion->options.partial_order_reduce) {
    view_.label += fmt::format(" (partial order reduce {})",
                               spelling(*assertion->options.partial_order_reduce));
  }
}

void Viewer::see(DeclId d) {
  const Decl& decl = tree_.decls[d];
  view_.span = decl.span;
  std::visit(
      base::overload{
          [&](const PatternDecl& n) {
            label("define");
            child(n.pattern);
            child(n.value);
          },
          [&](const FunctionDecl& n) {
            label(fmt::format("function {}", name(n.name.name)));
            for (const Clause& clause : tree_.list(n.clauses)) {
              view_.children.push_back({{}, &clause});
            }
          },
          [&](const AnnotationDecl& n) {
            std::string text = fmt::format("annotate {}", names(n.names));
            for (const Constraint& c : tree_.list(n.constraints)) {
              text += fmt::format(" [{} {}]", name(c.constraint.name), name(c.variable.name));
            }
            label(std::move(text));
            child(n.type);
          },
          [&](const ChannelDecl& n) {
            label(fmt::format("channel {}", names(n.names)));
            child(n.type);
          },
          [&](const DatatypeDecl& n) {
            label(fmt::format("{} {}", n.is_subtype ? "subtype" : "datatype", name(n.name.name)));
            for (const Constructor& constructor : tree_.list(n.constructors)) {
              view_.children.push_back({{}, &constructor});
            }
          },
          [&](const NametypeDecl& n) {
            label(fmt::format("nametype {}", name(n.name.name)));
            child(n.type);
          },
          [&](const ImportDecl& n) {
            label(fmt::format("{} {}", n.is_external ? "external" : "transparent", names(n.names)));
          },
          [&](const AssertDecl& n) {
            label("assert");
            view_.children.push_back({{}, &n.assertion});
          },
          [&](const PrintDecl& n) {
            label(fmt::format("print {}", string(n.text)));
            child(n.expression);
          },
          [&](const ModuleDecl& n) {
            label(fmt::format("module {}", name(n.name.name)));
            children(tree_.list(n.parameters), "parameter");
            children(tree_.list(n.private_declarations), "private");
            children(tree_.list(n.exported_declarations), "exported");
          },
          [&](const InstanceDecl& n) {
            label(fmt::format("instance {} = {}", name(n.name.name), qualified(n.module)));
            children(tree_.list(n.arguments));
          },
          [&](const TimedDecl& n) {
            label("Timed");
            child(n.duration, "duration");
            children(tree_.list(n.declarations));
          },
      },
      decl.node);
}

}  // namespace

NodeView view(const SyntaxTree& tree, const NodeRef& node) {
  NodeView result;
  Viewer viewer(tree, result);
  std::visit([&](auto n) { viewer.see(n); }, node);
  return result;
}

}  // namespace perentie::parser

#include "syntax_children.hpp"

#include "perentie/base/overload.hpp"

namespace perentie::semantics {
namespace {

using base::overload;
using parser::DeclId;
using parser::ExprId;
using parser::FieldId;
using parser::PatternId;
using parser::StatementId;

class Children {
 public:
  Children(const parser::SyntaxTree& tree, std::vector<SyntaxNode>& out) : tree_(tree), out_(out) {}

  void of(ExprId id) {
    const auto two = [&](const auto& e) { add(e.left, e.right); };
    const auto three = [&](const auto& e) { add(e.left, e.alphabet, e.right); };
    std::visit(overload{
                   [&](const parser::TupleExpr& e) { add(e.items); },
                   [&](const parser::MapExpr& e) { add(e.keys, e.values); },
                   [&](const parser::CollectionExpr& e) { add(e.statements, e.items); },
                   [&](const parser::RangeExpr& e) { add(e.statements, e.first, e.last); },
                   [&](const parser::ApplyExpr& e) { add(e.function, e.arguments); },
                   [&](const parser::LambdaExpr& e) { add(e.parameters, e.body); },
                   [&](const parser::LetExpr& e) { add(e.declarations, e.body); },
                   [&](const parser::IfExpr& e) { add(e.condition, e.then_branch, e.else_branch); },
                   [&](const parser::NegateExpr& e) { add(e.operand); },
                   [&](const parser::NotExpr& e) { add(e.operand); },
                   [&](const parser::LengthExpr& e) { add(e.operand); },
                   [&](const parser::InfixExpr& e) { two(e); },
                   [&](const parser::PrefixExpr& e) { add(e.channel, e.fields, e.body); },
                   [&](const parser::ParallelExpr& e) { three(e); },
                   [&](const parser::ExceptionExpr& e) { three(e); },
                   [&](const parser::SyncChoiceExpr& e) { three(e); },
                   [&](const parser::SyncInterruptExpr& e) { three(e); },
                   [&](const parser::AlphabetParallelExpr& e) {
                     add(e.left, e.left_alphabet, e.right_alphabet, e.right);
                   },
                   [&](const parser::LinkParallelExpr& e) {
                     add(e.left, e.right);
                     ties(e.links);
                   },
                   [&](const parser::RenameExpr& e) {
                     add(e.process);
                     ties(e.pairs);
                   },
                   [&](const parser::ReplicatedExpr& e) { add(e.statements, e.alphabet, e.body); },
                   [&](const parser::ReplicatedLinkExpr& e) {
                     add(e.statements);
                     ties(e.links);
                     add(e.body);
                   },
                   [](const auto&) {},
               },
               tree_.exprs[id].node);
  }

  void of(PatternId id) {
    std::visit(overload{
                   [&](const parser::TuplePattern& p) { add(p.items); },
                   [&](const parser::SequencePattern& p) { add(p.items); },
                   [&](const parser::SetPattern& p) { add(p.items); },
                   [&](const parser::ConcatPattern& p) { add(p.left, p.right); },
                   [&](const parser::DotPattern& p) { add(p.left, p.right); },
                   [&](const parser::DoublePattern& p) { add(p.left, p.right); },
                   [](const auto&) {},
               },
               tree_.patterns[id].node);
  }

  void of(StatementId id) {
    std::visit(overload{
                   [&](const parser::Generator& s) { add(s.source, s.pattern); },
                   [&](const parser::Filter& s) { add(s.condition); },
               },
               tree_.statements[id].node);
  }

  void of(FieldId id) {
    const parser::Field& field = tree_.fields[id];
    add(field.expression, field.pattern);
  }

  void of(DeclId id) {
    std::visit(overload{
                   [&](const parser::PatternDecl& d) { add(d.pattern, d.value); },
                   [&](const parser::FunctionDecl& d) {
                     for (std::uint32_t i = 0; i < d.clauses.count; ++i) {
                       out_.push_back({SyntaxNode::Kind::clause, id.value, i});
                     }
                   },
                   [&](const parser::ChannelDecl& d) { add(d.type); },
                   [&](const parser::DatatypeDecl& d) {
                     for (const parser::Constructor& c : tree_.list(d.constructors)) add(c.type);
                   },
                   [&](const parser::NametypeDecl& d) { add(d.type); },
                   [&](const parser::AssertDecl& d) { assertion(d.assertion); },
                   [](const parser::PrintDecl&) {},  // is read when it is printed
                   [&](const parser::TimedDecl& d) { add(d.duration); },
                   [](const auto&) {},
               },
               tree_.decls[id].node);
  }

  void of_clause(DeclId function, std::uint32_t index) {
    const auto& d = std::get<parser::FunctionDecl>(tree_.decls[function].node);
    const parser::Clause& clause = tree_.list(d.clauses)[index];
    add(clause.parameters, clause.body);
  }

 private:
  template <class... Parts>
  void add(Parts... parts) {
    (one(parts), ...);
  }
  void one(ExprId id) { node(SyntaxNode::Kind::expr, id); }
  void one(PatternId id) { node(SyntaxNode::Kind::pattern, id); }
  void one(StatementId id) { node(SyntaxNode::Kind::statement, id); }
  void one(FieldId id) { node(SyntaxNode::Kind::field, id); }
  void one(DeclId id) { node(SyntaxNode::Kind::decl, id); }
  template <class Id>
  void one(parser::ListRef<Id> list) {
    for (const Id id : tree_.list(list)) one(id);
  }
  template <class Id>
  void node(SyntaxNode::Kind kind, Id id) {
    if (id) out_.push_back({kind, id.value});
  }

  void ties(const parser::Ties& ties) { add(ties.statements, ties.from, ties.to); }

  void assertion(const parser::Assertion& assertion) {
    std::visit(
        overload{
            [&](const parser::RefinementAssertion& a) { add(a.specification, a.implementation); },
            [&](const parser::PropertyAssertion& a) { add(a.process); },
            [&](const parser::HasTraceAssertion& a) { add(a.process, a.trace); },
        },
        assertion.claim);
    add(assertion.options.tau_priority);
  }

  const parser::SyntaxTree& tree_;
  std::vector<SyntaxNode>& out_;
};

}  // namespace

void append_children(const parser::SyntaxTree& tree, SyntaxNode node,
                     std::vector<SyntaxNode>& children) {
  Children walk(tree, children);
  switch (node.kind) {
    case SyntaxNode::Kind::expr:
      return walk.of(ExprId{node.id});
    case SyntaxNode::Kind::pattern:
      return walk.of(PatternId{node.id});
    case SyntaxNode::Kind::statement:
      return walk.of(StatementId{node.id});
    case SyntaxNode::Kind::field:
      return walk.of(FieldId{node.id});
    case SyntaxNode::Kind::decl:
      return walk.of(DeclId{node.id});
    case SyntaxNode::Kind::clause:
      return walk.of_clause(DeclId{node.id}, node.index);
  }
}

}  // namespace perentie::semantics

// A node is copied as it is and queued; when its turn comes, each of its children is copied in the
// same way and the new ids take the place of the old. Nothing recurses: chains may be long.
#include "perentie/parser/copy.hpp"

#include <tuple>
#include <vector>

#include "perentie/base/overload.hpp"

namespace perentie::parser {
namespace {

class Copier {
 public:
  explicit Copier(SyntaxTree& tree) : tree_(tree) {}

  DeclId run(DeclId root) {
    renew(root);
    while (drain<ExprId>() || drain<PatternId>() || drain<StatementId>() || drain<FieldId>() ||
           drain<TypeId>() || drain<DeclId>()) {
    }
    return root;
  }

 private:
  template <class IdT>
  using Queue = std::vector<IdT>;

  auto& store(ExprId) { return tree_.exprs; }
  auto& store(PatternId) { return tree_.patterns; }
  auto& store(StatementId) { return tree_.statements; }
  auto& store(FieldId) { return tree_.fields; }
  auto& store(TypeId) { return tree_.types; }
  auto& store(DeclId) { return tree_.decls; }

  auto& pool(ExprId) { return tree_.expr_lists; }
  auto& pool(PatternId) { return tree_.pattern_lists; }
  auto& pool(StatementId) { return tree_.statement_lists; }
  auto& pool(FieldId) { return tree_.field_lists; }
  auto& pool(TypeId) { return tree_.type_lists; }
  auto& pool(DeclId) { return tree_.decl_lists; }
  auto& pool(const Clause&) { return tree_.clause_lists; }
  auto& pool(const Constructor&) { return tree_.constructor_lists; }

  // Works off what is queued of one kind; false if that was nothing.
  template <class IdT>
  bool drain() {
    auto& queue = std::get<Queue<IdT>>(queues_);
    if (queue.empty()) return false;
    while (!queue.empty()) {
      const IdT id = queue.back();
      queue.pop_back();
      auto node = store(id)[id];
      renew_children(node);
      store(id)[id] = std::move(node);
    }
    return true;
  }

  // Replaces an id, or the ids of a list, by those of copies.
  template <class Tag>
  void renew(base::Id<Tag>& id) {
    if (!id) return;
    auto node = store(id)[id];
    id = store(id).add(std::move(node));
    std::get<Queue<base::Id<Tag>>>(queues_).push_back(id);
  }
  template <class T>
  void renew(base::ListRef<T>& list) {
    auto& lists = pool(T{});
    std::vector<T> items(lists[list].begin(), lists[list].end());
    for (T& item : items) renew(item);
    list = lists.add(std::span<const T>(items));
  }
  void renew(Clause& clause) { renew_all(clause.parameters, clause.body); }
  void renew(Constructor& constructor) { renew(constructor.type); }
  void renew(Ties& ties) { renew_all(ties.from, ties.to, ties.statements); }
  void renew(Assertion& assertion) {
    renew(assertion.options.tau_priority);
    std::visit(base::overload{
                   [&](RefinementAssertion& a) { renew_all(a.specification, a.implementation); },
                   [&](PropertyAssertion& a) { renew(a.process); },
                   [&](HasTraceAssertion& a) { renew_all(a.process, a.trace); },
               },
               assertion.claim);
  }
  template <class... Parts>
  void renew_all(Parts&... parts) {
    (renew(parts), ...);
  }

  void renew_children(Expr& expr) {
    std::visit(base::overload{
                   [&](TupleExpr& e) { renew(e.items); },
                   [&](MapExpr& e) { renew_all(e.keys, e.values); },
                   [&](CollectionExpr& e) { renew_all(e.items, e.statements); },
                   [&](RangeExpr& e) { renew_all(e.first, e.last, e.statements); },
                   [&](ApplyExpr& e) { renew_all(e.function, e.arguments); },
                   [&](LambdaExpr& e) { renew_all(e.parameters, e.body); },
                   [&](LetExpr& e) { renew_all(e.declarations, e.body); },
                   [&](IfExpr& e) { renew_all(e.condition, e.then_branch, e.else_branch); },
                   [&](NegateExpr& e) { renew(e.operand); },
                   [&](NotExpr& e) { renew(e.operand); },
                   [&](LengthExpr& e) { renew(e.operand); },
                   [&](InfixExpr& e) { renew_all(e.left, e.right); },
                   [&](PrefixExpr& e) { renew_all(e.channel, e.fields, e.body); },
                   [&](ParallelExpr& e) { renew_all(e.left, e.alphabet, e.right); },
                   [&](AlphabetParallelExpr& e) {
                     renew_all(e.left, e.left_alphabet, e.right_alphabet, e.right);
                   },
                   [&](ExceptionExpr& e) { renew_all(e.left, e.alphabet, e.right); },
                   [&](SyncChoiceExpr& e) { renew_all(e.left, e.alphabet, e.right); },
                   [&](SyncInterruptExpr& e) { renew_all(e.left, e.alphabet, e.right); },
                   [&](LinkParallelExpr& e) { renew_all(e.left, e.links, e.right); },
                   [&](RenameExpr& e) { renew_all(e.process, e.pairs); },
                   [&](ReplicatedExpr& e) { renew_all(e.alphabet, e.statements, e.body); },
                   [&](ReplicatedLinkExpr& e) { renew_all(e.links, e.statements, e.body); },
                   [&](CommunicationExpr& e) { renew_all(e.channel, e.fields); },
                   [](auto&) {},  // names and literals
               },
               expr.node);
  }

  void renew_children(Pattern& pattern) {
    std::visit(
        base::overload{
            [&](TuplePattern& p) { renew(p.items); }, [&](SequencePattern& p) { renew(p.items); },
            [&](SetPattern& p) { renew(p.items); },
            [&](ConcatPattern& p) { renew_all(p.left, p.right); },
            [&](DotPattern& p) { renew_all(p.left, p.right); },
            [&](DoublePattern& p) { renew_all(p.left, p.right); },
            [](auto&) {},  // names and literals
        },
        pattern.node);
  }

  void renew_children(Statement& statement) {
    std::visit(base::overload{
                   [&](Generator& s) { renew_all(s.pattern, s.source); },
                   [&](Filter& s) { renew(s.condition); },
               },
               statement.node);
  }

  void renew_children(Field& field) { renew_all(field.pattern, field.expression); }

  void renew_children(Type& type) {
    std::visit(base::overload{
                   [](NamedType&) {},
                   [&](SetType& t) { renew(t.element); },
                   [&](SequenceType& t) { renew(t.element); },
                   [&](TupleType& t) { renew(t.items); },
                   [&](MapType& t) { renew_all(t.key, t.value); },
                   [&](DotType& t) { renew_all(t.left, t.right); },
                   [&](YieldType& t) { renew_all(t.argument, t.result); },
                   [&](ExtendableType& t) { renew_all(t.argument, t.result); },
                   [&](FunctionType& t) { renew_all(t.arguments, t.result); },
               },
               type.node);
  }

  void renew_children(Decl& decl) {
    std::visit(base::overload{
                   [&](PatternDecl& d) { renew_all(d.pattern, d.value); },
                   [&](FunctionDecl& d) { renew(d.clauses); },
                   [&](AnnotationDecl& d) { renew(d.type); },
                   [&](ChannelDecl& d) { renew(d.type); },
                   [&](DatatypeDecl& d) { renew(d.constructors); },
                   [&](NametypeDecl& d) { renew(d.type); },
                   [](ImportDecl&) {},
                   [&](AssertDecl& d) { renew(d.assertion); },
                   [&](PrintDecl& d) { renew(d.expression); },
                   [&](ModuleDecl& d) {
                     renew_all(d.parameters, d.private_declarations, d.exported_declarations);
                   },
                   [&](InstanceDecl& d) { renew(d.arguments); },
                   [&](TimedDecl& d) { renew_all(d.duration, d.declarations); },
               },
               decl.node);
  }

  SyntaxTree& tree_;
  std::tuple<Queue<ExprId>, Queue<PatternId>, Queue<StatementId>, Queue<FieldId>, Queue<TypeId>,
             Queue<DeclId>>
      queues_;
};

}  // namespace

DeclId copy_declaration(SyntaxTree& tree, DeclId declaration) {
  return Copier(tree).run(declaration);
}

}  // namespace perentie::parser

#include "random_tree.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "perentie/parser/print.hpp"

namespace perentie::parser {
namespace {

constexpr int max_depth = 14;

class Maker {
 public:
  explicit Maker(const std::vector<std::uint32_t>& choices) : choices_(choices) {}

  SyntaxTree script() {
    std::vector<DeclId> decls;
    for (std::uint32_t i = choose(6); i > 0; --i) decls.push_back(decl(Where::script, 0));
    tree_.declarations = tree_.decl_lists.add(decls);
    return std::move(tree_);
  }

 private:
  enum class Where { script, timed_section, module, let };

  // ---------------------------------------------------------------------------------------------
  // Choices

  /// A number below `count`; 0 when the choices have run out.
  std::uint32_t choose(std::uint32_t count) {
    return next_ < choices_.size() ? choices_[next_++] % count : 0;
  }
  bool flip() { return choose(2) == 1; }
  bool deep(int depth) const { return depth >= max_depth || next_ >= choices_.size(); }

  template <class Item>
  auto several(std::uint32_t least, std::uint32_t most, Item item) {
    std::vector<decltype(item())> items;
    for (std::uint32_t i = least + choose(most - least + 1); i > 0; --i) items.push_back(item());
    return items;
  }

  // ---------------------------------------------------------------------------------------------
  // Names and literals

  NameId name() {
    static constexpr auto names = std::to_array<std::string_view>(
        {"x", "y", "P", "c", "A_1", "f'", "long_name", "STOP", "letter", "print", "type", "T"});
    return tree_.names.intern(names[choose(names.size())]);
  }
  Identifier identifier() { return {name(), {}}; }
  Identifier fresh(std::string_view prefix) {
    return {tree_.names.intern(std::string(prefix) + std::to_string(fresh_++)), {}};
  }
  QualifiedName qualified() {
    const std::vector<NameId> parts = several(1, choose(5) == 4 ? 3 : 1, [&] { return name(); });
    return {tree_.name_lists.add(parts)};
  }
  std::int64_t number() {
    static constexpr auto numbers = std::to_array<std::int64_t>({0, 1, 2, 42, 4611686018427387903});
    return numbers[choose(numbers.size())];
  }
  NameId text() {
    std::string bytes;
    for (std::uint32_t i = choose(5); i > 0; --i) bytes.push_back(static_cast<char>(choose(256)));
    return tree_.names.intern(bytes);
  }
  unsigned char character() { return static_cast<unsigned char>(choose(128)); }

  // ---------------------------------------------------------------------------------------------
  // Patterns

  template <class Node>
  PatternId add_pattern(Node node) {
    return tree_.patterns.add({{}, node});
  }
  PatternList patterns(std::uint32_t least, std::uint32_t most, int depth, bool in_field = false) {
    const auto items = several(least, most, [&] { return pattern(depth + 1, in_field); });
    return tree_.pattern_lists.add(items);
  }

  PatternId pattern(int depth, bool in_field = false) {
    switch (choose(deep(depth) ? 7 : 13)) {
      case 1:
        return add_pattern(WildcardPattern{});
      case 2:
        return add_pattern(IntPattern{number()});
      case 3:
        return add_pattern(IntPattern{-number()});
      case 4:
        return add_pattern(BoolPattern{flip()});
      case 5:
        return add_pattern(CharPattern{character()});
      case 6:
        return add_pattern(StringPattern{text()});
      case 7:
        return add_pattern(TuplePattern{patterns(2, 3, depth, in_field)});
      case 8:
        return add_pattern(SequencePattern{patterns(0, 3, depth, in_field)});
      case 9:
        return add_pattern(SetPattern{patterns(0, 1, depth, in_field)});
      case 10:
        return concatenation(depth, in_field);
      case 11: {
        const PatternId left = pattern(depth + 1, in_field);
        return add_pattern(DotPattern{left, pattern(depth + 1, in_field)});
      }
      case 12: {
        const PatternId left = pattern(depth + 1, in_field);
        if (in_field) return left;
        return add_pattern(DoublePattern{left, pattern(depth + 1, in_field)});
      }
      default:
        return add_pattern(NamePattern{qualified()});
    }
  }

  PatternId fixed(int depth, bool in_field) {
    return add_pattern(SequencePattern{patterns(0, 2, depth, in_field)});
  }
  /// Fixed parts around at most one that is not, grouped either way.
  PatternId concatenation(int depth, bool in_field) {
    PatternId result = flip() ? pattern_of_one_sequence() : fixed(depth, in_field);
    for (std::uint32_t i = 1 + choose(3); i > 0; --i) {
      const PatternId part = fixed(depth, in_field);
      result = flip() ? add_pattern(ConcatPattern{result, part})
                      : add_pattern(ConcatPattern{part, result});
    }
    return result;
  }
  PatternId pattern_of_one_sequence() {
    return flip() ? add_pattern(WildcardPattern{}) : add_pattern(NamePattern{qualified()});
  }

  // ---------------------------------------------------------------------------------------------
  // Statements and fields

  StatementId statement(int depth) {
    if (choose(4) == 3) return tree_.statements.add({{}, Filter{expr(depth + 1)}});
    const PatternId p = pattern(depth + 1);
    return tree_.statements.add({{}, Generator{p, expr(depth + 1)}});
  }
  StatementList statements(std::uint32_t least, std::uint32_t most, int depth) {
    return tree_.statement_lists.add(several(least, most, [&] { return statement(depth); }));
  }

  FieldList fields(int depth) {
    std::vector<FieldId> list;
    bool nondeterministic = flip();
    for (std::uint32_t i = choose(4); i > 0; --i) {
      nondeterministic = nondeterministic && flip();
      Field field{{}, FieldKind::output, {}, {}};
      if (nondeterministic || flip()) {
        field.kind = nondeterministic ? FieldKind::nondet_input : FieldKind::input;
        field.pattern = pattern(depth + 1, true);
        if (flip()) field.expression = expr(depth + 1);
      } else {
        field.expression = expr(depth + 1);
      }
      list.push_back(tree_.fields.add(field));
    }
    return tree_.field_lists.add(list);
  }

  // ---------------------------------------------------------------------------------------------
  // Expressions

  template <class Node>
  ExprId add(Node node) {
    return tree_.exprs.add({{}, node});
  }
  ExprList exprs(std::uint32_t least, std::uint32_t most, int depth) {
    return tree_.expr_lists.add(several(least, most, [&] { return expr(depth + 1); }));
  }
  Ties ties(int depth) {
    const ExprList from = exprs(1, 2, depth);
    std::vector<ExprId> to;
    for (std::uint32_t i = 0; i < from.count; ++i) to.push_back(expr(depth + 1));
    const ExprList to_list = tree_.expr_lists.add(to);
    return {from, to_list, statements(0, 2, depth)};
  }

  InfixOp plain_infix() {
    while (true) {
      const auto op = static_cast<InfixOp>(choose(static_cast<std::uint32_t>(infix_table.size())));
      switch (op) {
        case InfixOp::restrict:
        case InfixOp::input:
        case InfixOp::output:
        case InfixOp::nondet_input:
        case InfixOp::prefix:
        case InfixOp::parallel:
        case InfixOp::alphabet_parallel:
        case InfixOp::exception:
        case InfixOp::link_parallel:
        case InfixOp::sync_choice:
        case InfixOp::sync_interrupt:
        case InfixOp::double_pattern:
          continue;
        default:
          return op;
      }
    }
  }

  ExprId expr(int depth) {
    if (deep(depth)) return leaf();
    switch (choose(16)) {
      case 1:
      case 2:
      case 3: {
        const InfixOp op = plain_infix();
        const ExprId left = expr(depth + 1);
        return add(InfixExpr{op, left, expr(depth + 1)});
      }
      case 4:
      case 5:
        return bracketed_infix(depth);
      case 6: {
        const ExprId channel = expr(depth + 1);
        const FieldList f = fields(depth);
        return add(PrefixExpr{channel, f, expr(depth + 1)});
      }
      case 7:
      case 8:
        return prefix_form(depth);
      case 9:
        return replicated(depth);
      case 10:
        return collection(depth);
      case 11:
        return range(depth);
      case 12: {
        const ExprId function = expr(depth + 1);
        return add(ApplyExpr{function, exprs(0, 3, depth)});
      }
      case 13: {
        const ExprId process = expr(depth + 1);
        return add(RenameExpr{process, ties(depth)});
      }
      case 14:
        return add(TupleExpr{exprs(2, 3, depth)});
      case 15: {
        const ExprList keys = exprs(0, 2, depth);
        std::vector<ExprId> values;
        for (std::uint32_t i = 0; i < keys.count; ++i) values.push_back(expr(depth + 1));
        return add(MapExpr{keys, tree_.expr_lists.add(values)});
      }
      default:
        return leaf();
    }
  }

  ExprId leaf() {
    switch (choose(6)) {
      case 1:
        return add(IntExpr{number()});
      case 2:
        return add(BoolExpr{flip()});
      case 3:
        return add(CharExpr{character()});
      case 4:
        return add(StringExpr{text()});
      default:
        return add(NameExpr{qualified()});
    }
  }

  ExprId bracketed_infix(int depth) {
    const ExprId left = expr(depth + 1);
    const std::uint32_t kind = choose(6);
    if (kind == 5) {
      const Ties links = ties(depth);
      return add(LinkParallelExpr{left, links, expr(depth + 1)});
    }
    const ExprId alphabet = expr(depth + 1);
    const ExprId right = expr(depth + 1);
    switch (kind) {
      case 0:
        return add(ParallelExpr{left, alphabet, right});
      case 1:
        return add(ExceptionExpr{left, alphabet, right});
      case 2:
        return add(SyncChoiceExpr{left, alphabet, right});
      case 3:
        return add(SyncInterruptExpr{left, alphabet, right});
      default:
        return add(AlphabetParallelExpr{left, alphabet, expr(depth + 1), right});
    }
  }

  ExprId prefix_form(int depth) {
    switch (choose(6)) {
      case 0:
        return add(NegateExpr{expr(depth + 1)});
      case 1:
        return add(NotExpr{expr(depth + 1)});
      case 2:
        return add(LengthExpr{expr(depth + 1)});
      case 3: {
        const ExprId condition = expr(depth + 1);
        const ExprId then_branch = expr(depth + 1);
        return add(IfExpr{condition, then_branch, expr(depth + 1)});
      }
      case 4: {
        const DeclList declarations = decls(Where::let, 1, 2, depth);
        return add(LetExpr{declarations, expr(depth + 1)});
      }
      default: {
        const PatternList parameters = patterns(1, 2, depth);
        return add(LambdaExpr{parameters, expr(depth + 1)});
      }
    }
  }

  ExprId replicated(int depth) {
    const std::uint32_t kind = choose(8);
    if (kind == 7) {
      const Ties links = ties(depth);
      const StatementList s = statements(1, 2, depth);
      return add(ReplicatedLinkExpr{links, s, expr(depth + 1)});
    }
    const auto op = static_cast<ReplicatedOp>(kind);
    const bool has_alphabet = op == ReplicatedOp::parallel || op == ReplicatedOp::sync_choice ||
                              op == ReplicatedOp::alphabet_parallel;
    const ExprId alphabet = has_alphabet ? expr(depth + 1) : ExprId{};
    const StatementList s = statements(1, 2, depth);
    return add(ReplicatedExpr{op, alphabet, s, expr(depth + 1)});
  }

  ExprId collection(int depth) {
    const auto kind = static_cast<Collection>(choose(3));
    const ExprList items = exprs(0, 3, depth);
    return add(CollectionExpr{kind, items, statements(0, flip() ? 2 : 0, depth)});
  }

  ExprId range(int depth) {
    const auto kind = static_cast<Collection>(choose(2));
    const ExprId first = expr(depth + 1);
    const ExprId last = flip() ? expr(depth + 1) : ExprId{};
    return add(RangeExpr{kind, first, last, statements(0, flip() ? 2 : 0, depth)});
  }

  // ---------------------------------------------------------------------------------------------
  // Types

  TypeId type(int depth) {
    const auto add_type = [&](auto node) { return tree_.types.add({{}, node}); };
    const auto types = [&](std::uint32_t least) {
      return tree_.type_lists.add(several(least, 3, [&] { return type(depth + 1); }));
    };
    const auto pair = [&] {
      const TypeId left = type(depth + 1);
      return std::pair(left, type(depth + 1));
    };
    switch (deep(depth) ? 0 : choose(9)) {
      case 1:
        return add_type(SetType{type(depth + 1)});
      case 2:
        return add_type(SequenceType{type(depth + 1)});
      case 3:
        return add_type(TupleType{types(2)});
      case 4: {
        const auto [key, value] = pair();
        return add_type(MapType{key, value});
      }
      case 5: {
        const auto [left, right] = pair();
        return add_type(DotType{left, right});
      }
      case 6: {
        const auto [left, right] = pair();
        return add_type(YieldType{left, right});
      }
      case 7: {
        const auto [left, right] = pair();
        return add_type(ExtendableType{left, right});
      }
      case 8: {
        const TypeList arguments = types(0);
        return add_type(FunctionType{arguments, type(depth + 1)});
      }
      default:
        return add_type(NamedType{qualified()});
    }
  }

  // ---------------------------------------------------------------------------------------------
  // Assertions

  std::optional<Model> model() {
    if (!flip()) return std::nullopt;
    return any_model();
  }
  Model any_model() { return static_cast<Model>(choose(7)); }

  Assertion assertion(int depth) {
    Assertion result{flip(), {}, {}};
    switch (choose(3)) {
      case 0: {
        const ExprId specification = expr(depth + 1);
        const Model m = any_model();
        auto& claim = result.claim.emplace<RefinementAssertion>();
        claim.specification = specification;
        claim.model = m;
        claim.implementation = expr(depth + 1);
        break;
      }
      case 1: {
        const ExprId process = expr(depth + 1);
        result.claim = PropertyAssertion{process, static_cast<Property>(choose(3)), model()};
        break;
      }
      default: {
        const ExprId process = expr(depth + 1);
        auto& claim = result.claim.emplace<HasTraceAssertion>();
        claim.process = process;
        claim.model = model();
        claim.trace = exprs(1, 3, depth);
      }
    }
    if (flip()) result.options.tau_priority = expr(depth + 1);
    if (flip()) result.options.partial_order_reduce = static_cast<PartialOrderMode>(choose(3));
    return result;
  }

  // ---------------------------------------------------------------------------------------------
  // Declarations

  DeclList decls(Where where, std::uint32_t least, std::uint32_t most, int depth) {
    return tree_.decl_lists.add(several(least, most, [&] { return decl(where, depth + 1); }));
  }
  template <class Node>
  DeclId add_decl(Node node) {
    return tree_.decls.add({{}, node});
  }
  IdentifierList identifiers() {
    return tree_.identifier_lists.add(several(1, 2, [&] { return identifier(); }));
  }

  DeclId decl(Where where, int depth) {
    const bool in_let = where == Where::let;
    switch (choose(in_let ? 5 : 13)) {
      case 1:
        return function(depth);
      case 2:
        return annotation(depth);
      case 3:
        return add_decl(ImportDecl{flip(), identifiers()});
      case 4: {
        if (deep(depth)) break;
        const ExprId duration = flip() ? expr(depth + 1) : ExprId{};
        const Where inside = where == Where::script ? Where::timed_section : where;
        return add_decl(TimedDecl{duration, decls(inside, 0, 2, depth)});
      }
      case 5: {
        // Names of their own: several annotated channels in one declaration are an error.
        const auto names = tree_.identifier_lists.add(several(1, 2, [&] { return fresh("chan"); }));
        return add_decl(ChannelDecl{names, flip() ? expr(depth + 1) : ExprId{}});
      }
      case 6:
      case 7: {
        const auto constructors = several(1, 3, [&] {
          const Identifier n = identifier();
          return Constructor{n, flip() ? expr(depth + 1) : ExprId{}};
        });
        return add_decl(
            DatatypeDecl{identifier(), tree_.constructor_lists.add(constructors), flip()});
      }
      case 8:
        return add_decl(NametypeDecl{identifier(), expr(depth + 1)});
      case 9: {
        if (where == Where::module) break;
        return add_decl(AssertDecl{assertion(depth)});
      }
      case 10: {
        if (where != Where::script) break;
        return print_line(depth);
      }
      case 11: {
        if (deep(depth)) break;
        const PatternList parameters = patterns(0, 2, depth);
        const DeclList hidden = decls(Where::module, 0, 2, depth);
        return add_decl(
            ModuleDecl{identifier(), parameters, hidden, decls(Where::module, 0, 2, depth)});
      }
      case 12: {
        const QualifiedName module = qualified();
        return add_decl(InstanceDecl{identifier(), module, {}, exprs(0, 2, depth)});
      }
      default:
        break;
    }
    const PatternId p = pattern(depth + 1);
    return add_decl(PatternDecl{p, expr(depth + 1)});
  }

  DeclId function(int depth) {
    const auto clauses = several(1, 2, [&] {
      std::vector<std::uint32_t> sizes;
      std::vector<PatternId> parameters;
      for (std::uint32_t group = 1 + choose(2); group > 0; --group) {
        sizes.push_back(choose(3));
        for (std::uint32_t i = 0; i < sizes.back(); ++i) parameters.push_back(pattern(depth + 1));
      }
      const auto size_list = tree_.size_lists.add(sizes);
      const auto parameter_list = tree_.pattern_lists.add(parameters);
      return Clause{{}, size_list, parameter_list, expr(depth + 1)};
    });
    return add_decl(FunctionDecl{fresh("fun"), tree_.clause_lists.add(clauses)});
  }

  DeclId annotation(int depth) {
    static constexpr auto names =
        std::to_array<std::string_view>({"Eq", "Ord", "Complete", "Set", "Yieldable"});
    const auto constraints = several(0, 2, [&] {
      const NameId constraint = tree_.names.intern(names[choose(names.size())]);
      return Constraint{{constraint, {}}, identifier()};
    });
    return add_decl(
        AnnotationDecl{identifiers(), tree_.constraint_lists.add(constraints), type(depth + 1)});
  }

  /// The text of a print line is that of its expression; it must fit on one line.
  DeclId print_line(int depth) {
    ExprId e = expr(depth + 1);
    std::string line = perentie::parser::print(tree_, e, {0});
    if (line.find('\n') != std::string::npos) {
      e = add(IntExpr{1});
      line = "1";
    }
    return add_decl(PrintDecl{tree_.names.intern(line), e});
  }

  const std::vector<std::uint32_t>& choices_;
  std::size_t next_ = 0;
  int fresh_ = 0;
  SyntaxTree tree_;
};

}  // namespace

SyntaxTree random_script(const std::vector<std::uint32_t>& choices) {
  return Maker(choices).script();
}

}  // namespace perentie::parser

// The syntax tree of a CSPM script.
//
// Nodes live in the stores of a `SyntaxTree` and name each other by ids; child lists are runs in
// shared pools. A node is a `Span` and one alternative of a variant. The tree is what the source
// says and nothing more: parentheses are gone (the shape has them), includes are spliced in,
// consecutive clauses of one function are one `FunctionDecl`. Numbers such as "2.3.1" are lines of
// the CSPM reference.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "perentie/base/id.hpp"
#include "perentie/base/interner.hpp"
#include "perentie/base/source.hpp"
#include "perentie/parser/operators.hpp"

namespace perentie::parser {

using base::ListRef;
using base::NameId;
using base::Span;

using ExprId = base::Id<struct ExprTag>;
using PatternId = base::Id<struct PatternTag>;
using StatementId = base::Id<struct StatementTag>;
using FieldId = base::Id<struct FieldTag>;
using TypeId = base::Id<struct TypeTag>;
using DeclId = base::Id<struct DeclTag>;

using ExprList = ListRef<ExprId>;
using PatternList = ListRef<PatternId>;
using StatementList = ListRef<StatementId>;
using FieldList = ListRef<FieldId>;
using TypeList = ListRef<TypeId>;
using DeclList = ListRef<DeclId>;

/// A name where it is defined.
struct Identifier {
  NameId name;
  Span span;
};
using IdentifierList = ListRef<Identifier>;

/// A name where it is used: `x` or `M::N::x` (1.3.6). The last part is the name itself.
struct QualifiedName {
  ListRef<NameId> parts;
};

// ---------------------------------------------------------------------------------------------
// Patterns (1.9)

struct NamePattern {  ///< binds, unless it names a channel or constructor (1.9.2)
  QualifiedName name;
};
struct WildcardPattern {};
struct IntPattern {
  std::int64_t value;
};
struct BoolPattern {
  bool value;
};
struct CharPattern {
  unsigned char value;
};
struct StringPattern {
  NameId text;
};
struct TuplePattern {
  PatternList items;  ///< two or more
};
struct SequencePattern {
  PatternList items;
};
struct SetPattern {
  PatternList items;  ///< at most one (1.9.7)
};
struct ConcatPattern {
  PatternId left, right;
};
struct DotPattern {
  PatternId left, right;
};
struct DoublePattern {  ///< `p @@ q`: both must match
  PatternId left, right;
};

struct Pattern {
  Span span;
  std::variant<NamePattern, WildcardPattern, IntPattern, BoolPattern, CharPattern, StringPattern,
               TuplePattern, SequencePattern, SetPattern, ConcatPattern, DotPattern, DoublePattern>
      node;
};

// ---------------------------------------------------------------------------------------------
// Statements and fields

struct Generator {  ///< `p <- e` or `p : e` (3.5)
  PatternId pattern;
  ExprId source;
};
struct Filter {
  ExprId condition;
};
struct Statement {
  Span span;
  std::variant<Generator, Filter> node;
};

enum class FieldKind : std::uint8_t { input, output, nondet_input };

/// One communication field (4.3): `?p`, `?p:S`, `$p`, `$p:S`, `!e`.
struct Field {
  Span span;
  FieldKind kind;
  PatternId pattern;  ///< inputs
  ExprId expression;  ///< outputs: the value; inputs: the restricting set, or none
};

// ---------------------------------------------------------------------------------------------
// Expressions

struct NameExpr {
  QualifiedName name;
};
struct IntExpr {
  std::int64_t value;  ///< never negative: the sign is a `NegateExpr` (1.4.1)
};
struct BoolExpr {
  bool value;
};
struct CharExpr {
  unsigned char value;
};
struct StringExpr {
  NameId text;  ///< with its escapes resolved
};
struct TupleExpr {
  ExprList items;  ///< two or more
};
struct MapExpr {  ///< `(| k => v, .. |)`: keys and values in step
  ExprList keys, values;
};

/// What the brackets of a collection make: `{..}`, `<..>`, `{|..|}`.
enum class Collection : std::uint8_t { set, sequence, productions };

struct CollectionExpr {  ///< `{e1, .., en}`, `{e1, .., en | statements}` and likewise for the
                         ///< others
  Collection kind;
  ExprList items;
  StatementList statements;
};
struct RangeExpr {  ///< `{a..b}`, `<a..>`, `{a..b | statements}`; never productions
  Collection kind;
  ExprId first;
  ExprId last;  ///< none: unbounded
  StatementList statements;
};

struct ApplyExpr {  ///< `f(e1, .., en)`, one group; curried calls nest
  ExprId function;
  ExprList arguments;
};
struct LambdaExpr {  ///< `\ p1, .., pn @ e`
  PatternList parameters;
  ExprId body;
};
struct LetExpr {
  DeclList declarations;
  ExprId body;
};
struct IfExpr {
  ExprId condition, then_branch, else_branch;
};
struct NegateExpr {
  ExprId operand;
};
struct NotExpr {
  ExprId operand;
};
struct LengthExpr {  ///< `#s`
  ExprId operand;
};

/// Every infix operator that has nothing but two operands.
struct InfixExpr {
  InfixOp op;
  ExprId left, right;
};

struct PrefixExpr {  ///< `c f1 .. fn -> P`; with no fields, `e -> P` (4.3)
  ExprId channel;
  FieldList fields;
  ExprId body;
};
struct ParallelExpr {  ///< `P [| A |] Q`
  ExprId left, alphabet, right;
};
struct AlphabetParallelExpr {  ///< `P [A || B] Q`
  ExprId left, left_alphabet, right_alphabet, right;
};
struct ExceptionExpr {  ///< `P [| A |> Q`
  ExprId left, alphabet, right;
};
struct SyncChoiceExpr {  ///< `P [+ A +] Q`
  ExprId left, alphabet, right;
};
struct SyncInterruptExpr {  ///< `P /+ A +\ Q`
  ExprId left, alphabet, right;
};

/// The ties of a link and the pairs of a renaming: `from` and `to` in step, then statements.
struct Ties {
  ExprList from, to;
  StatementList statements;
};
struct LinkParallelExpr {  ///< `P [a <-> b, .. | statements] Q`
  ExprId left;
  Ties links;
  ExprId right;
};
struct RenameExpr {  ///< `P[[a <- b, .. | statements]]`
  ExprId process;
  Ties pairs;
};

enum class ReplicatedOp : std::uint8_t {
  sequential,         ///< `; s @ P`
  external_choice,    ///< `[] s @ P`
  internal_choice,    ///< `|~| s @ P`
  interleave,         ///< `||| s @ P`
  parallel,           ///< `[| A |] s @ P`
  alphabet_parallel,  ///< `|| s @ [A] P`
  sync_choice,        ///< `[+ A +] s @ P`
};

struct ReplicatedExpr {
  ReplicatedOp op;
  ExprId alphabet;  ///< of the three that have one, else none
  StatementList statements;
  ExprId body;
};
struct ReplicatedLinkExpr {  ///< `[a <-> b, .. | statements] s @ P`
  Ties links;
  StatementList statements;
  ExprId body;
};

/// What only a pattern, a field or a generator may contain. The parser reads those as expressions
/// and converts them; in a finished tree without errors no expression refers to one of these.
struct WildcardExpr {};
struct CommunicationExpr {
  ExprId channel;
  FieldList fields;
};

struct Expr {
  Span span;
  std::variant<NameExpr, IntExpr, BoolExpr, CharExpr, StringExpr, TupleExpr, MapExpr,
               CollectionExpr, RangeExpr, ApplyExpr, LambdaExpr, LetExpr, IfExpr, NegateExpr,
               NotExpr, LengthExpr, InfixExpr, PrefixExpr, ParallelExpr, AlphabetParallelExpr,
               ExceptionExpr, SyncChoiceExpr, SyncInterruptExpr, LinkParallelExpr, RenameExpr,
               ReplicatedExpr, ReplicatedLinkExpr, WildcardExpr, CommunicationExpr>
      node;
};

// ---------------------------------------------------------------------------------------------
// Types in annotations (1.8)

struct NamedType {  ///< `Int`, a datatype, or a type variable: resolution tells them apart
  QualifiedName name;
};
struct SetType {
  TypeId element;
};
struct SequenceType {
  TypeId element;
};
struct TupleType {
  TypeList items;
};
struct MapType {
  TypeId key, value;
};
struct DotType {
  TypeId left, right;
};
struct YieldType {  ///< `a => b`
  TypeId argument, result;
};
struct ExtendableType {  ///< `a =>* b`
  TypeId argument, result;
};
struct FunctionType {  ///< `(t1, .., tn) -> t`
  TypeList arguments;
  TypeId result;
};

struct Type {
  Span span;
  std::variant<NamedType, SetType, SequenceType, TupleType, MapType, DotType, YieldType,
               ExtendableType, FunctionType>
      node;
};

/// `Eq a` in front of an annotated type.
struct Constraint {
  Identifier constraint;
  Identifier variable;
};

// ---------------------------------------------------------------------------------------------
// Assertions (2.6)

enum class Model : std::uint8_t {
  traces,
  failures,
  failures_divergences,
  revivals,
  revivals_divergences,
  refusal_testing,
  refusal_testing_divergences,
};

enum class Property : std::uint8_t { deadlock_free, divergence_free, deterministic };

struct RefinementAssertion {
  ExprId specification;
  Model model;
  ExprId implementation;
};
struct PropertyAssertion {
  ExprId process;
  Property property;
  std::optional<Model> model;
};
struct HasTraceAssertion {
  ExprId process;
  std::optional<Model> model;
  ExprList trace;
};

enum class PartialOrderMode : std::uint8_t { precise, hybrid, fast };

struct AssertionOptions {
  ExprId tau_priority;  ///< the set of `:[tau priority]: S`, or none
  std::optional<PartialOrderMode> partial_order_reduce;
};

struct Assertion {
  bool negated;
  std::variant<RefinementAssertion, PropertyAssertion, HasTraceAssertion> claim;
  AssertionOptions options;
};

// ---------------------------------------------------------------------------------------------
// Declarations (2)

struct PatternDecl {  ///< `p = e`; a constant when the pattern is one name
  PatternId pattern;
  ExprId value;
};

/// One clause `f(p..)(q..) = e`: the groups follow each other in `parameters`, `group_sizes` cuts
/// them.
struct Clause {
  Span span;
  ListRef<std::uint32_t> group_sizes;
  PatternList parameters;
  ExprId body;
};
struct FunctionDecl {
  Identifier name;  ///< of the first clause
  ListRef<Clause> clauses;
};

struct AnnotationDecl {  ///< `n1, n2 :: C a => t` (2.2.5)
  IdentifierList names;
  ListRef<Constraint> constraints;
  TypeId type;
};
struct ChannelDecl {
  IdentifierList names;
  ExprId type;  ///< none: the channels carry no data
};

struct Constructor {
  Identifier name;
  ExprId type;  ///< none: a constant
};
struct DatatypeDecl {
  Identifier name;
  ListRef<Constructor> constructors;
  bool is_subtype;
};
struct NametypeDecl {
  Identifier name;
  ExprId type;
};
struct ImportDecl {  ///< `transparent f, g` or `external f, g` (2.5)
  bool is_external;
  IdentifierList names;
};
struct AssertDecl {
  Assertion assertion;
};
struct PrintDecl {  ///< `print e`; none if the text does not parse, which is a warning (11.13)
  NameId text;
  ExprId expression;
};
struct ModuleDecl {
  Identifier name;
  PatternList parameters;
  DeclList private_declarations;
  DeclList exported_declarations;
};
struct InstanceDecl {  ///< `instance N = M::K(e1, ..)`
  Identifier name;
  QualifiedName module;
  Span module_span;
  ExprList arguments;
};
struct TimedDecl {  ///< `Timed (f) { .. }`; none: every event takes one tock (2.10.1)
  ExprId duration;
  DeclList declarations;
};

struct Decl {
  Span span;
  std::variant<PatternDecl, FunctionDecl, AnnotationDecl, ChannelDecl, DatatypeDecl, NametypeDecl,
               ImportDecl, AssertDecl, PrintDecl, ModuleDecl, InstanceDecl, TimedDecl>
      node;
};

// ---------------------------------------------------------------------------------------------
// The tree

struct SyntaxTree {
  base::Interner names;

  base::Store<ExprId, Expr> exprs;
  base::Store<PatternId, Pattern> patterns;
  base::Store<StatementId, Statement> statements;
  base::Store<FieldId, Field> fields;
  base::Store<TypeId, Type> types;
  base::Store<DeclId, Decl> decls;

  base::ListPool<ExprId> expr_lists;
  base::ListPool<PatternId> pattern_lists;
  base::ListPool<StatementId> statement_lists;
  base::ListPool<FieldId> field_lists;
  base::ListPool<TypeId> type_lists;
  base::ListPool<DeclId> decl_lists;
  base::ListPool<Identifier> identifier_lists;
  base::ListPool<NameId> name_lists;
  base::ListPool<std::uint32_t> size_lists;
  base::ListPool<Clause> clause_lists;
  base::ListPool<Constraint> constraint_lists;
  base::ListPool<Constructor> constructor_lists;

  DeclList declarations;  ///< the script itself

  std::span<const ExprId> list(ExprList l) const { return expr_lists[l]; }
  std::span<const PatternId> list(PatternList l) const { return pattern_lists[l]; }
  std::span<const StatementId> list(StatementList l) const { return statement_lists[l]; }
  std::span<const FieldId> list(FieldList l) const { return field_lists[l]; }
  std::span<const TypeId> list(TypeList l) const { return type_lists[l]; }
  std::span<const DeclId> list(DeclList l) const { return decl_lists[l]; }
  std::span<const Identifier> list(IdentifierList l) const { return identifier_lists[l]; }
  std::span<const NameId> list(QualifiedName n) const { return name_lists[n.parts]; }
  std::span<const std::uint32_t> list(ListRef<std::uint32_t> l) const { return size_lists[l]; }
  std::span<const Clause> list(ListRef<Clause> l) const { return clause_lists[l]; }
  std::span<const Constraint> list(ListRef<Constraint> l) const { return constraint_lists[l]; }
  std::span<const Constructor> list(ListRef<Constructor> l) const { return constructor_lists[l]; }
};

}  // namespace perentie::parser

// The rules that more than one file of the grammar uses.
#pragma once

#include "grammar/tokens.hpp"

namespace perentie::parser::grammar {

using K = TokenKind;

using ExpressionRule = x3::rule<struct ExpressionClass, ExprId>;
using ExpressionListRule = x3::rule<struct ExpressionListClass, ExprList>;
using StatementListRule = x3::rule<struct StatementListClass, StatementList>;
using SuchThatRule = x3::rule<struct SuchThatClass, StatementList>;
using PatternListRule = x3::rule<struct PatternListClass, PatternList>;
using QualifiedNameRule = x3::rule<struct QualifiedNameClass, QualifiedName>;
using LocalDeclarationsRule = x3::rule<struct LocalDeclarationsClass, DeclList>;
using AnnotatedTypeRule = x3::rule<struct AnnotatedTypeClass, AnnotatedType>;
using AssertionRule = x3::rule<struct AssertionClass, x3::unused_type>;

inline const ExpressionRule expression = "an expression";
/// One or more.
inline const ExpressionListRule expression_list = "an expression";
inline const StatementListRule statement_list = "a generator such as `x : S`";
/// `| s1, s2`, the end of a comprehension.
inline const SuchThatRule such_that = "`|`";
inline const PatternListRule pattern_list = "a pattern";
inline const QualifiedNameRule qualified_name = "a name";
/// The declarations of a `let`, at least one.
inline const LocalDeclarationsRule local_declarations = "a declaration";
inline const AnnotatedTypeRule annotated_type = "a type";
/// `[not] P [T= Q` and so on, without the word `assert`.
inline const AssertionRule assertion = "a process";

BOOST_SPIRIT_DECLARE(ExpressionRule)
BOOST_SPIRIT_DECLARE(ExpressionListRule)
BOOST_SPIRIT_DECLARE(StatementListRule)
BOOST_SPIRIT_DECLARE(SuchThatRule)
BOOST_SPIRIT_DECLARE(PatternListRule)
BOOST_SPIRIT_DECLARE(QualifiedNameRule)
BOOST_SPIRIT_DECLARE(LocalDeclarationsRule)
BOOST_SPIRIT_DECLARE(AnnotatedTypeRule)
BOOST_SPIRIT_DECLARE(AssertionRule)

}  // namespace perentie::parser::grammar

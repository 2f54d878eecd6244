// What the builders share: the tree they fill, where messages go, the nesting depth, and the
// scratch lists on which the members of a list gather until its end is reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/source.hpp"
#include "perentie/parser/ast.hpp"
#include "perentie/parser/token.hpp"

namespace perentie::parser {

/// Thrown when the limit on nesting is passed.
struct TooDeep {
  const Token* where;
};
/// Thrown to give up on a declaration whose error has been reported.
struct Abandoned {};

/// One stack for each type of list member: nested lists of one type use it one inside the other.
class Scratch {
 public:
  template <class T>
  void push(const T& item) {
    items<T>().push_back(item);
  }
  template <class T>
  std::size_t mark() {
    return items<T>().size();
  }
  template <class T>
  void drop(std::size_t mark) {
    items<T>().resize(mark);
  }
  /// Moves what was pushed since the mark into the tree.
  template <class T>
  ListRef<T> take(SyntaxTree& tree, std::size_t mark) {
    const ListRef<T> list = pool<T>(tree).add(std::span<const T>(items<T>()).subspan(mark));
    drop<T>(mark);
    return list;
  }
  void clear() {
    std::apply([](auto&... lists) { (lists.clear(), ...); }, lists_);
  }

 private:
  template <class T>
  std::vector<T>& items() {
    return std::get<std::vector<T>>(lists_);
  }
  template <class T>
  static base::ListPool<T>& pool(SyntaxTree& tree) {
    if constexpr (std::is_same_v<T, ExprId>)
      return tree.expr_lists;
    else if constexpr (std::is_same_v<T, PatternId>)
      return tree.pattern_lists;
    else if constexpr (std::is_same_v<T, StatementId>)
      return tree.statement_lists;
    else if constexpr (std::is_same_v<T, TypeId>)
      return tree.type_lists;
    else if constexpr (std::is_same_v<T, NameId>)
      return tree.name_lists;
    else if constexpr (std::is_same_v<T, Identifier>)
      return tree.identifier_lists;
    else if constexpr (std::is_same_v<T, Constructor>)
      return tree.constructor_lists;
    else
      return tree.constraint_lists;
  }

  std::tuple<std::vector<ExprId>, std::vector<PatternId>, std::vector<StatementId>,
             std::vector<TypeId>, std::vector<NameId>, std::vector<Identifier>,
             std::vector<Constructor>, std::vector<Constraint>>
      lists_;
};

struct BuildContext {
  SyntaxTree& tree;
  const base::SourceMap& sources;
  base::Diagnostics& diagnostics;
  const TokenStream& stream;
  std::uint32_t max_depth;
  std::uint32_t depth = 0;  ///< open runs and prefix operators on the way to the current token
  const Token* last_error = nullptr;  ///< the token of the last syntax error
  Scratch scratch{};

  /// One level deeper; throws TooDeep past the limit.
  void descend(const Token* where) {
    if (++depth > max_depth) throw TooDeep{where};
  }

  template <class Node>
  ExprId add(Span span, Node node) {
    return tree.exprs.add({span, std::move(node)});
  }
  base::Diagnostic& report(const base::DiagnosticCode& code, Span span, std::string message) {
    return diagnostics.report(code, span, std::move(message));
  }
};

inline Identifier identifier(const Token* token) { return {token->name(), token->span}; }
inline Span cover(const Token* first, const Token* last) {
  return base::cover(first->span, last->span);
}

}  // namespace perentie::parser

#include "perentie/parser/dump.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dump/node_view.hpp"
#include "perentie/parser/spelling.hpp"
#include "print/printer.hpp"

namespace perentie::parser {
namespace {

/// The value of a token that has one, after a blank.
std::string token_value(const Token& token, const TokenStream& stream,
                        const base::Interner& names) {
  switch (token.kind) {
    case TokenKind::identifier:
      return fmt::format(" {}", names[token.name()]);
    case TokenKind::string:
    case TokenKind::include_:
    case TokenKind::print_:
      return fmt::format(" {}", quote(names[token.name()]));
    case TokenKind::integer:
      return fmt::format(" {}", stream.integers[token.value]);
    case TokenKind::character:
      return fmt::format(" {}", quote(static_cast<char>(token.value)));
    case TokenKind::refines:
    case TokenKind::property_model:
      return fmt::format(" {}", spelling(static_cast<Model>(token.value)));
    case TokenKind::property:
      return fmt::format(" {}", spelling(static_cast<PropertyWord>(token.value)));
    case TokenKind::property_reduction:
      return fmt::format(" {}", spelling(static_cast<PartialOrderMode>(token.value)));
    default:
      return {};
  }
}

/// Positions of ascending offsets: each goes on counting from the one before.
class PositionCursor {
 public:
  explicit PositionCursor(const base::SourceMap& sources) : sources_(sources) {}

  const base::Position& at(base::Offset offset) {
    if (offset < offset_ || offset > file_.end) {
      file_ = sources_.span(sources_.file_of(offset));
      position_ = sources_.position(offset);
    } else {
      for (const char c : sources_.text({offset_, offset})) {
        const bool starts_character = (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
        position_.line += c == '\n' ? 1 : 0;
        position_.column = c == '\n' ? 1 : position_.column + (starts_character ? 1 : 0);
      }
    }
    offset_ = offset;
    return position_;
  }

 private:
  const base::SourceMap& sources_;
  base::Offset offset_ = 1;  // beyond the empty file: the first look-up starts anew
  base::Span file_{};
  base::Position position_{};
};

std::string dump_node(const SyntaxTree& tree, const NodeRef& root, const base::SourceMap& sources) {
  struct Pending {
    Child child;
    std::size_t depth;
  };
  std::string out;
  PositionCursor positions(sources);
  std::vector<Pending> pending{{{{}, root}, 0}};
  while (!pending.empty()) {
    const Pending next = pending.back();
    pending.pop_back();
    const NodeView node = view(tree, next.child.node);
    // Chains may be deep: indentation stops growing where no one could follow it.
    constexpr std::size_t deepest = 200;
    out.append(2 * std::min(next.depth, deepest), ' ');
    if (!next.child.role.empty()) out += fmt::format("{}: ", next.child.role);
    out += node.label;
    if (node.span) {
      const base::Position at = positions.at(node.span->begin);
      const bool elsewhere = sources.file_of(node.span->begin) != base::FileId{0};
      out += elsewhere ? fmt::format(" @{}:{}:{}", at.path, at.line, at.column)
                       : fmt::format(" @{}:{}", at.line, at.column);
    }
    out.push_back('\n');
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      pending.push_back({*child, next.depth + 1});
    }
  }
  return out;
}

bool same_node(const SyntaxTree& a, const NodeRef& in_a, const SyntaxTree& b, const NodeRef& in_b) {
  std::vector<std::pair<NodeRef, NodeRef>> pending{{in_a, in_b}};
  while (!pending.empty()) {
    const auto [left, right] = pending.back();
    pending.pop_back();
    const NodeView l = view(a, left);
    const NodeView r = view(b, right);
    if (left.index() != right.index() || l.label != r.label ||
        l.children.size() != r.children.size()) {
      return false;
    }
    for (std::size_t i = 0; i < l.children.size(); ++i) {
      if (l.children[i].role != r.children[i].role) return false;
      pending.emplace_back(l.children[i].node, r.children[i].node);
    }
  }
  return true;
}

}  // namespace

std::string dump_tokens(const TokenStream& stream, const base::Interner& names,
                        const base::SourceMap& sources) {
  std::string out;
  PositionCursor positions(sources);
  for (const Token& token : stream.tokens) {
    const base::Position at = positions.at(token.span.begin);
    std::string_view id = info(token.kind).id;
    if (id.ends_with('_')) id.remove_suffix(1);
    out += fmt::format("{}:{} {}{}\n", at.line, at.column, id, token_value(token, stream, names));
  }
  return out;
}

std::string dump_ast(const SyntaxTree& tree, const base::SourceMap& sources) {
  return dump_node(tree, std::monostate{}, sources);
}
std::string dump_ast(const SyntaxTree& tree, ExprId expression, const base::SourceMap& sources) {
  return dump_node(tree, expression, sources);
}
std::string dump_ast(const SyntaxTree& tree, const Assertion& assertion,
                     const base::SourceMap& sources) {
  return dump_node(tree, &assertion, sources);
}

bool same_tree(const SyntaxTree& a, const SyntaxTree& b) {
  return same_node(a, std::monostate{}, b, std::monostate{});
}
bool same_tree(const SyntaxTree& a, ExprId in_a, const SyntaxTree& b, ExprId in_b) {
  return same_node(a, in_a, b, in_b);
}
bool same_tree(const SyntaxTree& a, const Assertion& in_a, const SyntaxTree& b,
               const Assertion& in_b) {
  return same_node(a, &in_a, b, &in_b);
}

}  // namespace perentie::parser

// The evidence flows from uses to definitions (an operand of `[]` is a process) and from
// definitions to their callers (a constant that equals a process is one), until nothing changes.
#include "process_kinds.hpp"

#include <algorithm>
#include <vector>

#include "perentie/base/overload.hpp"

namespace perentie::semantics {
namespace {

using base::overload;
using parser::ExprId;
using parser::InfixOp;

class ProcessMarker {
 public:
  ProcessMarker(const parser::SyntaxTree& tree, Resolution& resolution)
      : tree_(tree), resolution_(resolution) {}

  void run() {
    collect_definitions();
    for (std::uint32_t i = 0; i < tree_.exprs.size(); ++i) mark_operands(ExprId{i});
    for (bool changed = true; changed;) {
      changed = false;
      for (const Definition& definition : definitions_) {
        if (resolution_.symbols[definition.symbol].is_process) continue;
        if (!std::any_of(definition.leaves.begin(), definition.leaves.end(),
                         [&](ExprId leaf) { return is_process(leaf); })) {
          continue;
        }
        mark(definition.symbol);
        changed = true;
      }
      changed = changed || std::exchange(marked_by_use_, false);
    }
  }

 private:
  struct Definition {
    SymbolId symbol;
    std::vector<ExprId>
        leaves;  // what the definition may evaluate to: its bodies through if and let
  };

  void collect_definitions() {
    for (std::uint32_t i = 0; i < tree_.decls.size(); ++i) {
      std::visit(overload{
                     [&](const parser::PatternDecl& d) {
                       const bool is_name = std::holds_alternative<parser::NamePattern>(
                           tree_.patterns[d.pattern].node);
                       const SymbolId symbol = resolution_.of_pattern[d.pattern.value];
                       if (is_name && symbol) add_definition(symbol, {d.value});
                     },
                     [&](const parser::FunctionDecl& d) {
                       std::vector<ExprId> bodies;
                       for (const parser::Clause& c : tree_.list(d.clauses))
                         bodies.push_back(c.body);
                       if (const SymbolId symbol = resolution_.of_decl[i]) {
                         add_definition(symbol, std::move(bodies));
                       }
                     },
                     [](const auto&) {},
                 },
                 tree_.decls[parser::DeclId{i}].node);
    }
  }

  void add_definition(SymbolId symbol, std::vector<ExprId> bodies) {
    definitions_.push_back({symbol, leaves(std::move(bodies))});
  }

  // The expressions that `roots` may evaluate to, looking through `if` and `let`.
  std::vector<ExprId> leaves(std::vector<ExprId> stack) const {
    std::vector<ExprId> found;
    while (!stack.empty()) {
      const ExprId id = stack.back();
      stack.pop_back();
      if (const auto* e = std::get_if<parser::IfExpr>(&tree_.exprs[id].node)) {
        stack.push_back(e->then_branch);
        stack.push_back(e->else_branch);
      } else if (const auto* let = std::get_if<parser::LetExpr>(&tree_.exprs[id].node)) {
        stack.push_back(let->body);
      } else {
        found.push_back(id);
      }
    }
    return found;
  }

  static bool is_process_operator(InfixOp op) {
    return op == InfixOp::guard || (op >= InfixOp::sequential && op <= InfixOp::project);
  }

  // The symbol that a leaf names or calls, and how many argument groups it gives.
  struct Use {
    SymbolId symbol;
    std::uint32_t groups = 0;
  };
  Use use_of(ExprId id) const {
    std::uint32_t groups = 0;
    while (const auto* e = std::get_if<parser::ApplyExpr>(&tree_.exprs[id].node)) {
      ++groups;
      id = e->function;
    }
    const bool is_name = std::holds_alternative<parser::NameExpr>(tree_.exprs[id].node);
    return {is_name ? resolution_.of_expr[id.value] : SymbolId{}, groups};
  }

  bool is_process(ExprId leaf) const {
    return std::visit(overload{
                          [](const parser::PrefixExpr&) { return true; },
                          [](const parser::ParallelExpr&) { return true; },
                          [](const parser::AlphabetParallelExpr&) { return true; },
                          [](const parser::ExceptionExpr&) { return true; },
                          [](const parser::SyncChoiceExpr&) { return true; },
                          [](const parser::SyncInterruptExpr&) { return true; },
                          [](const parser::LinkParallelExpr&) { return true; },
                          [](const parser::RenameExpr&) { return true; },
                          [](const parser::ReplicatedExpr&) { return true; },
                          [](const parser::ReplicatedLinkExpr&) { return true; },
                          [](const parser::InfixExpr& e) { return is_process_operator(e.op); },
                          [&](const auto&) {
                            const Use use = use_of(leaf);
                            return use.symbol && resolution_.symbols[use.symbol].is_process &&
                                   use.groups == resolution_.symbols[use.symbol].groups;
                          },
                      },
                      tree_.exprs[leaf].node);
  }

  void mark(SymbolId symbol) { resolution_.symbols[symbol].is_process = true; }

  // What stands in the place of a process is one.
  void mark_use(ExprId expr) {
    for (const ExprId leaf : leaves({expr})) {
      const Use use = use_of(leaf);
      if (!use.symbol) continue;
      const Symbol& symbol = resolution_.symbols[use.symbol];
      const bool is_definition =
          symbol.kind == SymbolKind::constant || symbol.kind == SymbolKind::function;
      if (!is_definition || symbol.is_process || use.groups != symbol.groups) continue;
      mark(use.symbol);
      marked_by_use_ = true;
    }
  }

  void mark_operands(ExprId id) {
    const auto both = [&](const auto& e) {
      mark_use(e.left);
      mark_use(e.right);
    };
    std::visit(overload{
                   [&](const parser::PrefixExpr& e) { mark_use(e.body); },
                   [&](const parser::InfixExpr& e) {
                     if (!is_process_operator(e.op)) return;
                     if (e.op != InfixOp::guard) mark_use(e.left);
                     if (e.op != InfixOp::hide && e.op != InfixOp::project) mark_use(e.right);
                   },
                   [&](const parser::ParallelExpr& e) { both(e); },
                   [&](const parser::AlphabetParallelExpr& e) { both(e); },
                   [&](const parser::ExceptionExpr& e) { both(e); },
                   [&](const parser::SyncChoiceExpr& e) { both(e); },
                   [&](const parser::SyncInterruptExpr& e) { both(e); },
                   [&](const parser::LinkParallelExpr& e) { both(e); },
                   [&](const parser::RenameExpr& e) { mark_use(e.process); },
                   [&](const parser::ReplicatedExpr& e) { mark_use(e.body); },
                   [&](const parser::ReplicatedLinkExpr& e) { mark_use(e.body); },
                   [](const auto&) {},
               },
               tree_.exprs[id].node);
  }

  const parser::SyntaxTree& tree_;
  Resolution& resolution_;
  std::vector<Definition> definitions_;
  bool marked_by_use_ = false;
};

}  // namespace

void mark_processes(const parser::SyntaxTree& tree, Resolution& resolution) {
  ProcessMarker(tree, resolution).run();
}

}  // namespace perentie::semantics

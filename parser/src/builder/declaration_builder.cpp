#include "builder/declaration_builder.hpp"

#include <algorithm>
#include <unordered_set>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "perentie/base/overload.hpp"
#include "perentie/parser/diagnostic_codes.hpp"

namespace perentie::parser {
namespace {

/// Where a kind of declaration may stand besides the script itself.
struct Placement {
  std::string_view what;
  bool let;
  bool timed_section;
  bool module;
};

Placement placement(const Decl& decl) {
  return std::visit(
      base::overload{
          [](const ChannelDecl&) {
            return Placement{"a channel", false, true, true};
          },
          [](const DatatypeDecl& d) {
            return Placement{d.is_subtype ? "a subtype" : "a datatype", false, true, true};
          },
          [](const NametypeDecl&) {
            return Placement{"a nametype", false, true, true};
          },
          [](const InstanceDecl&) {
            return Placement{"a module instance", false, true, true};
          },
          [](const ModuleDecl&) {
            return Placement{"a module", false, true, true};
          },
          [](const AssertDecl&) {
            return Placement{"an assertion", false, true, false};
          },
          [](const PrintDecl&) {
            return Placement{"a print line", false, false, false};
          },
          [](const auto&) {
            return Placement{"", true, true, true};
          },
      },
      decl.node);
}

}  // namespace

void DeclarationBuilder::declare(Decl decl) {
  const Placement p = placement(decl);
  const bool fits = in_let()                         ? p.let
                    : place_ == Place::module        ? p.module
                    : place_ == Place::timed_section ? p.timed_section
                                                     : true;
  if (!fits) {
    const std::string_view block = in_let()                  ? "`let`"
                                   : place_ == Place::module ? "a module"
                                                             : "a timed section";
    context_->report(codes::misplaced_declaration, decl.span,
                     fmt::format("{} cannot stand inside {}", p.what, block));
  }
  declarations_.push_back(std::move(decl));
}

void DeclarationBuilder::set_span(Span span) {
  Decl& last = declarations_.back();
  last.span = span;
  if (const auto* function = std::get_if<FunctionDecl>(&last.node)) {
    clauses_[function->clauses.first].span = span;
  }
}

// ---------------------------------------------------------------------------------------------
// Definitions

void DeclarationBuilder::definition(ExprId left, DefinitionRest rest) {
  if (rest.type) return annotate(left, rest);
  if (std::holds_alternative<ApplyExpr>(context_->tree.exprs[left].node)) {
    return define_function(left, rest.value);
  }
  const Span span = context_->tree.exprs[left].span;
  declare({span, PatternDecl{converter_->pattern(left), rest.value}});
}

// `f(p..)(q..)` was read as a call of a call; its argument lists are the groups of parameters.
void DeclarationBuilder::define_function(ExprId left, ExprId value) {
  SyntaxTree& tree = context_->tree;
  std::vector<ExprList> groups;
  ExprId function = left;
  while (const auto* call = std::get_if<ApplyExpr>(&tree.exprs[function].node)) {
    groups.push_back(call->arguments);
    function = call->function;
  }
  const Span span = tree.exprs[left].span;
  const std::optional<Identifier> name = plain_name(function, "define");
  if (!name) throw Abandoned{};

  std::vector<std::uint32_t> sizes;
  const std::size_t mark = context_->scratch.mark<PatternId>();
  for (auto group = groups.rbegin(); group != groups.rend(); ++group) {
    sizes.push_back(group->count);
    for (std::uint32_t i = 0; i < group->count; ++i) {
      context_->scratch.push(converter_->pattern(tree.list(*group)[i]));
    }
  }
  const PatternList parameters = context_->scratch.take<PatternId>(tree, mark);
  const auto index = static_cast<std::uint32_t>(clauses_.size());
  clauses_.push_back({span, tree.size_lists.add(sizes), parameters, value});
  declare({span, FunctionDecl{*name, {index, 1}}});
}

void DeclarationBuilder::annotate(ExprId left, const DefinitionRest& rest) {
  const std::optional<Identifier> first = plain_name(left, "annotate");
  if (!first) throw Abandoned{};
  std::vector<Identifier> names{*first};
  const std::span<const Identifier> more = context_->tree.list(rest.more_names);
  names.insert(names.end(), more.begin(), more.end());
  declare({first->span, AnnotationDecl{context_->tree.identifier_lists.add(names), rest.constraints,
                                       rest.type}});
}

std::optional<Identifier> DeclarationBuilder::plain_name(ExprId e, std::string_view purpose) {
  const Expr& expr = context_->tree.exprs[e];
  const auto* name = std::get_if<NameExpr>(&expr.node);
  if (name == nullptr) {
    context_->report(codes::not_definable, expr.span,
                     fmt::format("only a name can be {}d here", purpose));
    return std::nullopt;
  }
  const std::span<const NameId> parts = context_->tree.list(name->name);
  if (parts.size() > 1) {
    context_->report(codes::not_definable, expr.span,
                     fmt::format("a qualified name cannot be {}d: this can only be done inside "
                                 "its module",
                                 purpose));
    return std::nullopt;
  }
  return Identifier{parts[0], expr.span};
}

// ---------------------------------------------------------------------------------------------
// The other declarations

void DeclarationBuilder::channel(const Token* keyword, IdentifierList names,
                                 std::optional<ExprId> type) {
  declare({keyword->span, ChannelDecl{names, type.value_or(ExprId{})}});
}

Constructor DeclarationBuilder::constructor(const Token* name, std::optional<ExprId> type) const {
  return {identifier(name), type.value_or(ExprId{})};
}

void DeclarationBuilder::datatype(const Token* keyword, const Token* name,
                                  ListRef<Constructor> constructors) {
  const bool is_subtype = keyword->kind == TokenKind::subtype_;
  declare({keyword->span, DatatypeDecl{identifier(name), constructors, is_subtype}});
}

void DeclarationBuilder::nametype(const Token* keyword, const Token* name, ExprId type) {
  declare({keyword->span, NametypeDecl{identifier(name), type}});
}

void DeclarationBuilder::import(const Token* keyword, IdentifierList names) {
  declare({keyword->span, ImportDecl{keyword->kind == TokenKind::external_, names}});
}

void DeclarationBuilder::instance(const Token* keyword, const Token* name,
                                  const Token* module_first, QualifiedName module,
                                  std::optional<ExprList> arguments) {
  const Token* module_last = module_first + 2 * (module.parts.count - 1);
  declare({keyword->span, InstanceDecl{identifier(name), module, cover(module_first, module_last),
                                       arguments.value_or(ExprList{})}});
}

void DeclarationBuilder::assertion(const Token* keyword, const Assertion& assertion) {
  declare({keyword->span, AssertDecl{assertion}});
}

void DeclarationBuilder::print(const Token* token, ExprId expression) {
  declare({token->span, PrintDecl{token->name(), expression}});
}

void DeclarationBuilder::timed(Span span, ExprId duration, DeclList declarations) {
  declare({span, TimedDecl{duration, declarations}});
}

void DeclarationBuilder::module(Span span, Identifier name, PatternList parameters, DeclList hidden,
                                DeclList exported) {
  declare({span, ModuleDecl{name, parameters, hidden, exported}});
}

// ---------------------------------------------------------------------------------------------
// Lists of declarations

DeclList DeclarationBuilder::take(Mark mark) {
  check_annotated_channels(mark.declarations);
  std::vector<DeclId> ids;
  for (std::size_t i = mark.declarations; i < declarations_.size();) {
    std::size_t next = i + 1;
    while (next < declarations_.size() && continues(declarations_[i], declarations_[next])) ++next;
    if (std::holds_alternative<FunctionDecl>(declarations_[i].node)) {
      ids.push_back(take_function(i, next));
    } else {
      ids.push_back(context_->tree.decls.add(std::move(declarations_[i])));
    }
    i = next;
  }
  drop(mark);
  return context_->tree.decl_lists.add(ids);
}

void DeclarationBuilder::drop(Mark mark) {
  if (mark.declarations < declarations_.size()) declarations_.resize(mark.declarations);
  if (mark.clauses < clauses_.size()) clauses_.resize(mark.clauses);
}

// Clauses of one function follow each other directly and stand in the same file (2.2.3).
bool DeclarationBuilder::continues(const Decl& first, const Decl& next) const {
  const auto* f = std::get_if<FunctionDecl>(&first.node);
  const auto* g = std::get_if<FunctionDecl>(&next.node);
  return f != nullptr && g != nullptr && f->name.name == g->name.name &&
         context_->sources.file_of(first.span.begin) == context_->sources.file_of(next.span.begin);
}

DeclId DeclarationBuilder::take_function(std::size_t first, std::size_t last) {
  std::vector<Clause> clauses;
  for (std::size_t i = first; i < last; ++i) {
    clauses.push_back(clauses_[std::get<FunctionDecl>(declarations_[i].node).clauses.first]);
  }
  const Span span = base::cover(declarations_[first].span, declarations_[last - 1].span);
  const Identifier name = std::get<FunctionDecl>(declarations_[first].node).name;
  return context_->tree.decls.add(
      {span, FunctionDecl{name, context_->tree.clause_lists.add(clauses)}});
}

// An annotation gives one channel its type, so channels annotated apart are declared apart (2.2.5).
void DeclarationBuilder::check_annotated_channels(std::size_t first) {
  std::unordered_set<NameId> annotated;
  for (std::size_t i = first; i < declarations_.size(); ++i) {
    const auto* annotation = std::get_if<AnnotationDecl>(&declarations_[i].node);
    if (annotation == nullptr) continue;
    for (const Identifier& name : context_->tree.list(annotation->names)) {
      annotated.insert(name.name);
    }
  }
  if (annotated.empty()) return;
  for (std::size_t i = first; i < declarations_.size(); ++i) {
    const auto* channels = std::get_if<ChannelDecl>(&declarations_[i].node);
    if (channels == nullptr) continue;
    const std::span<const Identifier> names = context_->tree.list(channels->names);
    const auto count = std::count_if(names.begin(), names.end(), [&](const Identifier& name) {
      return annotated.contains(name.name);
    });
    if (count < 2) continue;
    context_->report(codes::annotated_channels, declarations_[i].span,
                     "channels with type annotations are declared one by one");
  }
}

}  // namespace perentie::parser

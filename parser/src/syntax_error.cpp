#include "syntax_error.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "perentie/parser/diagnostic_codes.hpp"
#include "recovery.hpp"

namespace perentie::parser {
namespace {

using K = TokenKind;
using grammar::SyntaxError;

bool is_closing(K kind) {
  switch (kind) {
    case K::right_paren:
    case K::right_brace:
    case K::right_productions:
    case K::right_map:
    case K::right_sequence:
    case K::right_rename:
    case K::right_parallel:
    case K::right_exception:
    case K::right_bracket:
    case K::right_sync:
    case K::right_interrupt:
    case K::within_:
      return true;
    default:
      return false;
  }
}

bool is_opening(K kind) {
  switch (kind) {
    case K::left_paren:
    case K::left_brace:
    case K::left_productions:
    case K::left_map:
    case K::left_sequence:
    case K::left_rename:
    case K::left_parallel:
    case K::left_bracket:
    case K::left_sync:
    case K::left_interrupt:
    case K::let_:
      return true;
    default:
      return false;
  }
}

bool is_keyword(K kind) { return info(kind).token_class == TokenClass::keyword; }

bool starts_operand(K kind) {
  return info(kind).ends_operand ? !is_closing(kind) : is_opening(kind) || kind == K::length;
}

bool touch(const Token& a, const Token& b) { return a.span.end == b.span.begin; }

/// The innermost bracket (or `let`) between `first` and `where` that nothing closes before `where`.
const Token* open_bracket(const Token* first, const Token* where) {
  std::vector<const Token*> open;
  for (const Token* t = first; t < where; ++t) {
    if (is_opening(t->kind)) open.push_back(t);
    if (is_closing(t->kind) && !open.empty()) open.pop_back();
  }
  return open.empty() ? nullptr : open.back();
}

/// What may be wrong, as the pieces of advice look at it.
struct Scene {
  const SyntaxError& error;
  const Token* first;     // of the declaration
  const Token* where;     // the unexpected token
  const Token* previous;  // null at the start of the declaration
  const Token* before;    // the one before that, or null
  const Token* line;      // the first token on the line of `where`

  bool expects(std::string_view text) const { return error.expected == text; }
  bool after(K kind) const { return previous != nullptr && previous->kind == kind; }
  bool found(K kind) const { return where->kind == kind; }
  bool begins_with(K kind) const { return first->kind == kind; }
};

struct Advice {
  bool (*applies)(const Scene&);
  std::string_view text;
};

// The typical slips. The first that applies is given.
constexpr Advice all_advice[] = {
    {[](const Scene& s) { return s.found(K::guard) && s.after(K::guard); },
     "conjunction is written `and`"},
    {[](const Scene& s) { return s.found(K::alphabet_parallel) && s.after(K::left_paren); },
     "the empty map is written `(| |)`"},
    {[](const Scene& s) {
       return s.found(K::right_paren) && s.after(K::alphabet_parallel) && s.before != nullptr &&
              s.before->kind == K::left_paren;
     },
     "the empty map is written `(| |)`"},
    {[](const Scene& s) {
       return s.found(K::alphabet_parallel) && s.previous != nullptr &&
              info(s.previous->kind).ends_operand;
     },
     "disjunction is written `or`; parallel composition names its alphabets: `P [A || B] Q`"},
    {[](const Scene& s) { return s.found(K::output) && s.expects("an expression"); },
     "negation is written `not`"},
    {[](const Scene& s) { return s.found(K::bar) && s.after(K::left_paren); },
     "a map is written `(| k => v |)`, with a blank after `(|`"},
    {[](const Scene& s) { return s.found(K::greater) && s.after(K::less); },
     "inequality is written `!=`"},
    {[](const Scene& s) { return s.found(K::define) && s.after(K::define); },
     "equality is written `==`, without a blank"},
    {[](const Scene& s) {
       return s.found(K::define) && s.begins_with(K::assert_) && s.before != nullptr &&
              s.before->kind == K::left_bracket;
     },
     "the signs of refinement are `[T=`, `[F=`, `[FD=`, `[V=`, `[VD=`, `[R=` and `[RD=`"},
    {[](const Scene& s) {
       return s.found(K::define) && s.previous == s.first && is_keyword(s.first->kind);
     },
     "the word is reserved and cannot be defined"},
    {[](const Scene& s) { return s.found(K::define) && s.line == s.first; },
     "`=` makes a definition; equality is written `==`"},
    {[](const Scene& s) { return s.found(K::annotate) && s.after(K::identifier); },
     "a qualified name has no blanks around `::`"},
    {[](const Scene& s) {
       return s.found(K::right_paren) && s.after(K::left_paren) && s.begins_with(K::module_);
     },
     "a module without parameters is written `module M`"},
    {[](const Scene& s) {
       return s.found(K::right_paren) && s.after(K::left_paren) && s.begins_with(K::instance_);
     },
     "an instance without arguments is written `instance N = M`"},
    {[](const Scene& s) {
       return s.after(K::right_sequence) &&
              (starts_operand(s.where->kind) || s.found(K::subtract) || s.found(K::right_sequence));
     },
     "inside `<..>` a `>` closes the sequence: write comparisons there in parentheses, `(x > 2)`"},
    {[](const Scene& s) {
       return s.after(K::wildcard) && s.found(K::identifier) && touch(*s.previous, *s.where);
     },
     "a name begins with a letter"},
    {[](const Scene& s) {
       return s.after(K::integer) && s.found(K::identifier) && touch(*s.previous, *s.where);
     },
     "a name begins with a letter, and multiplication is written `*`"},
    {[](const Scene& s) { return s.after(K::character) && s.found(K::character); },
     "a text of several characters is a string: `\"..\"`"},
    {[](const Scene& s) { return s.expects("`else`"); }, "every `if` has an `else`"},
    {[](const Scene& s) {
       return s.expects("a name") && is_keyword(s.where->kind) && s.where != s.line;
     },
     "the word is reserved"},
    {[](const Scene& s) {
       return s.found(K::right_sequence) && s.expects("an expression") && s.after(K::left_sequence);
     },
     "the trace to look for has at least one event"},
    {[](const Scene& s) {
       return s.expects("`=`") && (s.begins_with(K::subtract) || s.begins_with(K::left_sequence) ||
                                   s.begins_with(K::left_paren) || s.begins_with(K::left_brace) ||
                                   s.begins_with(K::length));
     },
     "a line that begins like this begins a declaration; to go on with the line before, end that "
     "with the operator"},
};

/// A block that may not stand in `let`, or cannot be read as a declaration there.
std::string_view block_name(K kind) {
  switch (kind) {
    case K::module_:
      return "a module";
    case K::print_:
      return "a print line";
    case K::include_:
      return "an include";
    default:
      return {};
  }
}

std::string quote_text(const Token& token, const base::SourceMap& sources) {
  constexpr std::size_t longest = 40;
  const std::string_view text = sources.text(token.span);
  if (text.size() <= longest) return fmt::format("`{}`", text);
  return fmt::format("`{}..`", text.substr(0, longest));
}

/// "`foo`", "the end of the line".
std::string describe_found(const Token& token, const base::SourceMap& sources) {
  switch (token.kind) {
    case K::identifier:
    case K::integer:
    case K::character:
    case K::string:
    case K::property:
    case K::property_model:
    case K::property_reduction:
    case K::property_close:
    case K::refines:
      return quote_text(token, sources);
    default:
      return describe(token.kind);
  }
}

}  // namespace

std::optional<const Token*> attempt(Builder& builder, const Token* first,
                                    const std::function<void()>& read) {
  std::optional<const Token*> failure;
  BuildContext& context = builder.context;
  try {
    read();
    builder.converter.report_suspects();
  } catch (const SyntaxError& error) {
    report_syntax_error(error, first, builder.declarations.in_let(), context);
    failure = error.where;
  } catch (const TooDeep& error) {
    context.report(codes::too_deep, error.where->span,
                   fmt::format("this is nested deeper than {} levels", context.max_depth));
    failure = error.where;
  } catch (const Abandoned&) {
    failure = first;
  }
  builder.abandon();
  return failure;
}

void report_syntax_error(const SyntaxError& error, const Token* first, bool in_let,
                         BuildContext& context) {
  const Token* where = error.where;
  const Scene scene{error,
                    first,
                    where,
                    where > first ? where - 1 : nullptr,
                    where > first + 1 ? where - 2 : nullptr,
                    first_of_line(first, where, context.sources)};
  if (scene.found(K::error) || scene.after(K::error)) return;
  // Reading goes on at the line of an error that ended what began before it.
  if (std::exchange(context.last_error, where) == where) return;

  const std::string_view block = block_name(where->kind);
  if (in_let && !block.empty()) {
    context.report(codes::misplaced_declaration, where->span,
                   fmt::format("{} cannot stand inside `let`", block));
    return;
  }

  const Token* open = open_bracket(first, where);
  const std::string found = describe_found(*where, context.sources);
  if (open == nullptr && is_closing(where->kind)) {
    context.report(codes::unopened_bracket, where->span,
                   where->kind == K::within_
                       ? "`within` without a `let` before it"
                       : fmt::format("nothing is open that {} closes", found));
    return;
  }

  std::string message = fmt::format("expected {}", error.expected);
  if (scene.previous != nullptr && scene.previous->kind != K::newline) {
    message += fmt::format(" after {}", describe_found(*scene.previous, context.sources));
  }
  message += fmt::format(", found {}", found);
  base::Diagnostic& diagnostic =
      context.report(codes::unexpected_token, where->span, std::move(message));

  const auto* advice = std::find_if(std::begin(all_advice), std::end(all_advice),
                                    [&](const Advice& a) { return a.applies(scene); });
  if (advice != std::end(all_advice)) {
    diagnostic.notes.push_back({std::nullopt, std::string(advice->text)});
  }
  // Unless the bracket is right before our eyes.
  const bool runs_out = scene.found(K::newline) || scene.found(K::end_of_file) ||
                        is_closing(where->kind) || is_keyword(where->kind) ||
                        scene.found(K::define);
  if (open != nullptr && runs_out && open != scene.previous) {
    diagnostic.notes.push_back({open->span, fmt::format("{} is still open", describe(open->kind))});
  } else if (scene.line != first && info((scene.line - 1)->kind).soaks_after &&
             (where == scene.line || scene.found(K::define) || scene.found(K::annotate))) {
    const Token& last = *(scene.line - 1);
    diagnostic.notes.push_back(
        {last.span, fmt::format("the line before ends with {} and so goes on here",
                                describe_found(last, context.sources))});
  }
}

}  // namespace perentie::parser

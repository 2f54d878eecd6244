#include "perentie/parser/parse.hpp"

#include "builder/builder.hpp"
#include "includes.hpp"
#include "script_parser.hpp"
#include "whole_text.hpp"

namespace perentie::parser {

SyntaxTree parse_script(base::FileId root, base::SourceMap& sources, base::Diagnostics& diagnostics,
                        const ParseOptions& options) {
  SyntaxTree tree;
  tree.declarations = parse_declarations(root, tree, sources, diagnostics, options);
  return tree;
}

DeclList parse_declarations(base::FileId root, SyntaxTree& tree, base::SourceMap& sources,
                            base::Diagnostics& diagnostics, const ParseOptions& options) {
  const TokenStream stream =
      lex_with_includes(root, sources, tree.names, diagnostics, options.load);
  Builder builder({tree, sources, diagnostics, stream, options.max_depth});
  return ScriptParser(builder).parse();
}

ExprId parse_expression(base::FileId text, SyntaxTree& tree, const base::SourceMap& sources,
                        base::Diagnostics& diagnostics, const ParseOptions& options) {
  const std::size_t errors = diagnostics.error_count();
  const TokenStream stream = lex_stretch(sources.span(text), sources, tree.names, diagnostics);
  Builder builder({tree, sources, diagnostics, stream, options.max_depth});
  const ExprId result = read_whole_expression(builder);
  return diagnostics.error_count() > errors ? ExprId{} : result;
}

std::optional<Assertion> parse_assertion(base::FileId text, SyntaxTree& tree,
                                         const base::SourceMap& sources,
                                         base::Diagnostics& diagnostics,
                                         const ParseOptions& options) {
  const std::size_t errors = diagnostics.error_count();
  const TokenStream stream = lex_stretch(sources.span(text), sources, tree.names, diagnostics);
  Builder builder({tree, sources, diagnostics, stream, options.max_depth});
  const std::optional<Assertion> result = read_whole_assertion(builder);
  return diagnostics.error_count() > errors ? std::nullopt : result;
}

}  // namespace perentie::parser

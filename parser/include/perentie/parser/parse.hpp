// The public face of the parser: text to syntax tree.
//
// A script is read with its includes. Errors go to the diagnostics, as many as there are: after one
// the parser goes on at the next declaration, which the tree then lacks. A tree is good for the
// next step only if no errors were reported.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/source.hpp"
#include "perentie/parser/ast.hpp"

namespace perentie::parser {

struct ParseOptions {
  /// How an include is read. Paths are tried relative to the folder of the script, then to the
  /// including file (2.8).
  std::function<base::FileText(const std::string& path)> load = base::read_file;
  /// How deep brackets, `let`, `if`, lambdas, replicated and unary operators may nest together.
  /// Chains of infix operators, calls and renamings do not count, and may be of any length. The
  /// default takes about half of a stack of 8 MB in an unoptimised build with sanitizers.
  std::uint32_t max_depth = 256;
};

SyntaxTree parse_script(base::FileId root, base::SourceMap& sources, base::Diagnostics& diagnostics,
                        const ParseOptions& options = {});

/// Adds the declarations of a text, read like a script, to an existing tree.
DeclList parse_declarations(base::FileId root, SyntaxTree& tree, base::SourceMap& sources,
                            base::Diagnostics& diagnostics, const ParseOptions& options = {});

/// Adds one expression, which is all of the text, to an existing tree. None after an error.
ExprId parse_expression(base::FileId text, SyntaxTree& tree, const base::SourceMap& sources,
                        base::Diagnostics& diagnostics, const ParseOptions& options = {});

/// An assertion with or without the leading word `assert`. Nothing after an error.
std::optional<Assertion> parse_assertion(base::FileId text, SyntaxTree& tree,
                                         const base::SourceMap& sources,
                                         base::Diagnostics& diagnostics,
                                         const ParseOptions& options = {});

}  // namespace perentie::parser

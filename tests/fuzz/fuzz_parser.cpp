// Any text is parsed or refused; what is parsed prints as a text that parses to the same tree.
#include "fuzz_support.hpp"
#include "perentie/parser/dump.hpp"
#include "perentie/parser/print.hpp"

using namespace perentie;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const auto parse = [&](std::string name, std::string text) {
    const auto file = sources.add(std::move(name), std::move(text));
    return file ? parser::parse_script(*file, sources, diagnostics, fuzz::without_includes())
                : parser::SyntaxTree{};
  };
  const parser::SyntaxTree tree = parse("input.csp", fuzz::text_of(data, size));
  fuzz::render(diagnostics, sources);
  if (diagnostics.has_errors()) return 0;
  parser::dump_ast(tree, sources);
  const parser::SyntaxTree again = parse("printed.csp", parser::print_script(tree));
  PERENTIE_CHECK(!diagnostics.has_errors(), "what was printed does not parse");
  PERENTIE_CHECK(parser::same_tree(tree, again), "what was printed parses to another tree");
  return 0;
}

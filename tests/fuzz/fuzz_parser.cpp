// Any text is parsed or refused; what is parsed prints as a text that parses to the same tree.
#include "fuzz_support.hpp"
#include "perentie/parser/dump.hpp"
#include "perentie/parser/print.hpp"

using namespace perentie;

namespace {

// The tree without the places of its nodes; nothing if the text has errors.
std::string shape_of(const std::string& text, std::string& printed) {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const auto file = sources.add("input.csp", text);
  if (!file) return {};
  const parser::SyntaxTree tree =
      parser::parse_script(*file, sources, diagnostics, fuzz::without_includes());
  fuzz::render(diagnostics, sources);
  if (diagnostics.has_errors()) return {};
  printed = parser::print_script(tree);
  return printed;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string printed;
  const std::string first = shape_of(fuzz::text_of(data, size), printed);
  if (first.empty()) return 0;
  std::string again;
  const std::string second = shape_of(printed, again);
  PERENTIE_CHECK(first == second, "what was printed does not parse to what prints the same");
  return 0;
}

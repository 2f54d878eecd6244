// Any text is loaded or refused: names resolved, types inferred, code made. Types can be shown.
#include "fuzz_support.hpp"
#include "perentie/semantics/script.hpp"

using namespace perentie;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const auto file = sources.add("input.csp", fuzz::text_of(data, size));
  if (!file) return 0;
  const auto script =
      semantics::Script::load(*file, sources, diagnostics, fuzz::without_includes());
  PERENTIE_CHECK((script != nullptr) != diagnostics.has_errors(), "loaded with errors, or not");
  if (script) {
    for (const auto& definition : script->types()) {
      PERENTIE_CHECK(!definition.type.empty(), "a definition without a type");
    }
  }
  fuzz::render(diagnostics, sources);
  return 0;
}

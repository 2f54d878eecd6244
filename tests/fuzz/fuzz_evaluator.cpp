// Everything that a script defines without parameters has a value, a diagnostic, or ends at a
// budget; processes are explored a little.
#include <chrono>

#include "fuzz_support.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/semantics/script.hpp"

using namespace perentie;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr base::Limits limits{.max_states = 200,
                                .max_memory_bytes = 200'000'000,
                                .timeout = std::chrono::milliseconds(200)};
  constexpr std::size_t most_definitions = 20;
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const auto file = sources.add("input.csp", fuzz::text_of(data, size));
  if (!file) return 0;
  const auto script =
      semantics::Script::load(*file, sources, diagnostics, fuzz::without_includes());
  if (!script) return 0;
  script->set_limits(limits);
  std::size_t count = 0;
  for (const auto& [name, type] : script->types()) {
    if (++count > most_definitions) break;
    if (type == "Proc") {
      if (const auto process = script->process(name, diagnostics)) {
        semantics::TermSystem terms = script->terms(*process, diagnostics);
        lts::explore(terms, {.limits = limits});
        script->show(*process);
      }
    } else {
      const std::size_t errors = diagnostics.error_count();
      const bool has_value = script->evaluate(name, diagnostics).has_value();
      PERENTIE_CHECK(has_value || script->limit() || diagnostics.error_count() > errors,
                     "no value, and nothing said why");
    }
  }
  fuzz::render(diagnostics, sources);
  return 0;
}

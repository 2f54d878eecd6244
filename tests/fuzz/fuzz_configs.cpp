// Any text is a configuration, a mapping or an event map, or refused with a diagnostic.
#include "fuzz_support.hpp"
#include "perentie/monitor/event_map.hpp"
#include "perentie/monitor/mapping.hpp"
#include "perentie/monitor/varanus_config.hpp"

using namespace perentie;

namespace {

template <class Parse>
void read(const std::string& text, Parse parse) {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const auto file = sources.add("input", text);
  if (!file) return;
  const bool ok = parse(*file, sources, diagnostics).has_value();
  PERENTIE_CHECK(ok != diagnostics.has_errors(), "read with errors, or not");
  fuzz::render(diagnostics, sources);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::text_of(data, size);
  read(text, monitor::parse_varanus_config);
  read(text, monitor::parse_mapping);
  read(text, monitor::parse_event_map);
  return 0;
}

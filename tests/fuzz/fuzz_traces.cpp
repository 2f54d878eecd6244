// Any bytes are read as a trace of each format, through the mappings that come with the program, or
// refused with a diagnostic.
#include "fuzz_support.hpp"
#include "perentie/monitor/event_stream.hpp"
#include "perentie/monitor/mapping.hpp"
#include "perentie/monitor/trace_reader.hpp"

using namespace perentie;

namespace {

void read(const std::string& text, monitor::TraceFormat format,
          const monitor::EventSources& events) {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  monitor::TraceReport report{"input", sources, diagnostics};
  auto reader = monitor::open_trace_text(text, monitor::reader_options(events, format), report);
  if (!reader) {
    PERENTIE_CHECK(diagnostics.has_errors(), "not opened, and nothing said why");
    return;
  }
  monitor::EventStream stream(std::move(reader), events, report);
  monitor::TraceEvent event;
  while (stream.next(event)) {
  }
  PERENTIE_CHECK(stream.failed() == diagnostics.has_errors(),
                 "failed without a diagnostic, or not");
  fuzz::render(diagnostics, sources);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static base::SourceMap sources;
  static base::Diagnostics diagnostics;
  static const auto rover = monitor::load_mapping("varanus-rover", sources, diagnostics);
  static const auto simple = monitor::load_mapping("simple", sources, diagnostics);
  PERENTIE_CHECK(rover && simple, "the mappings of the program cannot be read");
  const std::string text = fuzz::text_of(data, size);
  for (const auto format : {monitor::TraceFormat::automatic, monitor::TraceFormat::json_lines,
                            monitor::TraceFormat::json_array, monitor::TraceFormat::text}) {
    read(text, format, {.mapping = &*simple});
    read(text, format, {.mapping = &*rover, .fallback = &*simple});
  }
  return 0;
}

// Any text is read as an .aut file or refused; what is read is the same when written and read
// again.
#include <sstream>

#include "fuzz_support.hpp"
#include "perentie/lts/aut.hpp"

using namespace perentie;

namespace {

std::string written(const lts::Lts& lts) {
  std::ostringstream out;
  lts::write_aut(out, lts);
  return out.str();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const std::string text = fuzz::text_of(data, size);
  const auto lts = lts::read_aut("input.aut", text, sources, diagnostics);
  fuzz::render(diagnostics, sources);
  PERENTIE_CHECK(lts.has_value() != diagnostics.has_errors(), "read with errors, or not");
  if (!lts) return 0;
  const std::string first = written(*lts);
  const auto again = lts::read_aut("again.aut", first, sources, diagnostics);
  PERENTIE_CHECK(again.has_value(), "what was written cannot be read");
  // Labels are numbered in order of appearance, which sorting the edges changed once.
  const auto third = lts::read_aut("third.aut", written(*again), sources, diagnostics);
  PERENTIE_CHECK(third && written(*third) == written(*again), "written and read is not the same");
  return 0;
}

// What the fuzz targets share. A target is one function over bytes; it is linked with libFuzzer
// (`make fuzz`) or with run_seeds.cpp, which is the short run of every `make test`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "perentie/base/check.hpp"
#include "perentie/base/diagnostic.hpp"
#include "perentie/base/source.hpp"
#include "perentie/parser/parse.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace perentie::fuzz {

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Includes find nothing: an input is one file.
inline parser::ParseOptions without_includes() {
  return {.load = [](const std::string&) { return base::FileText{std::nullopt, "not here"}; }};
}

/// Whatever was reported can be printed.
inline void render(const base::Diagnostics& diagnostics, const base::SourceMap& sources) {
  const std::string text = base::render_all(diagnostics, sources);
  PERENTIE_CHECK(text.empty() == diagnostics.all().empty(), "a diagnostic without a message");
}

}  // namespace perentie::fuzz

// A main for a fuzz target without libFuzzer: runs it over files, and over pieces of them.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "fuzz_support.hpp"

namespace {

constexpr std::uintmax_t largest = 20'000;
// Cut off at a few places and with one byte changed: the cheapest inputs that are nearly right.
constexpr std::size_t pieces = 4;

void run(const std::string& text) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> paths(argv + 1, argv + argc);
  std::size_t inputs = 0;
  for (const std::string& path : paths) {
    if (std::filesystem::file_size(path) > largest) continue;
    const auto file = perentie::base::read_file(path);
    if (!file.text) continue;
    const std::string& text = *file.text;
    run(text);
    ++inputs;
    for (std::size_t i = 1; i < pieces && text.size() >= pieces; ++i) {
      const std::size_t at = text.size() * i / pieces;
      run(text.substr(0, at));
      std::string changed = text;
      changed[at] = "(){}<>\"\\"[i % 8];
      run(changed);
      inputs += 2;
    }
  }
  std::printf("%zu inputs\n", inputs);
  return inputs > 0 ? 0 : 1;
}

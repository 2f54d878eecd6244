// Throughput of the parser library in bytes of source a second: lexing, parsing, printing.
//
// The scripts by others are measured where they lie beside the checkout. Run in the project's root.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>
#include <string>

#include "perentie/parser/lexer.hpp"
#include "perentie/parser/parse.hpp"
#include "perentie/parser/print.hpp"

namespace perentie::parser {
namespace {

/// A script with all files it includes, read beforehand so that no disk is measured.
struct Script {
  std::string path;
  std::map<std::string, std::string> files{};
  std::size_t bytes = 0;

  base::FileText load(const std::string& file) const {
    const auto found = files.find(file);
    if (found == files.end()) return {std::nullopt, "not read beforehand"};
    return {found->second, {}};
  }
};

SyntaxTree parse(const Script& script, base::SourceMap& sources, base::Diagnostics& diagnostics) {
  ParseOptions options;
  options.load = [&](const std::string& path) { return script.load(path); };
  const base::FileId root = *sources.add(script.path, script.files.at(script.path));
  return parse_script(root, sources, diagnostics, options);
}

Script read(const std::string& path) {
  Script script{path};
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  ParseOptions options;
  options.load = [&](const std::string& file) {
    base::FileText text = base::read_file(file);
    if (text.text) script.files[file] = *text.text;
    return text;
  };
  script.files[path] = *base::read_file(path).text;
  parse_script(*sources.add(path, script.files[path]), sources, diagnostics, options);
  for (const auto& [file, text] : script.files) script.bytes += text.size();
  return script;
}

/// Every construct of the corpus over and over: no one style of writing.
Script corpus_script() {
  Script script{"corpus.csp"};
  std::string& text = script.files[script.path];
  const std::string once = *base::read_file("corpus/parser/pass/print_traps.csp").text +
                           *base::read_file("corpus/parser/pass/op_processes.csp").text +
                           *base::read_file("corpus/parser/pass/expr_prefix.csp").text;
  while (text.size() < 1'000'000) text += once;
  script.bytes = text.size();
  return script;
}

void set_bytes(benchmark::State& bench, const Script& script) {
  bench.SetBytesProcessed(bench.iterations() * static_cast<std::int64_t>(script.bytes));
}

void lex_script(benchmark::State& bench, const Script& script) {
  for (auto _ : bench) {
    base::SourceMap sources;
    base::Diagnostics diagnostics;
    base::Interner names;
    for (const auto& [path, text] : script.files) {
      const base::FileId file = *sources.add(path, text);
      benchmark::DoNotOptimize(lex(file, sources, names, diagnostics));
    }
  }
  set_bytes(bench, script);
}

void parse_whole_script(benchmark::State& bench, const Script& script) {
  for (auto _ : bench) {
    base::SourceMap sources;
    base::Diagnostics diagnostics;
    benchmark::DoNotOptimize(parse(script, sources, diagnostics));
    if (diagnostics.has_errors()) bench.SkipWithError("the script has errors");
  }
  set_bytes(bench, script);
}

void print_whole_script(benchmark::State& bench, const Script& script) {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const SyntaxTree tree = parse(script, sources, diagnostics);
  for (auto _ : bench) benchmark::DoNotOptimize(print_script(tree));
  set_bytes(bench, script);
}

void add(const std::string& name, const Script& script) {
  benchmark::RegisterBenchmark(("lex/" + name).c_str(), lex_script, script)
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("parse/" + name).c_str(), parse_whole_script, script)
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("print/" + name).c_str(), print_whole_script, script)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace perentie::parser

int main(int argc, char** argv) {
  using namespace perentie::parser;
  add("corpus", corpus_script());
  const std::string oracles = "../shared/data/varanus/oracles/";
  const std::string rover = oracles + "inspection-rover-ras/robochart-version/comparison.csp";
  const std::string mascot = oracles + "mascot-model/scenarios-stress-tests.csp";
  if (std::filesystem::exists(rover)) add("robochart_rover", read(rover));
  if (std::filesystem::exists(mascot)) add("mascot_stress", read(mascot));
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

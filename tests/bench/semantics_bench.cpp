// What evaluation and synthesis cost: small functional programs that stress one thing each, and the
// way of a rover's model from its text to its normal form.
//
// `peak_mb` is the largest resident size of the whole program so far: run one workload by itself
// (--benchmark_filter=..) to read it. ../shared is needed for nothing but two lines, which are
// left out without it.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <filesystem>
#include <memory>
#include <string>

#include "perentie/base/source.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::semantics {
namespace {

// On Linux the resident size is given in KiB.
double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// --- Functional workloads -----------------------------------------------------------------------

const char* const programs = R"(
external mtransclose
random(0, _) = <>
random(n, x) = let y = (x * 16807) % 2147483647 within <y>^random(n - 1, y)
qs(<>) = <>
qs(<x>^xs) = qs(<y | y <- xs, y < x>)^<x>^qs(<y | y <- xs, y >= x>)
sieve(<p>^xs) = <p>^sieve(<x | x <- xs, x % p != 0>)
nth(<x>^xs, n) = if n == 1 then x else nth(xs, n - 1)
fib(n) = if n < 2 then n else fib(n - 1) + fib(n - 2)
down(n) = if n == 0 then 0 else 1 + down(n - 1)
fill(m, n) = if n == 0 then m else fill(mapUpdate(m, (n * 7919) % 1000003, n), n - 1)
)";

// Evaluates `expression` with `{n}` replaced by the size.
void evaluate(benchmark::State& state, std::string expression, const std::string& expected) {
  for (std::size_t at; (at = expression.find("{n}")) != std::string::npos;) {
    expression.replace(at, 3, std::to_string(state.range(0)));
  }
  for (auto _ : state) {
    base::SourceMap sources;
    base::Diagnostics diagnostics;
    const auto file = sources.add("programs.csp", programs);
    const auto script = Script::load(*file, sources, diagnostics);
    const auto value = script->evaluate(expression, diagnostics);
    if (!value || (!expected.empty() && *value != expected)) {
      state.SkipWithError(base::render_all(diagnostics, sources).c_str());
      return;
    }
  }
  state.counters["peak_mb"] = peak_megabytes();
}

#define PERENTIE_WORKLOAD(name, ...) \
  BENCHMARK_CAPTURE(evaluate, name, __VA_ARGS__)->Unit(benchmark::kMillisecond)

PERENTIE_WORKLOAD(quicksort, "#qs(random({n}, 42))", "")->Arg(5'000)->Arg(20'000);
PERENTIE_WORKLOAD(lazy_sieve, "nth(sieve(<2..>), {n})", "")->Arg(200)->Arg(800);
PERENTIE_WORKLOAD(fibonacci, "fib({n})", "")->Arg(20)->Arg(25);
PERENTIE_WORKLOAD(recursion, "down({n})", "")->Arg(100'000)->Arg(1'000'000);
PERENTIE_WORKLOAD(power_set, "card(Set({1..{n}}))", "")->Arg(12)->Arg(16);
PERENTIE_WORKLOAD(closure, "card(mtransclose({(i, i / 2) | i <- {1..{n}}}, {0..{n}}))", "")
    ->Arg(1'000)
    ->Arg(10'000);
PERENTIE_WORKLOAD(map_updates, "mapMember(fill(emptyMap, {n}), 7919)", "true")
    ->Arg(10'000)
    ->Arg(100'000);
PERENTIE_WORKLOAD(set_comprehension, "card({(x, y) | x <- {1..{n}}, y <- {1..{n}}})", "")
    ->Arg(316)
    ->Arg(1'000);

// --- Loading ------------------------------------------------------------------------------------

// A file with all that it includes: read, parsed, resolved, inferred and lowered.
void load(benchmark::State& state, const std::string& path) {
  if (!std::filesystem::exists(path)) {
    state.SkipWithError("there is no such file");
    return;
  }
  for (auto _ : state) {
    base::SourceMap sources;
    base::Diagnostics diagnostics;
    const auto file = sources.add(path, *base::read_file(path).text);
    if (Script::load(*file, sources, diagnostics) == nullptr) {
      state.SkipWithError(base::render_all(diagnostics, sources).c_str());
      return;
    }
  }
  state.counters["peak_mb"] = peak_megabytes();
}

BENCHMARK_CAPTURE(load, corpus_rover, "corpus/rover/rover.csp")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(
    load, shared_robochart,
    "../shared/data/varanus/oracles/inspection-rover-ras/robochart-version/comparison.csp")
    ->Unit(benchmark::kMillisecond);

// --- Synthesis ----------------------------------------------------------------------------------

// From the text of a file to the normal form of one of its processes.
void synthesise(benchmark::State& state, const std::string& path, const std::string& process) {
  if (!std::filesystem::exists(path)) {
    state.SkipWithError("there is no such file");
    return;
  }
  const std::string text = *base::read_file(path).text;
  for (auto _ : state) {
    base::SourceMap sources;
    base::Diagnostics diagnostics;
    const auto script = Script::load(*sources.add(path, text), sources, diagnostics);
    const auto term = script->process(process, diagnostics);
    TermSystem system = script->terms(*term, diagnostics);
    const auto exploration = lts::explore(system);
    const auto normalisation = lts::normalise(exploration.lts);
    state.counters["states"] = static_cast<double>(exploration.lts.state_count());
    state.counters["transitions"] = static_cast<double>(exploration.lts.edge_count());
    state.counters["nodes"] = static_cast<double>(normalisation.normal.lts.state_count());
  }
  state.counters["peak_mb"] = peak_megabytes();
}

BENCHMARK_CAPTURE(synthesise, corpus_rover, "corpus/rover/rover.csp", "ROVER_SYSTEM")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(synthesise, shared_rover,
                  "../shared/data/varanus/oracles/inspection-rover-ras/rover_model.csp",
                  "ROVER({}, Green)")
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace perentie::semantics

BENCHMARK_MAIN();

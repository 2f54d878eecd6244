// What compiled machines are worth: the states and transitions of philosophers from CSPM text, each
// run counting them in full, beside the step rules.
//
// `peak_mb` is the largest resident size of the whole program so far: run one workload by itself
// (--benchmark_filter=..) to read it.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cstdint>
#include <string>

#include "perentie/base/source.hpp"
#include "perentie/lts/count.hpp"
#include "perentie/semantics/machine.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::semantics {
namespace {

const char* const philosophers = "corpus/philosophers/philosophers.csp";
// Left out where ../shared is absent.
const char* const robochart =
    "../shared/data/varanus/oracles/inspection-rover-ras/robochart-version/comparison.csp";

// On Linux the resident size is given in KiB.
double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

enum class By { machine, step_rules };

// From the text of a file to the counts of a process, with `(n)` after its name if there is an n.
void count(benchmark::State& state, By by, const std::string& path, const std::string& name) {
  const auto file_text = base::read_file(path);
  if (!file_text.text) {
    state.SkipWithError("there is no such file");
    return;
  }
  const std::int64_t n = state.range(0);
  const std::string process = n == 0 ? name : name + "(" + std::to_string(n) + ")";
  lts::Count found;
  for (auto _ : state) {
    base::SourceMap sources;
    base::Diagnostics diagnostics;
    const auto script = Script::load(*sources.add(path, *file_text.text), sources, diagnostics);
    const auto term = script->process(process, diagnostics);
    if (by == By::step_rules) {
      TermSystem system = script->terms(*term, diagnostics);
      found = lts::count(system);
    } else {
      const MachineCompilation compilation = script->machine(*term, {});
      if (!compilation.machine) {
        state.SkipWithError("there is no machine");
        return;
      }
      state.counters["leaves"] = static_cast<double>(compilation.machine->leaves.size());
      state.counters["words"] = static_cast<double>(compilation.machine->width());
      found = with_system(*compilation.machine, [&](auto system) {
        return lts::count(system, {.limits = {.workers = std::getenv("W") ? (unsigned)atoi(std::getenv("W")) : 1}});
      });
    }
  }
  const auto states = static_cast<double>(found.states);
  state.counters["states"] = states;
  state.counters["transitions"] = static_cast<double>(found.transitions);
  state.counters["states_per_s"] =
      benchmark::Counter(states, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["transitions_per_s"] = benchmark::Counter(
      static_cast<double>(found.transitions), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["peak_mb"] = peak_megabytes();
}

BENCHMARK_CAPTURE(count, step_rules, By::step_rules, philosophers, "SYSTEM")
    ->Arg(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(count, machine, By::machine, philosophers, "SYSTEM")
    ->DenseRange(5, 10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(count, robochart_step_rules, By::step_rules, robochart, "normal(RCSystem)")
    ->Arg(0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(count, robochart_machine, By::machine, robochart, "normal(RCSystem)")
    ->Arg(0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(count, machine_hidden, By::machine, philosophers, "MEALS")
    ->Arg(8)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(count, machine_butler, By::machine, philosophers, "WITH_BUTLER")
    ->Arg(8)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace perentie::semantics

BENCHMARK_MAIN();

// How fast processes are explored from CSPM text: each run counts all states and transitions.
//
// Philosophers with one worker and with two, beside the machine's own rates: random reads, which
// exploration mostly waits for, and a loop without memory, each on one thread and on two. Then what
// each part of a machine costs: leaves from terms, wide synchronisation, layers of hiding and
// renaming, operators that come and go.
//
// `peak_mb` is the largest resident size of the whole program so far: run one workload by itself
// (--benchmark_filter=..) to read it.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cstdint>
#include <string>
#include <vector>

#include "perentie/base/growing_array.hpp"
#include "perentie/base/hash.hpp"
#include "perentie/base/source.hpp"
#include "perentie/lts/count.hpp"
#include "perentie/lts/workers.hpp"
#include "perentie/semantics/process_graph.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::semantics {
namespace {

const char* const philosophers = "corpus/philosophers/philosophers.csp";
// Left out where ../shared is absent.
const char* const robochart =
    "../shared/data/varanus/oracles/inspection-rover-ras/robochart-version/comparison.csp";

const char* const parts = R"(
channel up, down
COUNTER(n) = n < 999999 & up -> COUNTER(n + 1) [] n > 0 & down -> COUNTER(n - 1)

channel left, right : {0..3}
QUEUE(s) = #s < 9 & left?x -> QUEUE(s ^ <x>) [] not null(s) & right!head(s) -> QUEUE(tail(s))

channel visit, leave : {1..12}
ROVER(at, seen) = visit?w -> ROVER(w, union(seen, {w})) [] leave!at -> ROVER(at, diff(seen, {at}))

-- Twenty components, seven of which turn at their own pace; all take part in every event.
channel turn : {0..3}
WHEEL(size, at) = turn?by:{x | x <- {0..3}, at != 0 or x != 2} -> WHEEL(size, (at + by) % size)
SIZES = <2, 3, 5, 7, 11, 13, 17, 2, 3, 5, 7, 11, 13, 17, 2, 3, 5, 7, 11, 13>
nth(i, s) = if i == 0 then head(s) else nth(i - 1, tail(s))
WIDE = [| {| turn |} |] i : {0..19} @ WHEEL(nth(i, SIZES), 0)

-- Six components below twelve operators that rename and hide.
channel move, shown : {0..5}.{0..9}
DIAL(i, at) = move.i.at -> DIAL(i, (at + 1) % 10)
renamed(0, P) = P
renamed(n, P) = renamed(n - 1, P [[move.i.0 <- shown.i.0 | i <- {0..5}]] \ {| shown |})
LAYERS = renamed(6, ||| i : {0..5} @ DIAL(i, 0))

-- Rounds of seven components that end together and begin again: the parallel operator is not there
-- for ever.
channel work : {0..6}.{0..5}
TASK(i, n) = if n == 6 then SKIP else work.i.n -> TASK(i, n + 1)
ROUNDS = (||| i : {0..6} @ TASK(i, 0)) ; ROUNDS
)";

// On Linux the resident size is given in KiB.
double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void report(benchmark::State& state, const ProcessSize& found) {
  const auto states = static_cast<double>(found.states);
  const auto transitions = static_cast<double>(found.transitions);
  constexpr auto rate = benchmark::Counter::kIsIterationInvariantRate;
  state.counters["states"] = states;
  state.counters["transitions"] = transitions;
  state.counters["states_per_s"] = benchmark::Counter(states, rate);
  state.counters["transitions_per_s"] = benchmark::Counter(transitions, rate);
  state.counters["leaves"] = static_cast<double>(found.structure.leaf_kinds.size());
  state.counters["words"] = static_cast<double>(found.structure.words);
  state.counters["peak_mb"] = peak_megabytes();
}

// From the text of a script to the counts of a process.
void count(benchmark::State& state, const std::string& name, const std::string& text,
           const std::string& process, unsigned workers) {
  ProcessSize found;
  for (auto _ : state) {
    base::SourceMap sources;
    base::Diagnostics diagnostics;
    const auto script = Script::load(*sources.add(name, text), sources, diagnostics);
    const auto term = script ? script->process(process, diagnostics) : std::nullopt;
    if (!term) return state.SkipWithError("there is no such process");
    found = count_process(*script, *term, {.limits = {.workers = workers}}, diagnostics);
  }
  report(state, found);
}

void count_file(benchmark::State& state, const std::string& path, const std::string& process,
                unsigned workers) {
  const auto file = base::read_file(path);
  if (!file.text) return state.SkipWithError("there is no such file");
  count(state, path, *file.text, process, workers);
}

// Arguments: philosophers, workers.
void system_of(benchmark::State& state) {
  count_file(state, philosophers, "SYSTEM(" + std::to_string(state.range(0)) + ")",
             static_cast<unsigned>(state.range(1)));
}
BENCHMARK(system_of)
    ->ArgsProduct({{6, 8, 9, 10}, {1, 2}})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void by_step_rules(benchmark::State& state) {
  ProcessSize found;
  for (auto _ : state) {
    base::SourceMap sources;
    base::Diagnostics diagnostics;
    const auto script =
        Script::load(*base::add_file(philosophers, sources).file, sources, diagnostics);
    TermSystem system = script->terms(*script->process("SYSTEM(5)", diagnostics), diagnostics);
    const lts::Count counted = lts::count(system);
    found.states = counted.states;
    found.transitions = counted.transitions;
  }
  report(state, found);
}
BENCHMARK(by_step_rules)->Unit(benchmark::kMillisecond);

void file(benchmark::State& state, const char* path, const char* process) {
  count_file(state, path, process, 1);
}
BENCHMARK_CAPTURE(file, hidden, philosophers, "MEALS(8)")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(file, butler, philosophers, "WITH_BUTLER(8)")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(file, robochart, robochart, "RCSystem")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(file, robochart_normal, robochart, "normal(RCSystem)")
    ->Unit(benchmark::kMillisecond);

void part(benchmark::State& state, const char* process) {
  count(state, "parts.csp", parts, process, 1);
}
BENCHMARK_CAPTURE(part, counter, "COUNTER(0)")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(part, queue, "QUEUE(<>)")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(part, rover, "ROVER(1, {1})")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(part, wide, "WIDE")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(part, layers, "LAYERS")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(part, rounds, "ROUNDS")->Unit(benchmark::kMillisecond);

// --- What the machine can do
// -----------------------------------------------------------------------

// Reads places of a large array that nothing foretells, sixteen at a time. Argument: threads.
void random_reads(benchmark::State& state) {
  constexpr std::size_t places = std::size_t{1} << 27U;
  constexpr std::uint64_t reads = 16'000'000;
  constexpr std::uint64_t at_once = 16;
  base::GrowingArray<std::uint32_t> array;
  array.resize(places, 1);
  lts::Workers workers(static_cast<unsigned>(state.range(0)));
  for (auto _ : state) {
    workers.run([&](unsigned worker) {
      std::uint64_t sum = worker;
      std::size_t next[at_once];
      for (std::uint64_t i = 0; i < reads; i += at_once) {
        for (std::uint64_t k = 0; k < at_once; ++k) {
          next[k] = base::hash_mix(worker, i + k) % places;
          __builtin_prefetch(&array[next[k]]);
        }
        for (const std::size_t place : next) sum += array[place];
      }
      benchmark::DoNotOptimize(sum);
    });
  }
  state.counters["reads_per_s"] =
      benchmark::Counter(static_cast<double>(reads) * static_cast<double>(state.range(0)),
                         benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(random_reads)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

// Argument: threads.
void arithmetic(benchmark::State& state) {
  constexpr std::uint64_t steps = 100'000'000;
  lts::Workers workers(static_cast<unsigned>(state.range(0)));
  for (auto _ : state) {
    workers.run([&](unsigned worker) {
      std::uint64_t hash = worker;
      for (std::uint64_t i = 0; i < steps; ++i) hash = base::hash_mix(hash, i);
      benchmark::DoNotOptimize(hash);
    });
  }
  state.counters["steps_per_s"] =
      benchmark::Counter(static_cast<double>(steps) * static_cast<double>(state.range(0)),
                         benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(arithmetic)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace perentie::semantics

BENCHMARK_MAIN();

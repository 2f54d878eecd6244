// What checks cost beside plain exploration of the same implementation: philosophers, visible and
// hidden, against specifications that they refine, in each model.
//
// Each row measures both in turn and reports the ratio of the medians.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "perentie/base/source.hpp"
#include "perentie/semantics/check.hpp"
#include "perentie/semantics/process_graph.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::semantics {
namespace {

const char* const philosophers = "corpus/philosophers/philosophers.csp";

// Specifications that the systems of the file refine, deterministic counters, and a specification
// of 10^4 nodes with a system of 10^6 states that refines it.
const char* const specifications = R"(
ANY(A) = |~| x : A @ x -> ANY(A)
ANY_OR_STOP(A) = STOP |~| ANY_OR_STOP_THEN(A)
ANY_OR_STOP_THEN(A) = |~| x : A @ x -> ANY_OR_STOP(A)
channel never, again
REPEATS = again -> REPEATS
NEVER_REPEATS = ((never -> REPEATS) [|{never}|] STOP) \ {again}
TABLE_EVENTS = {| sits, eats, getsup, picks, putsdown |}
COUNTERS = ||| i : {0..5} @ COUNTER_OF(i, 0)
channel step : {0..5}.{0..9}
COUNTER_OF(i, v) = step.i.v -> COUNTER_OF(i, (v + 1) % 10)
channel round : {0..9999}
channel idle
ROUNDS(i) = round.i -> ROUNDS((i + 1) % 10000)
IDLE(n) = n > 0 & idle -> IDLE(n - 1)
ROUNDS_AND_IDLE = ROUNDS(0) ||| IDLE(99) \ {idle}
)";

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

struct Loaded {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  std::unique_ptr<Script> script;

  explicit Loaded(const std::string& assertion) {
    const std::string text =
        *base::read_file(philosophers).text + specifications + "assert " + assertion + "\n";
    script = Script::load(*sources.add(philosophers, text), sources, diagnostics);
  }
};

// The time to count the states of a process.
double explore(const std::string& process, std::uint64_t& states) {
  Loaded loaded(process + " :[deadlock free]");
  const auto begin = std::chrono::steady_clock::now();
  const auto term = loaded.script->process(process, loaded.diagnostics);
  states = count_process(*loaded.script, *term, {}, loaded.diagnostics).states;
  return seconds_since(begin);
}

void check(benchmark::State& state, std::string assertion, std::string process, bool holds) {
  for (std::string* text : {&assertion, &process}) {
    for (std::size_t at; (at = text->find("{n}")) != std::string::npos;) {
      text->replace(at, 3, std::to_string(state.range(0)));
    }
  }
  std::vector<double> explorations;
  std::vector<double> checks;
  std::uint64_t states = 0;
  CheckResult result{.outcome = CheckResult::Outcome::error};
  for (auto _ : state) {
    explorations.push_back(explore(process, states));
    Loaded loaded(assertion);
    if (!loaded.script) {
      state.SkipWithError(base::render_all(loaded.diagnostics, loaded.sources).c_str());
      return;
    }
    const auto begin = std::chrono::steady_clock::now();
    result = semantics::check(*loaded.script, assertions_of(loaded.script->tree()).front(), {},
                              loaded.diagnostics);
    checks.push_back(seconds_since(begin));
  }
  if ((result.outcome == CheckResult::Outcome::holds) != holds) {
    state.SkipWithError("another outcome was expected");
    return;
  }
  state.counters["states"] = static_cast<double>(states);
  state.counters["pairs"] = static_cast<double>(result.counts.states);
  state.counters["explore_s"] = median(explorations);
  state.counters["check_s"] = median(checks);
  state.counters["ratio"] = median(checks) / median(explorations);
}

#define PERENTIE_CHECK_BENCH(name, ...) \
  BENCHMARK_CAPTURE(check, name, __VA_ARGS__)->Unit(benchmark::kMillisecond)->Iterations(5)

PERENTIE_CHECK_BENCH(traces, "ANY(TABLE_EVENTS) [T= SYSTEM({n})", "SYSTEM({n})", true)
    ->DenseRange(6, 8);
PERENTIE_CHECK_BENCH(failures, "ANY_OR_STOP(TABLE_EVENTS) [F= SYSTEM({n})", "SYSTEM({n})", true)
    ->DenseRange(6, 8);
PERENTIE_CHECK_BENCH(failures_divergences, "ANY_OR_STOP(TABLE_EVENTS) [FD= SYSTEM({n})",
                     "SYSTEM({n})", true)
    ->DenseRange(6, 8);
PERENTIE_CHECK_BENCH(hidden_traces, "ANY({|eats|}) [T= MEALS({n})", "MEALS({n})", true)
    ->DenseRange(6, 8);
PERENTIE_CHECK_BENCH(hidden_failures, "ANY_OR_STOP({|eats|}) [F= MEALS({n})", "MEALS({n})", true)
    ->DenseRange(6, 8);
PERENTIE_CHECK_BENCH(hidden_failures_divergences, "ANY_OR_STOP({|eats|}) [FD= MEALS({n})",
                     "MEALS({n})", true)
    ->DenseRange(6, 8);
PERENTIE_CHECK_BENCH(butler_deadlock_free, "WITH_BUTLER({n}) :[deadlock free]", "WITH_BUTLER({n})",
                     true)
    ->DenseRange(6, 8);
// As far as the leaves tell, this may diverge, so divergences are looked for.
PERENTIE_CHECK_BENCH(searched_failures_divergences,
                     "ANY_OR_STOP({|eats|}) [FD= MEALS({n}) ||| NEVER_REPEATS",
                     "MEALS({n}) ||| NEVER_REPEATS", true)
    ->DenseRange(6, 8);
// The specification has many τ: it is compressed before it is normalised.
PERENTIE_CHECK_BENCH(hidden_specification, "MEALS({n}) [FD= MEALS({n})", "MEALS({n})", true)
    ->DenseRange(6, 7);
PERENTIE_CHECK_BENCH(large_specification, "ROUNDS(0) [FD= ROUNDS_AND_IDLE", "ROUNDS_AND_IDLE", true)
    ->Arg(0);
PERENTIE_CHECK_BENCH(determinism, "COUNTERS :[deterministic]", "COUNTERS", true)->Arg(0);

}  // namespace
}  // namespace perentie::semantics

BENCHMARK_MAIN();

// Throughput of the lts library: exploration, normal form, divergence, determinism, .aut files.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <ostream>
#include <random>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

#include "perentie/base/hash.hpp"
#include "perentie/lts/aut.hpp"
#include "perentie/lts/bisimulation.hpp"
#include "perentie/lts/compressions.hpp"
#include "perentie/lts/determinism.hpp"
#include "perentie/lts/divergence.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/lts/hide.hpp"
#include "perentie/lts/json.hpp"
#include "perentie/lts/normalise.hpp"
#include "perentie/lts/weak_bisimulation.hpp"

namespace {

namespace lts = perentie::lts;
using lts::Label;
using lts::State;

std::shared_ptr<const lts::LabelNames> names(std::uint32_t events) {
  lts::LabelNames result{std::string(lts::tau_name), std::string(lts::tick_name)};
  for (std::uint32_t i = 0; i < events; ++i) result.push_back("event." + std::to_string(i));
  return std::make_shared<const lts::LabelNames>(std::move(result));
}

/// Rings of six states, four bits each, that turn independently: 6^rings states, `rings`
/// transitions each. About as many of both as the dining philosophers of the same number.
struct Rings {
  using State = std::uint64_t;

  std::uint32_t rings;

  State initial() const { return 0; }
  bool successors(State s, std::vector<lts::Transition<State>>& out) const {
    for (std::uint32_t i = 0; i < rings; ++i) {
      const std::uint64_t place = (s >> (4 * i)) & 15U;
      const std::uint64_t next = place == 5 ? 0 : place + 1;
      out.push_back({Label{2 + i}, s + ((next - place) << (4 * i))});
    }
    return true;
  }
  std::uint64_t state_hash(State s) const { return perentie::base::hash_mix(0, s); }
  std::shared_ptr<const lts::LabelNames> label_names() const { return names(rings); }
};

void explore_rings(benchmark::State& state) {
  Rings system{static_cast<std::uint32_t>(state.range(0))};
  double states = 0;
  double transitions = 0;
  for (auto _ : state) {
    const auto result = lts::explore(system);
    states += static_cast<double>(result.states.size());
    transitions += static_cast<double>(result.transitions_fired);
  }
  state.counters["states/s"] = benchmark::Counter(states, benchmark::Counter::kIsRate);
  state.counters["transitions/s"] = benchmark::Counter(transitions, benchmark::Counter::kIsRate);
}
BENCHMARK(explore_rings)->Arg(7)->Arg(8)->Unit(benchmark::kMillisecond);

/// The n-th event from the end is the first: n + 1 states, 2^n nodes.
lts::Lts exponential(std::uint32_t n) {
  lts::LtsRowBuilder rows;
  for (const std::uint32_t event : {2U, 3U}) rows.add_edge(Label{event}, State{0});
  rows.add_edge(Label{2}, State{1});
  rows.end_row();
  for (std::uint32_t s = 1; s < n; ++s) {
    for (const std::uint32_t event : {2U, 3U}) rows.add_edge(Label{event}, State{s + 1});
    rows.end_row();
  }
  return std::move(rows).finish(State{0}, n + 1, names(2));
}

void normalise_exponential(benchmark::State& state) {
  const lts::Lts nfa = exponential(static_cast<std::uint32_t>(state.range(0)));
  double nodes = 0;
  for (auto _ : state) {
    nodes +=
        static_cast<double>(lts::normalise(nfa, {.limits = {}, .acceptances = state.range(1) != 0})
                                .normal.lts.state_count());
  }
  state.counters["nodes/s"] = benchmark::Counter(nodes, benchmark::Counter::kIsRate);
}
BENCHMARK(normalise_exponential)
    ->ArgNames({"n", "acceptances"})
    ->Args({16, 0})
    ->Args({20, 0})
    ->Args({20, 1})
    ->Unit(benchmark::kMillisecond);

/// A random graph in which every state has `degree` edges, `tau_percent` of them τ.
lts::Lts random_lts(std::uint32_t states, std::uint32_t degree, std::uint32_t tau_percent) {
  std::mt19937 random(1);
  lts::LtsRowBuilder rows;
  for (std::uint32_t s = 0; s < states; ++s) {
    for (std::uint32_t i = 0; i < degree; ++i) {
      const Label label = random() % 100 < tau_percent
                              ? lts::tau
                              : Label{2 + static_cast<std::uint32_t>(random() % 10)};
      rows.add_edge(label, State{static_cast<std::uint32_t>(random() % states)});
    }
    rows.end_row();
  }
  return std::move(rows).finish(State{0}, states, names(10));
}

void count_edges(benchmark::State& state, const lts::Lts& graph) {
  state.counters["edges/s"] = benchmark::Counter(static_cast<double>(graph.edge_count()),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

/// Dining philosophers: each sits, takes the left fork and the right, eats, puts the right back and
/// the left, gets up. The label of event e of philosopher i is 2 + 7 * i + e; 7 philosophers have
/// 279,934 states.
struct Philosophers {
  using State = std::uint64_t;

  std::uint32_t count;

  static std::uint32_t place(State s, std::uint32_t i) { return (s >> (4 * i)) & 15U; }
  std::uint32_t after(std::uint32_t i) const { return i + 1 == count ? 0 : i + 1; }
  std::uint32_t before(std::uint32_t i) const { return i == 0 ? count - 1 : i - 1; }
  static bool holds_left(std::uint32_t at) { return at >= 2 && at <= 5; }
  static bool holds_right(std::uint32_t at) { return at >= 3 && at <= 4; }

  State initial() const { return 0; }
  bool successors(State s, std::vector<lts::Transition<State>>& out) const {
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint64_t at = place(s, i);
      if (at == 1 && holds_right(place(s, before(i)))) continue;
      if (at == 2 && holds_left(place(s, after(i)))) continue;
      const std::uint64_t next = at == 6 ? 0 : at + 1;
      out.push_back(
          {Label{static_cast<std::uint32_t>(2 + 7 * i + at)}, s + ((next - at) << (4 * i))});
    }
    return true;
  }
  std::uint64_t state_hash(State s) const { return perentie::base::hash_mix(0, s); }
  std::shared_ptr<const lts::LabelNames> label_names() const { return names(7 * count); }
};

/// Seven philosophers; `visible` of the seven events of each are not hidden: eating, then sitting.
lts::Lts philosophers(int visible) {
  Philosophers system{7};
  return lts::hide_if(lts::explore(system).lts, [&](Label label) {
    const std::uint32_t event = (label.value - 2) % 7;
    return (event != 3 || visible < 1) && (event != 0 || visible < 2) && visible < 7;
  });
}

using Reduction = lts::Quotient (*)(const lts::Lts&);

void reduce(benchmark::State& state, const lts::Lts& graph, Reduction reduction) {
  std::size_t states = 0;
  for (auto _ : state) states = reduction(graph).lts.state_count();
  count_edges(state, graph);
  state.counters["states"] = static_cast<double>(graph.state_count());
  state.counters["edges"] = static_cast<double>(graph.edge_count());
  state.counters["reduced"] = static_cast<double>(states);
}

lts::Quotient strong(const lts::Lts& graph) { return lts::strong_bisimulation(graph); }
lts::Quotient delay(const lts::Lts& graph) {
  return std::get<lts::Quotient>(lts::delay_bisimulation(graph));
}
lts::Quotient weak(const lts::Lts& graph) {
  return std::get<lts::Quotient>(lts::weak_bisimulation(graph));
}

template <Reduction reduction>
void reduce_philosophers(benchmark::State& state) {
  reduce(state, philosophers(static_cast<int>(state.range(0))), reduction);
}
void philosopher_arguments(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("visible")->Arg(7)->Arg(2)->Arg(1)->Unit(benchmark::kMillisecond);
}
BENCHMARK(reduce_philosophers<strong>)->Apply(philosopher_arguments);
BENCHMARK(reduce_philosophers<delay>)->Apply(philosopher_arguments);
BENCHMARK(reduce_philosophers<weak>)->Apply(philosopher_arguments);

/// Compression is not asked for: `normal` does it by itself.
void normalise_philosophers(benchmark::State& state) {
  const lts::Lts graph = philosophers(static_cast<int>(state.range(0)));
  std::size_t states = 0;
  for (auto _ : state) {
    states = std::get<lts::GeneralisedLts>(lts::normal(graph)).lts.state_count();
  }
  state.counters["reduced"] = static_cast<double>(states);
}
BENCHMARK(normalise_philosophers)
    ->ArgName("visible")
    ->Arg(2)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);

template <Reduction reduction>
void reduce_random(benchmark::State& state) {
  reduce(state,
         random_lts(static_cast<std::uint32_t>(state.range(0)), 4,
                    static_cast<std::uint32_t>(state.range(1))),
         reduction);
}
void random_arguments(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"states", "tau_percent"})->Unit(benchmark::kMillisecond);
  benchmark->Args({250'000, 0})->Args({1'000'000, 20})->Args({2'500'000, 20});
}
BENCHMARK(reduce_random<strong>)->Apply(random_arguments);
BENCHMARK(reduce_random<delay>)->Apply(random_arguments);

void divergence(benchmark::State& state) {
  const lts::Lts graph = random_lts(1'000'000, 5, 20);
  for (auto _ : state) benchmark::DoNotOptimize(lts::divergent_states(graph));
  count_edges(state, graph);
}
BENCHMARK(divergence)->Unit(benchmark::kMillisecond);

void determinism(benchmark::State& state) {
  Rings system{7};
  const lts::Lts graph = lts::explore(system).lts;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        lts::check_determinism(graph, lts::DeterminismModel::failures_divergences));
  }
  count_edges(state, graph);
}
BENCHMARK(determinism)->Unit(benchmark::kMillisecond);

void build_in_any_order(benchmark::State& state) {
  const lts::Lts graph = random_lts(1'000'000, 4, 10);
  for (auto _ : state) {
    lts::LtsBuilder builder(graph.shared_label_names());
    builder.add_states(static_cast<std::uint32_t>(graph.state_count()));
    for (std::uint32_t s = 0; s < graph.state_count(); ++s) {
      for (const lts::Edge& edge : graph.edges(State{s})) {
        builder.add_edge(edge.target, edge.label, State{s});
      }
    }
    benchmark::DoNotOptimize(std::move(builder).finish(State{0}));
  }
  count_edges(state, graph);
}
BENCHMARK(build_in_any_order)->Unit(benchmark::kMillisecond);

/// Takes everything and counts it.
class CountingBuffer : public std::streambuf {
 public:
  std::uint64_t count = 0;

 private:
  std::streamsize xsputn(const char*, std::streamsize size) override {
    count += static_cast<std::uint64_t>(size);
    return size;
  }
  int_type overflow(int_type c) override {
    ++count;
    return traits_type::not_eof(c);
  }
};

template <class Write>
void write_benchmark(benchmark::State& state, Write write) {
  const lts::Lts graph = random_lts(1'000'000, 4, 10);
  CountingBuffer buffer;
  std::ostream out(&buffer);
  for (auto _ : state) write(out, graph);
  state.SetBytesProcessed(static_cast<std::int64_t>(buffer.count));
  count_edges(state, graph);
}

void aut_write(benchmark::State& state) {
  write_benchmark(state, [](std::ostream& out, const lts::Lts& g) { lts::write_aut(out, g); });
}
BENCHMARK(aut_write)->Unit(benchmark::kMillisecond);

void json_write(benchmark::State& state) {
  write_benchmark(state, [](std::ostream& out, const lts::Lts& g) { lts::write_json(out, g); });
}
BENCHMARK(json_write)->Unit(benchmark::kMillisecond);

void aut_read(benchmark::State& state) {
  const lts::Lts graph = random_lts(1'000'000, 4, 10);
  std::stringbuf buffer;
  std::ostream out(&buffer);
  lts::write_aut(out, graph);
  const std::string text = buffer.str();
  for (auto _ : state) {
    perentie::base::SourceMap sources;
    perentie::base::Diagnostics diagnostics;
    benchmark::DoNotOptimize(lts::read_aut("random.aut", text, sources, diagnostics));
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(text.size()) *
                          static_cast<std::int64_t>(state.iterations()));
  count_edges(state, graph);
}
BENCHMARK(aut_read)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();

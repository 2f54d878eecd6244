// The monitor's two costs, each beside the least that any program would have to do.
//
// `next`: one event of a random trace on a random table with distinct rows, beside a loop over a
// bare dense array of the same entries. `offline`: a JSON-lines file from its bytes to the verdict,
// beside a loop that reads the file and does nothing but get the same two fields of each line with
// simdjson. Ours and the other are measured in turn within each iteration; `ratio` is ours divided
// by the other. Run with --benchmark_repetitions=5 and read the medians.
#include <benchmark/benchmark.h>
#include <simdjson.h>
#include <unistd.h>

#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "perentie/lts/normalise.hpp"
#include "perentie/monitor/session.hpp"

namespace perentie::monitor {
namespace {

// Processor seconds of this thread: other programs on the machine disturb them least.
double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

std::string event_name(std::uint32_t i) { return "event." + std::to_string(i); }

// Every state permits every event, with random targets: two rows of such a table are as good as
// never equal, which is the worst case of the Varanus paper's stress test without its repeated
// rows.
lts::Lts random_complete_lts(std::uint32_t states, std::uint32_t events, std::mt19937& random) {
  lts::LabelNames names{std::string(lts::tau_name), std::string(lts::tick_name)};
  for (std::uint32_t e = 0; e < events; ++e) names.push_back(event_name(e));
  lts::LtsBuilder builder(std::make_shared<const lts::LabelNames>(std::move(names)));
  builder.add_states(states);
  std::uniform_int_distribution<std::uint32_t> target(0, states - 1);
  for (std::uint32_t s = 0; s < states; ++s) {
    for (std::uint32_t e = 0; e < events; ++e) {
      builder.add_edge(State{s}, lts::Label{2 + e}, State{target(random)});
    }
  }
  return std::move(builder).finish(State{0});
}

// What the other side of the comparison runs on: the same table as nothing but an array.
template <class Entry>
struct BareTable {
  std::vector<Entry> entries;
  std::size_t events;

  explicit BareTable(const MonitorTable& table) : events(table.event_count()) {
    for (std::uint32_t s = 0; s < table.state_count(); ++s) {
      for (std::uint32_t e = 0; e < events; ++e) {
        entries.push_back(static_cast<Entry>(table.next(State{s}, Event{e}).value));
      }
    }
  }

  std::uint32_t run(const std::vector<Event>& trace) const {
    std::size_t state = 0;
    for (const Event event : trace) state = entries[state * events + event.value];
    return static_cast<std::uint32_t>(state);
  }
};

std::uint32_t run_monitor(const MonitorTable& table, const std::vector<Event>& trace) {
  Monitor monitor(table, Mode::strict);
  for (const Event event : trace) {
    if (monitor.step(event) == Verdict::violation) return State::none_value;
  }
  return monitor.state().value;
}

void next(benchmark::State& bench) {
  const auto states = static_cast<std::uint32_t>(bench.range(0));
  const auto events = static_cast<std::uint32_t>(bench.range(1));
  std::mt19937 random(1);
  const lts::Lts lts = random_complete_lts(states, events, random);
  const auto layout = static_cast<TableLayout>(bench.range(2));
  const MonitorTable table = MonitorTable::compile(lts, layout);
  const BareTable<std::uint16_t> bare(MonitorTable::compile(lts, TableLayout::dense_2_byte));
  std::vector<Event> trace(1000000);
  std::uniform_int_distribution<std::uint32_t> any_event(0, events - 1);
  for (Event& event : trace) event = Event{any_event(random)};

  double ours = 0;
  double other = 0;
  for (auto _ : bench) {
    double start = cpu_seconds();
    const std::uint32_t end = run_monitor(table, trace);
    const double seconds = cpu_seconds() - start;
    start = cpu_seconds();
    const std::uint32_t bare_end = bare.run(trace);
    other += cpu_seconds() - start;
    ours += seconds;
    bench.SetIterationTime(seconds);
    if (end != bare_end) bench.SkipWithError("the monitor and the bare table disagree");
  }
  const auto steps = static_cast<double>(bench.iterations()) * static_cast<double>(trace.size());
  bench.counters["ns/event"] = ours / steps * 1e9;
  bench.counters["bare ns"] = other / steps * 1e9;
  bench.counters["ratio"] = ours / other;
}

constexpr auto dense = static_cast<int>(TableLayout::dense_2_byte);
constexpr auto rows = static_cast<int>(TableLayout::sorted_rows);

BENCHMARK(next)
    ->ArgNames({"states", "events", "layout"})
    ->Args({10, 10, dense})
    ->Args({100, 100, dense})
    ->Args({100, 1000, dense})
    ->Args({1000, 1000, dense})
    ->Args({10, 10, rows})
    ->Args({100, 100, rows})
    ->Args({1000, 1000, rows})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// A trace file that is removed with the object.
class TraceFile {
 public:
  // `line` makes the line of an event that is `event.<number>` of 40.
  template <class Line>
  TraceFile(std::size_t lines, Line line) : lines_(lines) {
    path_ = std::filesystem::temp_directory_path() /
            ("perentie-bench-" + std::to_string(::getpid()) + ".jsonl");
    std::mt19937 random(2);
    std::uniform_int_distribution<std::uint32_t> number(0, 39);
    std::ofstream file(path_, std::ios::binary);
    for (std::size_t i = 0; i < lines; ++i) file << line(number(random), i) << '\n';
  }
  ~TraceFile() { std::filesystem::remove(path_); }
  TraceFile(const TraceFile&) = delete;
  TraceFile& operator=(const TraceFile&) = delete;

  std::string path() const { return path_.string(); }
  std::size_t lines() const { return lines_; }
  double bytes() const { return static_cast<double>(std::filesystem::file_size(path_)); }

 private:
  std::filesystem::path path_;
  std::size_t lines_;
};

// Reads the file and gets two fields of each line, the second a string or a number.
std::size_t simdjson_loop(const std::string& path, const char* first, const char* second) {
  const simdjson::padded_string text = simdjson::padded_string::load(path);
  simdjson::ondemand::parser parser;
  std::size_t checksum = 0;
  const char* const end = text.data() + text.size();
  for (const char* line = text.data(); line < end;) {
    const auto* line_end =
        static_cast<const char*>(std::memchr(line, '\n', static_cast<std::size_t>(end - line)));
    const auto length = static_cast<std::size_t>(line_end - line);
    auto document = parser.iterate(line, length, length + simdjson::SIMDJSON_PADDING);
    // In the order of the file, which is the cheapest.
    std::string_view topic;
    simdjson::ondemand::value value;
    if (document[first].get_string().get(topic) == simdjson::SUCCESS) checksum += topic.size();
    if (document[second].get(value) == simdjson::SUCCESS) checksum += value.raw_json_token().size();
    line = line_end + 1;
  }
  return checksum;
}

void check_offline(benchmark::State& bench, const TraceFile& file, const char* mapping_name,
                   const lts::Lts& process, const char* first, const char* second) {
  base::SourceMap sources;
  base::Diagnostics diagnostics;
  const auto mapping = load_mapping(mapping_name, sources, diagnostics);
  const MonitorModel model = make_monitor_model(lts::normalise(process).normal);
  double ours = 0;
  double other = 0;
  for (auto _ : bench) {
    double start = cpu_seconds();
    TraceReport report{file.path(), sources, diagnostics};
    EventStream stream(open_trace(file.path(), {}, report), {&*mapping, nullptr, nullptr}, report);
    const RunResult result = run_trace(stream, model, Mode::strict);
    const double seconds = cpu_seconds() - start;
    start = cpu_seconds();
    benchmark::DoNotOptimize(simdjson_loop(file.path(), first, second));
    other += cpu_seconds() - start;
    ours += seconds;
    bench.SetIterationTime(seconds);
    if (result.verdict != RunVerdict::conforms || result.events_checked != file.lines()) {
      bench.SkipWithError("the trace was not accepted as a whole");
    }
  }
  const double lines = static_cast<double>(bench.iterations()) * static_cast<double>(file.lines());
  bench.counters["ns/event"] = ours / lines * 1e9;
  bench.counters["Mevents/s"] = lines / ours / 1e6;
  bench.counters["MB/s"] = file.bytes() * static_cast<double>(bench.iterations()) / ours / 1e6;
  bench.counters["simdjson ns"] = other / lines * 1e9;
  bench.counters["ratio"] = ours / other;
}

lts::Lts forty_events() {
  std::mt19937 random(3);
  return random_complete_lts(103, 40, random);
}

void offline_short_lines(benchmark::State& bench) {
  const TraceFile file(1000000, [](std::uint32_t n, std::size_t i) {
    return "{\"topic\": \"event\", \"data\": " + std::to_string(n) +
           ", \"time\": " + std::to_string(i) + "}";
  });
  check_offline(bench, file, "simple", forty_events(), "topic", "data");
}

void offline_long_lines(benchmark::State& bench) {
  const TraceFile file(1000000, [](std::uint32_t n, std::size_t i) {
    return "{\"pose\": {\"position\": {\"y\": -1.2978523303457956, \"x\": -4.511511153845533, "
           "\"z\": "
           "0.06349772160349255}, \"orientation\": {\"y\": 1.0805674657865676e-06, \"x\": "
           "-2.0792700089321433e-07, \"z\": -2.5057285244226616e-05, \"w\": 0.9999999996854609}}, "
           "\"topic\": \"event\", \"data\": " +
           std::to_string(n) +
           ", \"header\": {\"stamp\": {\"secs\": 1, \"nsecs\": 0}, \"frame_id\": \"sim_sensor\", "
           "\"seq\": " +
           std::to_string(i) + "}, \"time\": 1769153903.3089235, \"type\": \"\"}";
  });
  check_offline(bench, file, "simple", forty_events(), "topic", "data");
}

void offline_rover(benchmark::State& bench) {
  lts::LabelNames names{std::string(lts::tau_name), std::string(lts::tick_name),
                        "radiation_level.Green", "radiation_level.Red"};
  lts::LtsBuilder builder(std::make_shared<const lts::LabelNames>(std::move(names)));
  const State only = builder.add_state();
  builder.add_edge(only, lts::Label{2}, only);
  builder.add_edge(only, lts::Label{3}, only);
  const TraceFile file(1000000, [](std::uint32_t n, std::size_t i) {
    return "{\"topic\": \"/radiation_sensor_plugin/sensor_0\", \"value\": " +
           std::to_string(n < 30 ? n : 260) + ".0, \"time\": " + std::to_string(i) + ".5}";
  });
  check_offline(bench, file, "varanus-rover", std::move(builder).finish(only), "topic", "value");
}

BENCHMARK(offline_short_lines)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(offline_long_lines)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(offline_rover)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace perentie::monitor

BENCHMARK_MAIN();

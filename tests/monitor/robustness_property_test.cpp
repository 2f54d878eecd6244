// Whatever bytes come in, the readers end with events or with a diagnostic: no crash, no hang, no
// exception.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "perentie/monitor/diagnostic_codes.hpp"
#include "perentie/monitor/varanus_config.hpp"
#include "support.hpp"

namespace perentie::monitor {
namespace {

// A good text with some bytes changed, some taken out and some put in: near enough to the format to
// get deep into its reader.
rc::Gen<std::string> damaged(std::string good) {
  return rc::gen::exec([good] {
    std::string text = good;
    const auto edits = *rc::gen::inRange(0, 6);
    for (int i = 0; i < edits && !text.empty(); ++i) {
      const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
      const char byte = *rc::gen::oneOf(
          rc::gen::arbitrary<char>(), rc::gen::elementOf(std::string("{}[]\",:\\\n\r .-0eN*&|>'")));
      switch (*rc::gen::inRange(0, 4)) {
        case 0:
          text[at] = byte;
          break;
        case 1:
          text.insert(at, 1, byte);
          break;
        case 2:
          text.erase(at, *rc::gen::inRange<std::size_t>(1, 8));
          break;
        default:
          text.resize(at);
          break;
      }
    }
    return text;
  });
}

const char* const traces[] = {
    "{\"topic\": \"/command\", \"name\": \"move\", \"location\": 1}\n{\"topic\": "
    "\"/radiation_sensor_plugin/sensor_0\", \"pose\": {\"x\": [1, {\"y\": 2e-5}]}, \"value\": "
    "8.5}\n",
    "{\"event\": \"a.1\"}\r\n{\"topic\": \"\\u0061\\n\", \"data\": [1, \"b\", true]}\n\"c\\\"d\"\n",
    "[\"a\", {\"topic\": \"b\", \"data\": null},\n \"\\ud83d\\ude00\"]\n[\"c\"]",
    "Event: a.1\n\xEF\xBB\xBF b.True \"x y\"\nc . 2\n",
};

// Reading ends, and if it ended early there is a diagnostic that can be printed.
void read_all(const std::string& text, const TraceSetup& setup) {
  TestTrace trace(text, setup);
  const std::size_t events = trace.events().size();
  RC_ASSERT(events <= text.size() + 1);
  const bool failed = !trace.opened() || trace.stream().failed();
  RC_ASSERT(failed == !trace.diagnostics().empty());
}

RC_GTEST_PROP(RobustnessPropertyTest, DamagedTracesAreReadOrRefused, ()) {
  const std::string text =
      *damaged(*rc::gen::elementOf(std::vector<std::string>(std::begin(traces), std::end(traces))));
  const auto format = *rc::gen::element(TraceFormat::automatic, TraceFormat::json_lines,
                                        TraceFormat::json_array, TraceFormat::text);
  read_all(text, {.format = format});
  read_all(text, {.format = format, .mapping = "varanus-rover", .fallback = "simple"});
}

RC_GTEST_PROP(RobustnessPropertyTest, AnyBytesAreReadOrRefused, (const std::string& text)) {
  read_all(text, {});
  read_all("{" + text, {});
  read_all("[" + text, {});
}

// A prefix of a good trace gives a prefix of its events.
RC_GTEST_PROP(RobustnessPropertyTest, NothingBeforeTheFaultIsLost, ()) {
  const std::string good = traces[*rc::gen::inRange<std::size_t>(0, 3)];
  const std::vector<std::string> all = TestTrace(good).events();
  const std::size_t cut = *rc::gen::inRange<std::size_t>(0, good.size() + 1);
  const std::vector<std::string> some = TestTrace(good.substr(0, cut)).events();
  RC_ASSERT(some.size() <= all.size());
  RC_ASSERT(std::equal(some.begin(), some.end(), all.begin()));
}

RC_GTEST_PROP(RobustnessPropertyTest, DamagedMappingsAreReadOrRefused, ()) {
  const std::string text = *damaged(std::string(*builtin_mapping_text("varanus-rover")));
  Sink sink;
  const auto file = sink.sources.add("m.yaml", text);
  const auto mapping = parse_mapping(*file, sink.sources, sink.diagnostics);
  RC_ASSERT(mapping.has_value() == !sink.diagnostics.has_errors());
  sink.text();
}

RC_GTEST_PROP(RobustnessPropertyTest, DamagedConfigsAreReadOrRefused, ()) {
  const std::string text = *damaged(
      "---\nalphabet: [a, b] # all\ncommon_alphabet:\n  - a\nmain_process: \"P\"\nmodel: 'm.csp'\n"
      "mode: strict\nstress_repetitions: 7\n");
  Sink sink;
  const auto file = sink.sources.add("c.yaml", text);
  const auto config = parse_varanus_config(*file, sink.sources, sink.diagnostics);
  RC_ASSERT(config.has_value() == !sink.diagnostics.has_errors());
  sink.text();
}

RC_GTEST_PROP(RobustnessPropertyTest, DamagedEventMapsAreReadOrRefused, ()) {
  const std::string text =
      *damaged("{\"a\": \"b\", \"c\\u0041\": \"d\\\\\", \"e\": [1, {\"f\": \"}\"}], \"g\": null}");
  Sink sink;
  const auto file = sink.sources.add("map.json", text);
  const auto map = parse_event_map(*file, sink.sources, sink.diagnostics);
  RC_ASSERT(map.has_value() == !sink.diagnostics.has_errors());
  sink.text();
}

TEST(DiagnosticCodesTest, IdsAreDifferentAndAscend) {
  for (std::size_t i = 1; i < codes::all.size(); ++i) {
    EXPECT_LT(codes::all[i - 1]->id, codes::all[i]->id);
  }
  for (const base::DiagnosticCode* code : codes::all) {
    EXPECT_TRUE(code->id.starts_with("M")) << code->id;
    EXPECT_FALSE(code->title.empty());
    EXPECT_FALSE(code->title.ends_with(".")) << code->title;
  }
}

}  // namespace
}  // namespace perentie::monitor

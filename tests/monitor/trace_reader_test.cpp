// Every trace format, and every way in which a trace can be bad: what was read before stands, and
// the diagnostic points at the fault.
#include "perentie/monitor/trace_reader.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "support.hpp"

namespace perentie::monitor {
namespace {

using Texts = std::vector<std::string>;

// All records of a text, as "line:column kind text".
Texts records_of(std::string text, TraceFormat format = TraceFormat::automatic) {
  Sink sink;
  TraceReport report{"trace", sink.sources, sink.diagnostics};
  const auto reader = open_trace_text(std::move(text), {format, false}, report);
  Texts texts;
  TraceRecord record;
  while (reader && reader->next(record)) {
    const bool event = record.kind == TraceRecord::Kind::event;
    texts.push_back(std::to_string(record.place.line) + ":" + std::to_string(record.place.column) +
                    (event ? " event " : " message ") + std::string(record.text));
  }
  if (sink.diagnostics.has_errors()) texts.push_back(sink.text());
  return texts;
}

TEST(TraceReaderTest, TextIsOneEventPerLine) {
  EXPECT_EQ(records_of("move.1\n  Event: radiation_level.Green\nEvent:stop"),
            (Texts{"1:1 event move.1", "2:10 event radiation_level.Green", "3:7 event stop"}));
}

TEST(TraceReaderTest, JsonLinesAreMessagesAndEvents) {
  EXPECT_EQ(records_of("{\"topic\": \"a\"}\n\"move.1\"\n"),
            (Texts{"1:1 message {\"topic\": \"a\"}", "2:1 event move.1"}));
}

TEST(TraceReaderTest, ArraysMayBeOnOneLineOnManyAndSeveral) {
  EXPECT_EQ(records_of(
                "[\"a\", {\"topic\":\"b\",\"data\":[\"]\",{}]},\n \"c. true\"]\n[]\n[\"\\u00e9\"]"),
            (Texts{"1:2 event a", "1:7 message {\"topic\":\"b\",\"data\":[\"]\",{}]}",
                   "2:2 event c. true", "4:2 event é"}));
}

TEST(TraceReaderTest, ByteOrderMarkLineEndsAndBlankLinesMeanNothing) {
  EXPECT_EQ(records_of("\xEF\xBB\xBF\r\n\r\na\r\n \t \r\nb\r\n"),
            (Texts{"3:1 event a", "5:1 event b"}));
  EXPECT_EQ(records_of("\xEF\xBB\xBF{\"topic\":1}\r\n"), (Texts{"1:1 message {\"topic\":1}"}));
  EXPECT_EQ(records_of("\xEF\xBB\xBF \n[\"a\"]"), (Texts{"2:2 event a"}));
}

TEST(TraceReaderTest, AnEmptyTraceHasNoRecords) {
  for (const char* text : {"", "\n\n", " \t\r\n", "\xEF\xBB\xBF", "[]"}) {
    EXPECT_EQ(records_of(text), Texts{}) << text;
  }
}

TEST(TraceReaderTest, TheFormatCanBeGiven) {
  EXPECT_EQ(records_of("(1)", TraceFormat::text), (Texts{"1:1 event (1)"}));
  EXPECT_EQ(records_of("[1]", TraceFormat::text),
            (Texts{"trace:1:1: error: this is not an event but looks like JSON (--trace-format "
                   "json-lines) [M022]\n[1]\n^\n"}));
  EXPECT_EQ(records_of("move.1", TraceFormat::json_lines),
            (Texts{"trace:1:1: error: this line is not a JSON object or string [M021]\n"
                   "move.1\n^\n"}));
  EXPECT_EQ(records_of("{}", TraceFormat::json_array),
            (Texts{"trace:1:1: error: expected `[`, which begins an array of events [M021]\n"
                   "{}\n^\n"}));
  EXPECT_EQ(trace_format_from_name("json-lines"), TraceFormat::json_lines);
  EXPECT_EQ(trace_format_from_name("csv"), std::nullopt);
}

struct BadTrace {
  const char* name;
  std::string text;
  Texts records;  // the diagnostics last
};

class BadTraceTest : public testing::TestWithParam<BadTrace> {};

TEST_P(BadTraceTest, IsReportedAtItsPlace) {
  EXPECT_EQ(records_of(GetParam().text), GetParam().records);
}

const BadTrace bad_traces[] = {
    {"blank_between_words",
     "a\nmove 1\nb\n",
     {"1:1 event a",
      "trace:2:5: error: this is not an event: blanks may stand only around dots, commas and "
      "brackets "
      "[M022]\nmove 1\n    ^\n"}},
    {"no_event_after_the_prefix",
     "Event:  \n",
     {"trace:1:7: error: this is not an event: it is empty [M022]\nEvent:\n      ^\n"}},
    {"control_character",
     "a\x01z\n",
     {"trace:1:2: error: this is not an event: it has a control character [M022]\na z\n ^\n"}},
    {"broken_utf8",
     "a\xFFz\n",
     {"trace:1:1: error: this is not an event: it is not UTF-8 [M022]\na\xFFz\n^\n"}},
    {"text_among_json_lines",
     "{\"topic\": \"a\"}\nTraceback\n",
     {"1:1 message {\"topic\": \"a\"}",
      "trace:2:1: error: this line is not a JSON object or string [M021]\nTraceback\n^\n"}},
    {"unclosed_string_line",
     "\"a\"\n\"b\n",
     {"1:1 event a",
      "trace:2:3: error: the line ends in the middle of a JSON string [M021]\n\"b\n  ^\n"}},
    {"two_strings_on_a_line",
     "\"a\" \"b\"\n",
     {"trace:1:5: error: this line is not one JSON string [M021]\n\"a\" \"b\"\n    ^~~\n"}},
    {"array_without_end",
     "[\"a\",\n\"b\"\n",
     {"1:2 event a", "2:1 event b",
      "trace:3:1: error: the trace ends before the array is closed by `]` [M021]\n\n^\n"}},
    {"array_cut_in_an_element",
     "[\"a\", \"b",
     {"1:2 event a",
      "trace:1:9: error: the trace ends in the middle of an element [M021]\n\"b\n  ^\n"}},
    {"array_without_comma",
     "[\"a\" \"b\"]",
     {"1:2 event a", "trace:1:6: error: expected `,` or `]` after an element [M021]\n\"b\"]\n^\n"}},
    {"array_of_numbers",
     "[1, 2]",
     {"trace:1:2: error: an element must be an event (a string) or a message (an object) [M021]\n"
      "1, 2]\n^\n"}},
    {"text_after_an_array",
     "[\"a\"] b",
     {"1:2 event a",
      "trace:1:7: error: expected `[`, which begins an array of events [M021]\nb\n^\n"}},
    {"unknown_escape",
     "[\"\\q\"]",
     {"trace:1:2: error: this string has an escape that JSON does not know "
      "[M021]\n\"\\q\"\n^~~~\n"}},
    {"half_a_surrogate",
     "[\"\\ud83d\"]",
     {"trace:1:2: error: this string has an escape that JSON does not know [M021]\n\"\\ud83d\"\n"
      "^~~~~~~~\n"}},
    {"binary",
     std::string("\x7F"
                 "ELF\0\0",
                 6),
     {"perentie: error: `trace` holds no trace: it is a binary file [M020]\n"}},
    {"utf16",
     std::string("\xFF\xFE{\0", 4),
     {"perentie: error: `trace` holds no trace: it is UTF-16; a trace must be UTF-8 [M020]\n"}},
};

INSTANTIATE_TEST_SUITE_P(Traces, BadTraceTest, testing::ValuesIn(bad_traces),
                         [](const auto& instance) { return instance.param.name; });

TEST(TraceReaderTest, FilesThatCannotBeReadAreNamed) {
  Sink sink;
  TraceReport missing{"none.jsonl", sink.sources, sink.diagnostics};
  EXPECT_EQ(open_trace("none.jsonl", {}, missing), nullptr);
  TraceReport folder{"tests", sink.sources, sink.diagnostics};
  EXPECT_EQ(open_trace("tests", {}, folder), nullptr);
  EXPECT_EQ(
      sink.text(),
      "perentie: error: cannot read the trace `none.jsonl`: No such file or directory [M001]\n"
      "perentie: error: cannot read the trace `tests`: it is a directory [M001]\n");
}

// Lines and elements that cross the reader's windows, of a file larger than several of them.
std::size_t count_events(const std::string& path, const std::string& first,
                         const std::string& last) {
  Sink sink;
  TraceReport report{path, sink.sources, sink.diagnostics};
  const auto reader = open_trace(path, {}, report);
  std::size_t count = 0;
  TraceRecord record;
  std::string text;
  while (reader->next(record)) {
    text = record.text;
    if (count == 0) {
      EXPECT_EQ(text, first);
    }
    ++count;
  }
  EXPECT_EQ(text, last);
  EXPECT_EQ(sink.text(), "");
  return count;
}

TEST(TraceReaderTest, LargeFilesPassThroughASmallWindow) {
  std::string lines;
  std::string array = "[";
  for (int i = 0; i < 200000; ++i) {
    const std::string event = "event." + std::to_string(i);
    lines += event + "\n";
    array += (i > 0 ? ", \"" : "\"") + event + "\"";
  }
  array += "]";
  EXPECT_EQ(count_events(TempFile(lines).path(), "event.0", "event.199999"), 200000U);
  EXPECT_EQ(count_events(TempFile(array).path(), "event.0", "event.199999"), 200000U);
  // A line that is larger than the window.
  const std::string long_event(1 << 20, 'x');
  EXPECT_EQ(count_events(TempFile("a\n" + long_event + "\nb").path(), "a", "b"), 3U);
  EXPECT_EQ(count_events(TempFile("[\"a\",\"" + long_event + "\"]").path(), "a", long_event), 2U);
}

TEST(TraceReaderTest, AnEndlessLineIsRefused) {
  const Texts lines = records_of("a\n" + std::string((64U << 20U) + 2, 'x'));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NE(lines[1].find("trace:2:1: error: the line is longer than 64 MiB [M026]"),
            std::string::npos)
      << lines[1];
  const Texts elements = records_of("[\"a\",\"" + std::string((64U << 20U) + 2, 'x'));
  ASSERT_EQ(elements.size(), 2U);
  EXPECT_NE(elements[1].find("trace:1:6: error: the element is longer than 64 MiB [M026]"),
            std::string::npos)
      << elements[1];
}

TEST(TraceReaderTest, DeepNestingIsNoDanger) {
  const std::string deep(100000, '[');
  EXPECT_EQ(records_of("[" + deep).size(), 1U);  // a diagnostic
  const Texts message =
      records_of("{\"topic\":\"a\",\"x\":" + deep + std::string(100000, ']') + "}");
  EXPECT_EQ(message.size(), 1U);
}

TEST(TraceReaderTest, PipesAreReadAndReadAgain) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::string content = "{\"topic\":\"a\",\"data\":null}\n{\"topic\":\"b\",\"data\":null}\n";
  ASSERT_EQ(::write(ends[1], content.data(), content.size()), static_cast<ssize_t>(content.size()));
  ::close(ends[1]);
  const std::string path = "/dev/fd/" + std::to_string(ends[0]);
  // No rover topic, so the trace is read a second time with the simple mapping.
  TestTrace trace = TestTrace::from_file(path, {.mapping = "varanus-rover", .fallback = "simple"});
  EXPECT_EQ(trace.events(), (Texts{"a", "b"})) << trace.diagnostics();
  ::close(ends[0]);
}

}  // namespace
}  // namespace perentie::monitor

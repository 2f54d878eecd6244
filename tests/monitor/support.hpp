// What the monitor tests share: a diagnostics sink, models from text, traces from text and files.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "perentie/lts/normalise.hpp"
#include "perentie/monitor/event_stream.hpp"
#include "perentie/monitor/session.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::monitor {

struct Sink {
  base::SourceMap sources;
  base::Diagnostics diagnostics;

  std::string text() const { return render_all(diagnostics, sources); }
};

/// A model from the edges of `lts_from`, such as "0 a 1; 1 b 0".
inline MonitorModel model_from(std::string_view edges,
                               const std::vector<std::string>& alphabet = {}) {
  return make_monitor_model(lts::normalise(test::lts_from(edges, alphabet)).normal);
}

/// A file that lives as long as the object.
class TempFile {
 public:
  explicit TempFile(std::string_view content, std::string_view extension = ".txt") {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("perentie-test-" + std::to_string(::getpid()) + "-" + std::to_string(count++) +
             std::string(extension));
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TempFile() { std::filesystem::remove(path_); }
  TempFile(const TempFile&) = delete;
  TempFile& operator=(const TempFile&) = delete;

  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// How a trace is read in a test.
struct TraceSetup {
  TraceFormat format = TraceFormat::automatic;
  std::string mapping = "simple";  ///< name or path of the mapping; with a line end: its YAML text
  std::string fallback = {};       ///< the same; empty: none
  std::vector<std::pair<std::string, std::string>> event_map = {};
};

/// The trace `text`, called `trace` in diagnostics, with everything that it needs to live.
class TestTrace {
 public:
  explicit TestTrace(std::string text, const TraceSetup& setup = {}) : report_(report("trace")) {
    prepare(setup);
    open(open_trace_text(std::move(text), reader_options(sources_, setup.format), report_));
  }
  /// A trace file, called by its path.
  static TestTrace from_file(const std::string& path, const TraceSetup& setup = {}) {
    return TestTrace(path, setup, 0);
  }

  bool opened() const { return stream_.has_value(); }
  EventStream& stream() { return *stream_; }
  std::string diagnostics() const { return sink_->text(); }

  /// The texts of all events up to the end of the trace or the first fault.
  std::vector<std::string> events() {
    std::vector<std::string> texts;
    TraceEvent event;
    while (stream_ && stream_->next(event)) texts.emplace_back(event.text);
    return texts;
  }

 private:
  TestTrace(const std::string& path, const TraceSetup& setup, int) : report_(report(path)) {
    prepare(setup);
    open(open_trace(path, reader_options(sources_, setup.format), report_));
  }

  TraceReport report(std::string path) {
    return {std::move(path), sink_->sources, sink_->diagnostics};
  }

  void prepare(const TraceSetup& setup) {
    for (const auto& [name, model_name] : setup.event_map) event_map_.add(name, model_name);
    mapping_ = load(setup.mapping);
    if (!setup.fallback.empty()) fallback_ = load(setup.fallback);
    EXPECT_TRUE(mapping_) << sink_->text();
    sources_ = {mapping_ ? &*mapping_ : nullptr, fallback_ ? &*fallback_ : nullptr, &event_map_};
  }

  std::optional<Mapping> load(const std::string& mapping) {
    if (mapping.find('\n') == std::string::npos) {
      return load_mapping(mapping, sink_->sources, sink_->diagnostics);
    }
    const auto file = sink_->sources.add("mapping.yaml", mapping);
    return parse_mapping(*file, sink_->sources, sink_->diagnostics);
  }

  void open(std::unique_ptr<TraceReader> reader) {
    if (reader != nullptr && mapping_) stream_.emplace(std::move(reader), sources_, report_);
  }

  std::unique_ptr<Sink> sink_ = std::make_unique<Sink>();
  TraceReport report_;
  EventMap event_map_;
  std::optional<Mapping> mapping_;
  std::optional<Mapping> fallback_;
  EventSources sources_;
  std::optional<EventStream> stream_;
};

}  // namespace perentie::monitor

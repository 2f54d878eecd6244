// TraceReader: the records of a trace file, one after the other, whatever its format.
//
// A record is the text of an event (`move.1`) or a message of the system as JSON, which a mapping
// turns into events. Files are streamed: memory holds a window on the file and never less than the
// current record. Bad input is reported at its line and column and ends the trace; the records
// before it stand. A byte-order mark, CR LF line ends and blank lines mean nothing.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "perentie/base/diagnostic.hpp"

namespace perentie::monitor {

enum class TraceFormat : std::uint8_t {
  automatic,   ///< by the first character: `{` or `"` JSON lines, `[` JSON array, else text
  json_lines,  ///< one JSON object (a message) or string (an event) per line
  json_array,  ///< JSON arrays of objects and strings, over any number of lines
  text,        ///< one event per line, with or without `Event:` before it
};

/// "json-lines" and so on; none if there is no such format.
std::optional<TraceFormat> trace_format_from_name(std::string_view name);

/// Where a record stands in its file; both from 1, columns in characters.
struct TracePlace {
  std::uint64_t line = 1;
  std::uint64_t column = 1;

  friend constexpr bool operator==(TracePlace, TracePlace) = default;
};

struct TraceRecord {
  enum class Kind : std::uint8_t { event, message };

  Kind kind = Kind::event;
  std::string_view text;    ///< the event, or the message as JSON; until the next record is read
  std::string_view source;  ///< the record as it stands in the file, without blanks around it
  TracePlace place;
};

/// Where the diagnostics of one trace go.
struct TraceReport {
  std::string path;  ///< as messages name it
  base::SourceMap& sources;
  base::Diagnostics& diagnostics;
};

class TraceReader {
 public:
  virtual ~TraceReader() = default;

  /// The next record. False at the end of the trace and at bad input, which has then been reported.
  virtual bool next(TraceRecord& record) = 0;
  /// Back to the first record, if the reader was opened as rewindable.
  virtual void rewind() = 0;
  /// True once bad input has been met.
  virtual bool failed() const = 0;
};

struct TraceReaderOptions {
  TraceFormat format = TraceFormat::automatic;
  /// Lets `rewind` work. Costs memory only where the input cannot be read twice (a pipe).
  bool rewindable = false;
  /// Ends the trace as an error of reading does, also while a pipe is waited for. Null: never.
  const std::atomic<bool>* cancelled = nullptr;
};

/// Opens a file, or standard input if the path is `-`. None after a diagnostic if it cannot be read
/// or is no text. The report must outlive the reader.
std::unique_ptr<TraceReader> open_trace(const std::string& path, const TraceReaderOptions& options,
                                        TraceReport& report);

/// The same for a text in memory.
std::unique_ptr<TraceReader> open_trace_text(std::string text, const TraceReaderOptions& options,
                                             TraceReport& report);

}  // namespace perentie::monitor

// TraceInput: the bytes of a trace through a sliding window.
//
// The window is the stretch of unread bytes that is in memory. It grows at its end by `more` and
// shrinks at its front by `consume`; the buffer is reused, so a file of any size passes through a
// window as large as its largest record. `padding` bytes after the window may always be read, which
// is what simdjson asks for.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "perentie/monitor/trace_reader.hpp"

namespace perentie::monitor {

class TraceInput {
 public:
  static constexpr std::size_t padding = 64;

  TraceInput(TraceInput&& other) noexcept;
  TraceInput& operator=(TraceInput&&) = delete;
  ~TraceInput();

  /// Opens a file, or standard input for `-`. None: `error` says why in the system's words.
  static std::optional<TraceInput> open(const std::string& path, const TraceReaderOptions& options,
                                        std::string& error);
  static TraceInput of_text(std::string_view text);

  std::string_view window() const { return {buffer_.data() + begin_, end_ - begin_}; }
  void consume(std::size_t count) { begin_ += count; }
  /// Reads further bytes behind the window, which may move. False at the end of the input and where
  /// reading fails.
  bool more();
  /// Why reading failed; empty if it did not.
  const std::string& read_error() const { return read_error_; }
  /// Back to the first byte.
  void rewind();

 private:
  TraceInput() = default;

  void read_everything();
  bool is_cancelled() const { return cancelled_ != nullptr && *cancelled_; }
  void wait_for_pipe() const;

  const std::atomic<bool>* cancelled_ = nullptr;
  int file_ = -1;  // -1: everything is in the buffer
  bool own_file_ = false;
  std::int64_t start_ = -1;  // where the input began in the file; -1: it cannot be read twice
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  // the window, in buffer_
  std::size_t end_ = 0;
  std::string read_error_;
};

}  // namespace perentie::monitor

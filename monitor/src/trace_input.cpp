#include "trace_input.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace perentie::monitor {
namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 18U;

}  // namespace

TraceInput::TraceInput(TraceInput&& other) noexcept
    : cancelled_(other.cancelled_),
      file_(std::exchange(other.file_, -1)),
      own_file_(std::exchange(other.own_file_, false)),
      start_(other.start_),
      buffer_(std::move(other.buffer_)),
      begin_(other.begin_),
      end_(other.end_),
      read_error_(std::move(other.read_error_)) {}

TraceInput::~TraceInput() {
  if (own_file_) ::close(file_);
}

std::optional<TraceInput> TraceInput::open(const std::string& path,
                                           const TraceReaderOptions& options, std::string& error) {
  TraceInput input;
  input.cancelled_ = options.cancelled;
  if (path == "-") {
    input.file_ = STDIN_FILENO;
  } else {
    input.file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    input.own_file_ = input.file_ >= 0;
  }
  struct stat status {};
  if (input.file_ < 0 || ::fstat(input.file_, &status) != 0) {
    error = std::strerror(errno);
    return std::nullopt;
  }
  if (S_ISDIR(status.st_mode)) {
    error = "it is a directory";
    return std::nullopt;
  }
  input.start_ = S_ISREG(status.st_mode) ? ::lseek(input.file_, 0, SEEK_CUR) : -1;
  if (options.rewindable && input.start_ < 0) input.read_everything();
  return input;
}

TraceInput TraceInput::of_text(std::string_view text) {
  TraceInput input;
  input.buffer_.assign(text.begin(), text.end());
  input.buffer_.resize(text.size() + padding);
  input.end_ = text.size();
  return input;
}

bool TraceInput::more() {
  if (file_ < 0) return false;
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (buffer_.size() < end_ + chunk_bytes + padding) {
    buffer_.resize(2 * end_ + chunk_bytes + padding);
  }
  if (start_ < 0) wait_for_pipe();
  if (is_cancelled()) {
    read_error_ = "it was interrupted";
    return false;
  }
  ssize_t count = 0;
  do {
    count = ::read(file_, buffer_.data() + end_, chunk_bytes);
  } while (count < 0 && errno == EINTR);
  if (count < 0) read_error_ = std::strerror(errno);
  if (count <= 0) return false;
  end_ += static_cast<std::size_t>(count);
  return true;
}

// A signal does not end a read that waits, so there is none until there is something to read.
void TraceInput::wait_for_pipe() const {
  constexpr int milliseconds = 100;
  pollfd pipe{file_, POLLIN, 0};
  while (!is_cancelled() && ::poll(&pipe, 1, milliseconds) == 0) {
  }
}

void TraceInput::read_everything() {
  while (more()) {
  }
  if (own_file_) ::close(file_);
  own_file_ = false;
  file_ = -1;
}

void TraceInput::rewind() {
  begin_ = 0;
  if (file_ < 0) return;
  end_ = 0;
  ::lseek(file_, static_cast<off_t>(start_), SEEK_SET);
}

}  // namespace perentie::monitor

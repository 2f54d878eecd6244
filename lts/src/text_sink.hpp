// TextSink: what the writers of graph files print through: a buffer of bounded size before a
// stream, with fast numbers.
#pragma once

#include <charconv>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

namespace perentie::lts {

class TextSink {
 public:
  explicit TextSink(std::ostream& out) : out_(out) { buffer_.reserve(capacity); }
  TextSink(const TextSink&) = delete;
  TextSink& operator=(const TextSink&) = delete;
  ~TextSink() { flush(); }

  TextSink& operator<<(std::string_view text) {
    if (buffer_.size() + text.size() > capacity) flush();
    buffer_ += text;
    return *this;
  }
  TextSink& operator<<(char c) { return *this << std::string_view(&c, 1); }
  TextSink& operator<<(std::uint64_t number) {
    char digits[20];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, number);
    return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
  }

 private:
  static constexpr std::size_t capacity = std::size_t{1} << 16U;

  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

  std::ostream& out_;
  std::string buffer_;
};

}  // namespace perentie::lts

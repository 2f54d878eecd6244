// Field paths: `pose.position.x` and `ranges[0]` as steps.
#include <charconv>

#include <fmt/format.h>

#include "perentie/monitor/mapping.hpp"

namespace perentie::monitor {
namespace {

constexpr std::size_t max_path_steps = 32;

// Takes `[12]` off the front.
std::optional<std::uint32_t> take_index(std::string_view& text) {
  std::uint32_t index = 0;
  const char* const begin = text.data() + 1;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(begin, end, index);
  if (error != std::errc{} || after == end || *after != ']') return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(after + 1 - text.data()));
  return index;
}

}  // namespace

std::optional<FieldPath> parse_field_path(std::string_view text) {
  FieldPath path;
  bool key_expected = true;
  while (!text.empty() || key_expected) {
    if (path.size() == max_path_steps) return std::nullopt;
    if (text.starts_with('[') && !key_expected) {
      const std::optional<std::uint32_t> index = take_index(text);
      if (!index) return std::nullopt;
      path.emplace_back(*index);
    } else {
      const std::string_view key = text.substr(0, text.find_first_of(".[]{}"));
      if (!key_expected || key.empty()) return std::nullopt;
      path.emplace_back(std::string(key));
      text.remove_prefix(key.size());
    }
    key_expected = text.starts_with('.');
    if (key_expected) text.remove_prefix(1);
  }
  return path;
}

std::string to_string(const FieldPath& path) {
  std::string text;
  for (const auto& step : path) {
    if (const auto* index = std::get_if<std::uint32_t>(&step)) {
      text += fmt::format("[{}]", *index);
    } else {
      if (!text.empty()) text += '.';
      text += std::get<std::string>(step);
    }
  }
  return text;
}

}  // namespace perentie::monitor

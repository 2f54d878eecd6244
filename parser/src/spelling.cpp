#include "perentie/parser/spelling.hpp"

#include <array>
#include <cstddef>

namespace perentie::parser {
namespace {

// Each table is in the order of its enumeration.
constexpr auto models = std::to_array<std::string_view>({"T", "F", "FD", "V", "VD", "R", "RD"});
constexpr auto properties =
    std::to_array<std::string_view>({"deadlock free", "divergence free", "deterministic"});
constexpr auto property_words = std::to_array<std::string_view>(
    {"deadlock free", "livelock free", "divergence free", "deterministic", "has trace",
     "tau priority", "partial order reduce"});
constexpr auto reductions = std::to_array<std::string_view>({"precise", "hybrid", "fast"});

template <class Enum, std::size_t size>
std::optional<Enum> find(const std::array<std::string_view, size>& table, std::string_view text) {
  for (std::size_t i = 0; i < size; ++i) {
    if (table[i] == text) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

}  // namespace

std::string_view spelling(Model model) { return models[static_cast<std::size_t>(model)]; }
std::string_view spelling(Property property) {
  return properties[static_cast<std::size_t>(property)];
}
std::string_view spelling(PropertyWord word) {
  return property_words[static_cast<std::size_t>(word)];
}
std::string_view spelling(PartialOrderMode mode) {
  return reductions[static_cast<std::size_t>(mode)];
}

std::optional<Model> model_of(std::string_view text) { return find<Model>(models, text); }

std::optional<PropertyWord> property_word_of(std::string_view text) {
  if (text == "tau priority over") return PropertyWord::tau_priority;
  return find<PropertyWord>(property_words, text);
}

std::optional<PartialOrderMode> reduction_of(std::string_view text) {
  return find<PartialOrderMode>(reductions, text);
}

}  // namespace perentie::parser

#include "perentie/monitor/visible_channels.hpp"

#include <algorithm>
#include <unordered_set>

#include <fmt/format.h>

#include "perentie/base/text.hpp"
#include "perentie/monitor/diagnostic_codes.hpp"
#include "perentie/monitor/event_index.hpp"
#include "yaml_file.hpp"

namespace perentie::monitor {
namespace {

using NameSet = std::unordered_set<std::string_view>;

// Whether `event`, or a beginning of it that ends before a dot, is in `names`.
bool belongs_to(std::string_view event, const NameSet& names) {
  for (;;) {
    if (names.contains(event)) return true;
    const std::size_t dot = event.rfind('.');
    if (dot == std::string_view::npos) return false;
    event = event.substr(0, dot);
  }
}

// The labels, other than τ and ✓, for which belonging to `names` is `selected`.
std::vector<lts::Label> select_labels(const lts::LabelNames& labels,
                                      std::span<const std::string> names, bool selected) {
  const NameSet set(names.begin(), names.end());
  std::vector<lts::Label> result;
  for (std::uint32_t i = lts::tick.value + 1; i < labels.size(); ++i) {
    if (belongs_to(labels[i], set) == selected) result.push_back(lts::Label{i});
  }
  return result;
}

void report_unknown(const Placed<std::string>& name, std::string_view model_name,
                    std::span<const std::string> channels, base::Diagnostics& diagnostics) {
  std::string message = fmt::format("the model has no channel `{}`", model_name);
  if (model_name != name.value) {
    message += fmt::format(", which `{}` is in the event map", name.value);
  }
  base::Diagnostic& diagnostic =
      name.span ? diagnostics.report(codes::unknown_channel, *name.span, std::move(message))
                : diagnostics.report(codes::unknown_channel, std::move(message));
  const std::vector<std::string_view> candidates(channels.begin(), channels.end());
  const std::string_view word = model_name.substr(0, model_name.find('.'));
  const std::vector<std::string_view> near = base::nearest_words(word, candidates);
  if (!near.empty()) {
    diagnostic.notes.push_back({std::nullopt, fmt::format("did you mean {}?", list_words(near))});
  }
}

}  // namespace

std::optional<std::vector<std::string>> resolve_channels(std::span<const Placed<std::string>> names,
                                                         const EventMap* event_map,
                                                         std::span<const std::string> channels,
                                                         base::Diagnostics& diagnostics) {
  const NameSet declared(channels.begin(), channels.end());
  std::vector<std::string> resolved;
  bool good = true;
  for (const Placed<std::string>& name : names) {
    const std::string model_name = normalise_event_text(
        event_map == nullptr ? name.value : event_map->rename_event(name.value));
    if (belongs_to(model_name, declared)) {
      resolved.push_back(model_name);
    } else {
      good = false;
      report_unknown(name, model_name, channels, diagnostics);
    }
  }
  if (!good) return std::nullopt;
  return resolved;
}

std::vector<lts::Label> labels_of_channels(const lts::LabelNames& labels,
                                           std::span<const std::string> names) {
  return select_labels(labels, names, true);
}

std::vector<lts::Label> labels_not_of_channels(const lts::LabelNames& labels,
                                               std::span<const std::string> names) {
  return select_labels(labels, names, false);
}

}  // namespace perentie::monitor

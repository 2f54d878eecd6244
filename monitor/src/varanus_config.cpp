#include "perentie/monitor/varanus_config.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "perentie/monitor/diagnostic_codes.hpp"
#include "perentie/monitor/mapping.hpp"
#include "yaml_file.hpp"

namespace perentie::monitor {
namespace {

constexpr std::string_view what = "a config";

class ConfigParser {
 public:
  ConfigParser(base::FileId file, const base::SourceMap& sources, base::Diagnostics& diagnostics)
      : yaml_(file, sources, diagnostics),
        config_path_(sources.path(file)),
        diagnostics_(&diagnostics) {}

  std::optional<VaranusConfig> parse() {
    const std::size_t errors_before = diagnostics_->error_count();
    const std::optional<YAML::Node> root = yaml_.parse();
    if (!root) return std::nullopt;
    root_ = *root;
    yaml_.check_keys(
        root_, what,
        {"model", "main_process", "alphabet", "common_alphabet", "map", "trace_file", "name",
         "mode", "stress_events", "stress_repetitions", "predictive_ltl_ws_url", "mapping"});
    VaranusConfig config = read();
    if (diagnostics_->error_count() > errors_before) return std::nullopt;
    return config;
  }

 private:
  VaranusConfig read() {
    VaranusConfig config;
    config.model = resolved(required("model"));
    config.main_process = required("main_process");
    config.alphabet = channels("alphabet");
    config.common_alphabet = channels("common_alphabet");
    config.map = optional_path("map");
    config.trace_file = optional_path("trace_file");
    config.mapping = mapping();
    config.name = std::filesystem::path(config_path_).stem().string();
    if (const auto name = optional_text("name")) config.name = name->value;
    if (const YAML::Node mode = given("mode")) {
      const auto choice = yaml_.one_of(mode, "`mode`", {"strict", "permissive"});
      if (choice == 0U) config.mode = Mode::strict;
    }
    for (const Placed<std::string>& event : channels("stress_events").value_or(PlacedTexts{})) {
      config.stress_events.push_back(event.value);
    }
    if (const YAML::Node repetitions = given("stress_repetitions")) {
      config.stress_repetitions = yaml_.natural(repetitions, "`stress_repetitions`");
    }
    if (const auto url = optional_text("predictive_ltl_ws_url")) {
      config.predictive_ltl_ws_url = url->value;
    }
    return config;
  }

  using PlacedTexts = std::vector<Placed<std::string>>;

  // The node of an optional key; a key without value counts as not given.
  YAML::Node given(const char* key) const {
    const YAML::Node node = std::as_const(root_)[key];
    return node && !node.IsNull() ? node : YAML::Node(YAML::NodeType::Undefined);
  }

  Placed<std::string> required(const char* key) {
    const std::optional<YAML::Node> node = yaml_.required(root_, what, key);
    if (!node) return {};
    return {yaml_.text(*node, fmt::format("`{}`", key)).value_or(""), yaml_.span(*node)};
  }

  std::optional<Placed<std::string>> optional_text(const char* key) {
    const YAML::Node node = given(key);
    if (!node) return std::nullopt;
    return Placed<std::string>{yaml_.text(node, fmt::format("`{}`", key)).value_or(""),
                               yaml_.span(node)};
  }

  std::optional<Placed<std::string>> optional_path(const char* key) {
    std::optional<Placed<std::string>> path = optional_text(key);
    if (path) path = resolved(std::move(*path));
    return path;
  }

  std::optional<Placed<std::string>> mapping() {
    std::optional<Placed<std::string>> name = optional_text("mapping");
    if (name && !builtin_mapping_text(name->value)) name = resolved(std::move(*name));
    return name;
  }

  std::optional<PlacedTexts> channels(const char* key) {
    const YAML::Node node = given(key);
    if (!node) return std::nullopt;
    PlacedTexts texts;
    for (const YAML::Node& item :
         yaml_.list_of_texts(node, fmt::format("`{}`", key)).value_or(std::vector<YAML::Node>{})) {
      texts.push_back({item.Scalar(), yaml_.span(item)});
    }
    return texts;
  }

  Placed<std::string> resolved(Placed<std::string> path) const {
    path.value = resolve_path(config_path_, path.value);
    return path;
  }

  YamlFile yaml_;
  std::string config_path_;
  base::Diagnostics* diagnostics_;
  YAML::Node root_;
};

}  // namespace

std::string resolve_path(std::string_view from, const std::string& path) {
  if (path == "-" || std::filesystem::path(path).is_absolute()) return path;
  return (std::filesystem::path(from).parent_path() / path).string();
}

std::optional<VaranusConfig> parse_varanus_config(base::FileId file, const base::SourceMap& sources,
                                                  base::Diagnostics& diagnostics) {
  return ConfigParser(file, sources, diagnostics).parse();
}

std::optional<VaranusConfig> load_varanus_config(const std::string& path, base::SourceMap& sources,
                                                 base::Diagnostics& diagnostics) {
  const base::AddedFile added = base::add_file(path, sources);
  if (!added.file) {
    diagnostics.report(codes::unreadable_file,
                       fmt::format("cannot read the config `{}`: {}", path, added.error));
    return std::nullopt;
  }
  return parse_varanus_config(*added.file, sources, diagnostics);
}

}  // namespace perentie::monitor

// Reading mappings. Every check reports and goes on, so one run shows all that is wrong with a
// file.
#include "perentie/monitor/mapping.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "event_template.hpp"
#include "perentie/monitor/diagnostic_codes.hpp"
#include "yaml_file.hpp"

namespace perentie::monitor {
namespace {

constexpr std::uint64_t format_version = 1;

using NodeList = std::vector<YAML::Node>;

class MappingParser {
 public:
  MappingParser(base::FileId file, const base::SourceMap& sources, base::Diagnostics& diagnostics)
      : yaml_(file, sources, diagnostics), diagnostics_(&diagnostics) {}

  std::optional<Mapping> parse() {
    const std::size_t errors_before = diagnostics_->error_count();
    const std::optional<YAML::Node> root = yaml_.parse();
    if (!root) return std::nullopt;
    Mapping mapping = read_mapping(*root);
    if (diagnostics_->error_count() > errors_before) return std::nullopt;
    return mapping;
  }

 private:
  Mapping read_mapping(const YAML::Node& root) {
    constexpr std::string_view what = "a mapping";
    yaml_.check_keys(
        root, what,
        {"perentie-mapping", "name", "topic-field", "leading-slash", "unknown-topics", "rules"});
    Mapping mapping;
    check_version(root);
    if (const YAML::Node name = root["name"]) {
      mapping.name = yaml_.text(name, "`name`").value_or("");
    }
    if (const YAML::Node path = root["topic-field"])
      mapping.topic = read_path(path, "`topic-field`");
    if (const YAML::Node slash = root["leading-slash"]) {
      mapping.leading_slash_optional =
          yaml_.one_of(slash, "`leading-slash`", {"significant", "optional"}) != 0U;
    }
    if (const YAML::Node unknown = root["unknown-topics"]) {
      mapping.ignore_unknown_topics =
          yaml_.one_of(unknown, "`unknown-topics`", {"error", "ignore"}) == 1U;
    }
    const std::optional<YAML::Node> rules = yaml_.required(root, what, "rules");
    if (rules && yaml_.is_list(*rules, "`rules`")) {
      for (const YAML::Node& rule : *rules) {
        if (yaml_.is_map(rule, "a rule")) mapping.rules.push_back(read_rule(rule));
      }
    }
    return mapping;
  }

  void check_version(const YAML::Node& root) {
    const std::optional<YAML::Node> version = yaml_.required(root, "a mapping", "perentie-mapping");
    if (!version) return;
    const std::optional<std::uint64_t> number = yaml_.natural(*version, "`perentie-mapping`");
    if (!number || *number == format_version) return;
    yaml_.report(codes::bad_value, *version,
                 fmt::format("the mapping is of format {}, but this program reads format {}",
                             *number, format_version));
  }

  Rule read_rule(const YAML::Node& node) {
    yaml_.check_keys(node, "a rule", {"topic", "has", "values", "event", "events", "ignore"});
    Rule rule;
    if (const YAML::Node topic = node["topic"]) rule.topic = yaml_.text(topic, "`topic`");
    if (const YAML::Node has = node["has"]) {
      for (const YAML::Node& path : yaml_.list_of_texts(has, "`has`").value_or(NodeList{})) {
        rule.has.push_back(read_path(path, "`has`"));
      }
    }
    if (!node["topic"] && !node["has"]) {
      yaml_.report(codes::missing_key, node,
                   "a rule must say which messages it is for, by `topic` or by `has`");
    }
    if (const YAML::Node values = node["values"]; values && yaml_.is_map(values, "`values`")) {
      for (const auto& entry : values) read_value(entry.first, entry.second, rule);
    }
    read_events(node, rule);
    return rule;
  }

  // Exactly one of `event`, `events` and `ignore: true` says what becomes of the message.
  void read_events(const YAML::Node& node, Rule& rule) {
    const YAML::Node event = node["event"];
    const YAML::Node events = node["events"];
    const YAML::Node ignore = node["ignore"];
    const int given = (event ? 1 : 0) + (events ? 1 : 0) + (ignore ? 1 : 0);
    if (given != 1) {
      yaml_.report(codes::missing_key, node,
                   "a rule must have exactly one of `event`, `events` and `ignore: true`");
      return;
    }
    if (ignore && yaml_.boolean(ignore, "`ignore`") == false) {
      yaml_.report(codes::bad_value, ignore,
                   "`ignore: false` says nothing; give `event` or `events` instead");
    }
    if (event && yaml_.text(event, "`event`")) read_template(event, rule);
    if (events) {
      const auto templates = yaml_.list_of_texts(events, "`events`").value_or(NodeList{});
      if (events.IsSequence() && events.size() == 0) {
        yaml_.report(codes::bad_value, events, "`events` is empty; write `ignore: true` instead");
      }
      for (const YAML::Node& text : templates) read_template(text, rule);
    }
  }

  void read_template(const YAML::Node& node, Rule& rule) {
    ParsedTemplate parsed = parse_event_template(
        node.Scalar(), [&rule](std::string_view name) { return value_index(rule, name); });
    if (!parsed.error.empty()) {
      yaml_.report(codes::bad_event_template, node,
                   fmt::format("the event `{}` cannot be read: {}", node.Scalar(), parsed.error));
      return;
    }
    rule.events.push_back(std::move(parsed.parts));
  }

  // The value of the rule with this name; otherwise the field with this path becomes one.
  static std::optional<std::uint32_t> value_index(Rule& rule, std::string_view name) {
    const auto found = std::find_if(rule.values.begin(), rule.values.end(),
                                    [&](const MappedValue& value) { return value.name == name; });
    if (found != rule.values.end()) {
      return static_cast<std::uint32_t>(found - rule.values.begin());
    }
    std::optional<FieldPath> path = parse_field_path(name);
    if (!path) return std::nullopt;
    MappedValue value;
    value.name = std::string(name);
    value.field = std::move(*path);
    rule.values.push_back(std::move(value));
    return static_cast<std::uint32_t>(rule.values.size() - 1);
  }

  void read_value(const YAML::Node& key, const YAML::Node& node, Rule& rule) {
    const std::optional<std::string> name = yaml_.text(key, "the name of a value");
    if (!name) return;
    const std::string what = fmt::format("the value `{}`", *name);
    if (!yaml_.is_map(node, what)) return;
    yaml_.check_keys(node, what,
                     {"field", "as", "thresholds", "table", "otherwise", "missing", "event-map"});
    MappedValue value;
    value.name = *name;
    if (const auto field = yaml_.required(node, what, "field")) {
      value.field = read_path(*field, "`field`");
    }
    if (const YAML::Node as = node["as"]) {
      value.integer = yaml_.one_of(as, "`as`", {"text", "integer"}) == 1U;
    }
    if (const YAML::Node thresholds = node["thresholds"]) read_thresholds(thresholds, value);
    if (const YAML::Node table = node["table"]) read_table(table, value);
    if (node["thresholds"] && node["table"]) {
      yaml_.report(codes::bad_value, node,
                   fmt::format("{} cannot have both `thresholds` and `table`", what));
    }
    if (const YAML::Node otherwise = node["otherwise"]) {
      value.otherwise = read_fallback(otherwise, "`otherwise`", {"error", "ignore", "keep"});
      if (value.thresholds.empty() && value.table.empty()) {
        yaml_.report(codes::bad_value, otherwise,
                     "`otherwise` belongs to `thresholds` or `table`, of which there is none");
      }
    }
    if (const YAML::Node missing = node["missing"]) {
      value.missing = read_fallback(missing, "`missing`", {"error", "ignore", "null"});
    }
    if (const YAML::Node map = node["event-map"]) {
      value.event_map = yaml_.boolean(map, "`event-map`").value_or(false);
    }
    rule.values.push_back(std::move(value));
  }

  void read_thresholds(const YAML::Node& node, MappedValue& value) {
    if (!yaml_.is_list(node, "`thresholds`")) return;
    for (const YAML::Node& entry : node) {
      if (!yaml_.is_map(entry, "a threshold")) continue;
      yaml_.check_keys(entry, "a threshold", {"at-least", "text"});
      const auto bound = yaml_.required(entry, "a threshold", "at-least");
      const auto text = yaml_.required(entry, "a threshold", "text");
      if (!bound || !text) continue;
      const std::optional<double> at_least = yaml_.number(*bound, "`at-least`");
      const std::optional<std::string> word = yaml_.text(*text, "`text`");
      if (!at_least || !word) continue;
      if (!value.thresholds.empty() && !(value.thresholds.back().at_least < *at_least)) {
        yaml_.report(codes::bad_value, *bound, "the bounds of thresholds must ascend");
      }
      value.thresholds.push_back({*at_least, *word});
    }
  }

  void read_table(const YAML::Node& node, MappedValue& value) {
    if (!yaml_.is_map(node, "`table`")) return;
    for (const auto& entry : node) {
      const std::optional<std::string> from = yaml_.text(entry.first, "a key of `table`");
      const std::optional<std::string> to = yaml_.text(entry.second, "an entry of `table`");
      if (!from || !to) continue;
      if (!value.table.emplace(*from, *to).second) {
        yaml_.report(codes::duplicate_key, entry.first,
                     fmt::format("the key `{}` is given twice", *from));
      }
    }
  }

  // One of three words, or {text: ...}.
  Fallback read_fallback(const YAML::Node& node, std::string_view what,
                         std::initializer_list<std::string_view> words) {
    if (node.IsMap()) {
      yaml_.check_keys(node, what, {"text"});
      const auto text = yaml_.required(node, what, "text");
      return {Fallback::Action::use, text ? yaml_.text(*text, "`text`").value_or("") : ""};
    }
    // YAML's own `null` reaches us as an empty node.
    const std::string word = node.IsNull() ? "null" : yaml_.text(node, what).value_or("error");
    if (std::find(words.begin(), words.end(), word) == words.end()) {
      yaml_.report(codes::bad_value, node,
                   fmt::format("{} must be {} or a map `{{text: ...}}`, but it is `{}`", what,
                               list_words(words), word));
    }
    if (word == "ignore") return {Fallback::Action::ignore, {}};
    if (word == "keep") return {Fallback::Action::keep, {}};
    if (word == "null") return {Fallback::Action::null, {}};
    return {Fallback::Action::error, {}};
  }

  FieldPath read_path(const YAML::Node& node, std::string_view what) {
    const std::optional<std::string> text = yaml_.text(node, what);
    if (!text) return {};
    std::optional<FieldPath> path = parse_field_path(*text);
    if (path) return std::move(*path);
    yaml_.report(
        codes::bad_field_path, node,
        fmt::format("`{}` is not a field path such as `pose.position.x` or `data[0]`", *text));
    return {};
  }

  YamlFile yaml_;
  base::Diagnostics* diagnostics_;
};

}  // namespace

std::optional<Mapping> parse_mapping(base::FileId file, const base::SourceMap& sources,
                                     base::Diagnostics& diagnostics) {
  return MappingParser(file, sources, diagnostics).parse();
}

std::optional<Mapping> load_mapping(const std::string& name_or_path, base::SourceMap& sources,
                                    base::Diagnostics& diagnostics) {
  std::string path = name_or_path;
  base::FileText file;
  if (const auto builtin = builtin_mapping_text(name_or_path)) {
    path = fmt::format("<built-in mapping {}>", name_or_path);
    file.text = std::string(*builtin);
  } else {
    file = base::read_file(path);
  }
  if (!file.text) {
    const auto names = builtin_mapping_names();
    diagnostics
        .report(codes::unreadable_file,
                fmt::format("cannot read the mapping `{}`: {}", path, file.error))
        .notes.push_back(
            {std::nullopt, fmt::format("the mappings that come with the program are {}",
                                       list_words({names.begin(), names.end()}))});
    return std::nullopt;
  }
  const std::optional<base::FileId> id = sources.add(path, std::move(*file.text));
  if (!id) {
    diagnostics.report(codes::unreadable_file, fmt::format("the mapping `{}` is too large", path));
    return std::nullopt;
  }
  std::optional<Mapping> mapping = parse_mapping(*id, sources, diagnostics);
  if (mapping && mapping->name.empty()) mapping->name = name_or_path;
  return mapping;
}

}  // namespace perentie::monitor

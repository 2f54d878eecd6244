// YAML with places: what configs and mappings are read through.
//
// The functions return none where the text is not what was asked for, after a diagnostic that
// points at it; callers go on and so report everything that is wrong at once.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "perentie/base/diagnostic.hpp"

namespace perentie::monitor {

class YamlFile {
 public:
  YamlFile(base::FileId file, const base::SourceMap& sources, base::Diagnostics& diagnostics)
      : file_(file), sources_(&sources), diagnostics_(&diagnostics) {}

  /// The file's one document, which must be a map.
  std::optional<YAML::Node> parse();

  base::Span span(const YAML::Node& node) const;
  base::Diagnostic& report(const base::DiagnosticCode& code, const YAML::Node& at,
                           std::string message);

  /// Warns of keys that are not in `known` (with what was probably meant) and refuses keys given
  /// twice.
  void check_keys(const YAML::Node& map, std::string_view what,
                  std::initializer_list<std::string_view> known);

  /// The value of a key that must be there.
  std::optional<YAML::Node> required(const YAML::Node& map, std::string_view what,
                                     const std::string& key);
  /// The text of a scalar; `what` names it in the message (such as "`mode`").
  std::optional<std::string> text(const YAML::Node& node, std::string_view what);
  std::optional<double> number(const YAML::Node& node, std::string_view what);
  std::optional<std::uint64_t> natural(const YAML::Node& node, std::string_view what);
  std::optional<bool> boolean(const YAML::Node& node, std::string_view what);
  /// Which of `words` a scalar is.
  std::optional<std::size_t> one_of(const YAML::Node& node, std::string_view what,
                                    std::initializer_list<std::string_view> words);
  /// A list of scalars; a single scalar counts as a list of one.
  std::optional<std::vector<YAML::Node>> list_of_texts(const YAML::Node& node,
                                                       std::string_view what);
  bool is_map(const YAML::Node& node, std::string_view what);
  bool is_list(const YAML::Node& node, std::string_view what);

 private:
  base::Span span_of(const YAML::Mark& mark, std::size_t length) const;
  base::Span span_of_nothing(base::Span mark) const;
  std::nullopt_t refuse(const YAML::Node& node, std::string_view what, std::string_view expected);

  base::FileId file_;
  const base::SourceMap* sources_;
  base::Diagnostics* diagnostics_;
};

/// `a`, `b` or `c`.
std::string list_words(const std::vector<std::string_view>& words);

}  // namespace perentie::monitor

#include "yaml_file.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include "perentie/base/text.hpp"
#include "perentie/monitor/diagnostic_codes.hpp"

namespace perentie::monitor {
namespace {

std::string_view kind_of(const YAML::Node& node) {
  switch (node.Type()) {
    case YAML::NodeType::Scalar:
      return "a text";
    case YAML::NodeType::Sequence:
      return "a list";
    case YAML::NodeType::Map:
      return "a map";
    default:
      return "empty";
  }
}

// Takes a document and keeps only where it begins.
struct DocumentStart : YAML::EventHandler {
  YAML::Mark mark;

  void OnDocumentStart(const YAML::Mark& start) override { mark = start; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

// Where a second document begins, if there is one. Documents are asked for one by one and never
// more than two of them: of some malformed texts (a lone `,`) yaml-cpp 0.7 makes empty documents
// without end, and `YAML::LoadAll` keeps them all (jbeder/yaml-cpp issue 1040).
std::optional<YAML::Mark> find_second_document(const std::string& text) {
  std::istringstream input(text);
  YAML::Parser parser(input);
  DocumentStart start;
  if (!parser.HandleNextDocument(start) || !parser.HandleNextDocument(start)) return std::nullopt;
  return start.mark;
}

template <class Number>
std::optional<Number> parse_number(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string list_words(const std::vector<std::string_view>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += fmt::format("`{}`", words[i]);
  }
  return text;
}

base::Span YamlFile::span_of(const YAML::Mark& mark, std::size_t length) const {
  const base::Span file = sources_->span(file_);
  const std::string_view text = sources_->text(file_);
  std::size_t at = 0;
  for (int line = 0; line < mark.line && at < text.size(); ++line) {
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  }
  at = std::min(at + static_cast<std::size_t>(std::max(mark.column, 0)), text.size());
  const std::size_t line_end = std::min(text.find('\n', at), text.size());
  const std::size_t end = std::min(at + length, line_end);
  return {file.begin + static_cast<base::Offset>(at), file.begin + static_cast<base::Offset>(end)};
}

// A value that is not there is marked where the next thing begins; its place is behind the key.
base::Span YamlFile::span_of_nothing(base::Span mark) const {
  const base::Span file = sources_->span(file_);
  const std::string_view text = sources_->text(file_);
  const std::string_view rest = text.substr(mark.begin - file.begin);
  if (rest.starts_with('~') || rest.starts_with("null")) return mark;
  const std::size_t before = text.substr(0, mark.begin - file.begin).find_last_not_of(" \t\r\n");
  const std::size_t at = before == std::string_view::npos ? 0 : before + 1;
  return {file.begin + static_cast<base::Offset>(at), file.begin + static_cast<base::Offset>(at)};
}

base::Span YamlFile::span(const YAML::Node& node) const {
  if (node.IsNull()) return span_of_nothing(span_of(node.Mark(), 1));
  std::size_t length = 1;
  if (node.IsScalar()) {
    const base::Span start = span_of(node.Mark(), 1);
    const std::string_view first = sources_->text(start);
    length = node.Scalar().size() + (first == "\"" || first == "'" ? 2 : 0);
  }
  return span_of(node.Mark(), std::max<std::size_t>(length, 1));
}

base::Diagnostic& YamlFile::report(const base::DiagnosticCode& code, const YAML::Node& at,
                                   std::string message) {
  return diagnostics_->report(code, span(at), std::move(message));
}

std::optional<YAML::Node> YamlFile::parse() {
  const std::string text(sources_->text(file_));
  YAML::Node document;
  try {
    if (const auto second = find_second_document(text)) {
      diagnostics_->report(codes::malformed_yaml, span_of(*second, 1),
                           "the file goes on behind the end of its YAML document");
      return std::nullopt;
    }
    document = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    diagnostics_->report(codes::malformed_yaml, span_of(error.mark, 1),
                         fmt::format("this is not YAML: {}", error.msg));
    return std::nullopt;
  }
  if (!document.IsMap()) {
    diagnostics_->report(
        codes::wrong_type, span_of(document.Mark(), 1),
        fmt::format("the file must be a map of keys to values, but it is {}", kind_of(document)));
    return std::nullopt;
  }
  return document;
}

void YamlFile::check_keys(const YAML::Node& map, std::string_view what,
                          std::initializer_list<std::string_view> known) {
  std::set<std::string> seen;
  for (const auto& entry : map) {
    if (!entry.first.IsScalar()) {
      report(codes::wrong_type, entry.first, fmt::format("a key of {} must be a text", what));
      continue;
    }
    const std::string& key = entry.first.Scalar();
    if (!seen.insert(key).second) {
      report(codes::duplicate_key, entry.first, fmt::format("the key `{}` is given twice", key));
    }
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    base::Diagnostic& warning =
        report(codes::unknown_key, entry.first,
               fmt::format("the key `{}` means nothing in {} and is ignored", key, what));
    const std::vector<std::string_view> candidates(known);
    const std::vector<std::string_view> near = base::nearest_words(key, candidates);
    if (!near.empty()) {
      warning.notes.push_back({std::nullopt, fmt::format("did you mean {}?", list_words(near))});
    }
  }
}

std::optional<YAML::Node> YamlFile::required(const YAML::Node& map, std::string_view what,
                                             const std::string& key) {
  const YAML::Node value = map[key];
  if (value.IsDefined()) return value;
  report(codes::missing_key, map, fmt::format("{} must have the key `{}`", what, key));
  return std::nullopt;
}

std::nullopt_t YamlFile::refuse(const YAML::Node& node, std::string_view what,
                                std::string_view expected) {
  std::string found = fmt::format("it is {}", kind_of(node));
  if (node.IsScalar()) found = fmt::format("it is `{}`", node.Scalar());
  report(codes::wrong_type, node, fmt::format("{} must be {}, but {}", what, expected, found));
  return std::nullopt;
}

std::optional<std::string> YamlFile::text(const YAML::Node& node, std::string_view what) {
  if (!node.IsScalar()) return refuse(node, what, "a text");
  return node.Scalar();
}

std::optional<double> YamlFile::number(const YAML::Node& node, std::string_view what) {
  if (!node.IsScalar()) return refuse(node, what, "a number");
  const std::optional<double> value = parse_number<double>(node.Scalar());
  if (!value) return refuse(node, what, "a number");
  return value;
}

std::optional<std::uint64_t> YamlFile::natural(const YAML::Node& node, std::string_view what) {
  if (!node.IsScalar()) return refuse(node, what, "a whole number");
  const std::optional<std::uint64_t> value = parse_number<std::uint64_t>(node.Scalar());
  if (!value) return refuse(node, what, "a whole number, 0 or more");
  return value;
}

std::optional<bool> YamlFile::boolean(const YAML::Node& node, std::string_view what) {
  bool value = false;
  if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value)) {
    return refuse(node, what, "`true` or `false`");
  }
  return value;
}

std::optional<std::size_t> YamlFile::one_of(const YAML::Node& node, std::string_view what,
                                            std::initializer_list<std::string_view> words) {
  const std::optional<std::string> word = text(node, what);
  if (!word) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), *word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  report(codes::bad_value, node,
         fmt::format("{} must be {}, but it is `{}`", what, list_words(words), *word));
  return std::nullopt;
}

std::optional<std::vector<YAML::Node>> YamlFile::list_of_texts(const YAML::Node& node,
                                                               std::string_view what) {
  if (node.IsScalar()) return std::vector<YAML::Node>{node};
  if (!node.IsSequence()) return refuse(node, what, "a list");
  std::vector<YAML::Node> items;
  bool good = true;
  for (const YAML::Node& item : node) {
    if (item.IsScalar()) {
      items.push_back(item);
    } else {
      good = false;
      refuse(item, fmt::format("an entry of {}", what), "a text");
    }
  }
  if (!good) return std::nullopt;
  return items;
}

bool YamlFile::is_map(const YAML::Node& node, std::string_view what) {
  if (!node.IsMap()) refuse(node, what, "a map");
  return node.IsMap();
}

bool YamlFile::is_list(const YAML::Node& node, std::string_view what) {
  if (!node.IsSequence()) refuse(node, what, "a list");
  return node.IsSequence();
}

}  // namespace perentie::monitor

// Mapping: how the messages of a system become events of the model, as data.
//
// A mapping is a list of rules read from a YAML file; docs/mapping.md describes the format. A rule
// says which messages it is for (by topic, by the fields that they have) and which events such a
// message is: templates such as `radiation_level.{level}`, filled with fields of the message that
// may be converted on the way. The first rule that is for a message decides; a rule without events
// ignores it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "perentie/base/diagnostic.hpp"

namespace perentie::monitor {

/// The way to a field from the message's root: keys of objects and indices of arrays.
using FieldPath = std::vector<std::variant<std::string, std::uint32_t>>;

/// `pose.position[0].x` as a path; none if the text is not one.
std::optional<FieldPath> parse_field_path(std::string_view text);
std::string to_string(const FieldPath& path);

/// A half-open bucket of numbers: from `at_least` to the next threshold.
struct Threshold {
  double at_least;
  std::string text;
};

/// What happens with a value for which there is no answer.
struct Fallback {
  enum class Action : std::uint8_t {
    error,   ///< the trace ends here with a diagnostic
    ignore,  ///< the event is not made
    keep,    ///< the value stays as it is
    null,    ///< the value counts as null
    use,     ///< `text` is used
  };

  Action action = Action::error;
  std::string text;
};

/// A piece of an event's text that comes from the message.
struct MappedValue {
  std::string name;  ///< as templates call it
  FieldPath field;
  Fallback missing;                   ///< the message has no such field
  bool integer = false;               ///< numbers are cut to integers, towards zero
  std::vector<Threshold> thresholds;  ///< ascending; empty: none
  std::map<std::string, std::string, std::less<>> table;  ///< empty: none
  Fallback otherwise;      ///< no threshold or no entry of the table applies
  bool event_map = false;  ///< the result is renamed by the run's event map
};

/// A literal piece, or a value of the rule. Pieces of the same optional group (from 1; 0: none) are
/// left out together if a value of the group is null.
struct TemplatePart {
  std::string literal;
  std::optional<std::uint32_t> value;  ///< index into Rule::values
  std::uint32_t group = 0;
};
using EventTemplate = std::vector<TemplatePart>;

struct Rule {
  std::optional<std::string> topic;  ///< a pattern: `*` within a segment, `**` across segments
  std::vector<FieldPath> has;        ///< fields that the message must have
  std::vector<MappedValue> values;
  std::vector<EventTemplate> events;  ///< empty: such messages are ignored
};

struct Mapping {
  std::string name;
  FieldPath topic = {std::string("topic")};  ///< where a message says its topic
  bool leading_slash_optional = true;        ///< `/move` and `move` are the same topic
  bool ignore_unknown_topics = false;        ///< otherwise a topic without rule is an error
  std::vector<Rule> rules;
};

/// Reads a mapping from a file already in `sources`. None after diagnostics if it is not one.
std::optional<Mapping> parse_mapping(base::FileId file, const base::SourceMap& sources,
                                     base::Diagnostics& diagnostics);

/// The names of the mappings that come with the program, sorted.
std::span<const std::string_view> builtin_mapping_names();
/// The YAML text of one of them; none if there is no such mapping.
std::optional<std::string_view> builtin_mapping_text(std::string_view name);

/// A built-in mapping by its name, or the mapping in a file.
std::optional<Mapping> load_mapping(const std::string& name_or_path, base::SourceMap& sources,
                                    base::Diagnostics& diagnostics);

}  // namespace perentie::monitor

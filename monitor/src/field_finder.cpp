#include "field_finder.hpp"

#include <algorithm>
#include <cstring>

#include <simdjson.h>

#include "trace_input.hpp"

namespace perentie::monitor {
namespace {

namespace ondemand = simdjson::ondemand;

static_assert(TraceInput::padding >= simdjson::SIMDJSON_PADDING);

// A token as simdjson gives it ends where the next one begins.
Field without_blanks_behind(std::string_view token) {
  while (!token.empty() && static_cast<unsigned char>(token.back()) <= ' ') token.remove_suffix(1);
  return token;
}

}  // namespace

// One pass over one message.
struct FieldFinder::Pass {
  ondemand::parser parser;
  const std::vector<Node>* nodes = nullptr;
  Field* fields = nullptr;
  const char* end = nullptr;  // of the message
  bool has_escapes = false;

  simdjson::error_code run(std::string_view message) {
    end = message.data() + message.size();
    has_escapes = message.find('\\') != std::string_view::npos;
    ondemand::document document;
    SIMDJSON_TRY(
        parser.iterate(message.data(), message.size(), message.size() + TraceInput::padding)
            .get(document));
    ondemand::object object;
    SIMDJSON_TRY(document.get_object().get(object));
    SIMDJSON_TRY(read_object(object, nodes->front()));
    // The document must end with the object: where it does, there is no current location.
    return document.current_location().error() == simdjson::OUT_OF_BOUNDS ? simdjson::SUCCESS
                                                                          : simdjson::TAPE_ERROR;
  }

  // The depth of this recursion is that of the wanted paths, which is limited.
  simdjson::error_code read_object(ondemand::object& object, const Node& node) {
    for (auto entry : object) {
      ondemand::field field;
      SIMDJSON_TRY(std::move(entry).get(field));
      std::uint32_t child = 0;
      SIMDJSON_TRY(find_key(field, node, child));
      if (child != 0) SIMDJSON_TRY(read_value(field.value(), (*nodes)[child]));
    }
    return simdjson::SUCCESS;
  }

  // Sets `child` to the node that the field's key leads to, if there is one.
  simdjson::error_code find_key(ondemand::field& field, const Node& node, std::uint32_t& child) {
    const char* const key = field.key().raw();
    if (has_escapes) {
      std::string_view unescaped;
      SIMDJSON_TRY(field.unescaped_key().get(unescaped));
      for (const auto& [wanted, next] : node.keys) {
        if (unescaped == wanted) child = next;
      }
      return simdjson::SUCCESS;
    }
    const auto room = static_cast<std::size_t>(end - key);
    for (const auto& [wanted, next] : node.keys) {
      if (wanted.size() < room && key[0] == wanted[0] && key[wanted.size()] == '"' &&
          std::memcmp(key, wanted.data(), wanted.size()) == 0) {
        child = next;
      }
    }
    return simdjson::SUCCESS;
  }

  simdjson::error_code read_array(ondemand::array& array, const Node& node) {
    std::uint32_t index = 0;
    for (auto entry : array) {
      ondemand::value value;
      SIMDJSON_TRY(std::move(entry).get(value));
      for (const auto& [wanted, next] : node.indices) {
        if (wanted == index) SIMDJSON_TRY(read_value(value, (*nodes)[next]));
      }
      ++index;
    }
    return simdjson::SUCCESS;
  }

  simdjson::error_code read_value(ondemand::value& value, const Node& node) {
    const std::string_view token = value.raw_json_token();
    if (token[0] == '{') {
      ondemand::object object;
      SIMDJSON_TRY(value.get_object().get(object));
      SIMDJSON_TRY(keep_text(object, node));
      return node.keys.empty() ? simdjson::SUCCESS : read_object(object, node);
    }
    if (token[0] == '[') {
      ondemand::array array;
      SIMDJSON_TRY(value.get_array().get(array));
      SIMDJSON_TRY(keep_text(array, node));
      return node.indices.empty() ? simdjson::SUCCESS : read_array(array, node);
    }
    if (node.slot != no_slot) fields[node.slot] = without_blanks_behind(token);
    return simdjson::SUCCESS;
  }

  // Keeps the text of an object or array that is wanted as a whole, and returns to its beginning.
  template <class Container>
  simdjson::error_code keep_text(Container& container, const Node& node) {
    if (node.slot == no_slot) return simdjson::SUCCESS;
    SIMDJSON_TRY(container.raw_json().get(fields[node.slot]));
    return container.reset().error();
  }
};

FieldFinder::FieldFinder() : pass_(std::make_unique<Pass>()) {}
FieldFinder::~FieldFinder() = default;

FieldFinder::Slot FieldFinder::slot_for(const FieldPath& path) {
  std::uint32_t node = 0;
  for (const auto& step : path) node = child_of(node, step);
  if (nodes_[node].slot == no_slot) {
    nodes_[node].slot = static_cast<Slot>(fields_.size());
    fields_.emplace_back();
  }
  return nodes_[node].slot;
}

std::uint32_t FieldFinder::child_of(std::uint32_t node, const FieldPath::value_type& step) {
  const auto fresh = static_cast<std::uint32_t>(nodes_.size());
  const auto find_or_add = [fresh](auto& children, const auto& key) {
    for (const auto& [known, child] : children) {
      if (known == key) return child;
    }
    children.emplace_back(key, fresh);
    return fresh;
  };
  const auto* key = std::get_if<std::string>(&step);
  const std::uint32_t child =
      key != nullptr ? find_or_add(nodes_[node].keys, *key)
                     : find_or_add(nodes_[node].indices, std::get<std::uint32_t>(step));
  if (child == fresh) nodes_.emplace_back();
  return child;
}

bool FieldFinder::find(std::string_view message) {
  std::fill(fields_.begin(), fields_.end(), Field{});
  pass_->nodes = &nodes_;
  pass_->fields = fields_.data();
  return pass_->run(message) == simdjson::SUCCESS;
}

}  // namespace perentie::monitor

// Interner: text to a small id and back. Equal texts get equal ids, so names compare as integers.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "perentie/base/id.hpp"

namespace perentie::base {

using NameId = Id<struct NameTag>;

class Interner {
 public:
  NameId intern(std::string_view text) {
    if (const auto found = ids_.find(text); found != ids_.end()) return found->second;
    const NameId id{static_cast<std::uint32_t>(texts_.size())};
    const std::string& stored = texts_.emplace_back(text);
    ids_.emplace(stored, id);
    return id;
  }

  std::optional<NameId> find(std::string_view text) const {
    const auto found = ids_.find(text);
    if (found == ids_.end()) return std::nullopt;
    return found->second;
  }

  std::string_view operator[](NameId id) const { return texts_[id.value]; }
  std::size_t size() const { return texts_.size(); }

 private:
  std::deque<std::string> texts_;  // a deque: the map's keys are views into the strings
  std::unordered_map<std::string_view, NameId> ids_;
};

}  // namespace perentie::base

// Normal forms written down so that equal texts mean equal processes of a semantic model.
//
// Input: an LTS. Output: the size and hash of its normal form in the traces model or in the
// failures-divergences model, reduced by bisimulation and numbered by the names of its labels.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "perentie/lts/normalise.hpp"

namespace perentie::semantics {

// A normal form, reduced by bisimulation and written down in an order that depends on names alone,
// so that equal hashes mean equal processes of the model.
struct CanonicalForm {
  std::size_t nodes = 0;
  std::string hash;

  friend bool operator==(const CanonicalForm&, const CanonicalForm&) = default;
};

inline void PrintTo(const CanonicalForm& form, std::ostream* out) {
  *out << form.nodes << ' ' << form.hash;
}

class Canoniser {
 public:
  Canoniser(const lts::NormalLts& normal, bool with_failures)
      : normal_(normal), with_failures_(with_failures) {
    for (const std::string& name : normal.lts.label_names()) {
      std::string bare = name == lts::tick_name ? "tick" : name;
      std::erase(bare, ' ');
      names_.push_back(bare);
    }
    for (std::uint32_t s = 0; s < normal.lts.state_count(); ++s) marks_.push_back(mark(s));
  }

  CanonicalForm run() {
    partition();
    std::map<std::size_t, std::size_t> number{{block_[0], 0}};
    std::deque<std::uint32_t> queue{0};
    std::string text;
    while (!queue.empty()) {
      const std::uint32_t state = queue.front();
      queue.pop_front();
      text += "n" + marks_[state] + ";";
      for (const auto& [name, target] : successors(state)) {
        const auto [place, is_new] = number.emplace(block_[target], number.size());
        if (is_new) queue.push_back(target);
        text += fmt::format("{}>{};", name, place->second);
      }
    }
    std::uint64_t hash = 1469598103934665603U;  // FNV-1a with the basis of the recorded hashes
    for (const char c : text) {
      hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
    }
    return {number.size(), fmt::format("{:016x}", hash)};
  }

 private:
  using Successors = std::map<std::string, std::uint32_t>;  // by name

  std::string mark(std::uint32_t state) const {
    if (!with_failures_) return "";
    if (normal_.divergent[state]) return "D";
    std::set<std::vector<std::string>> acceptances;
    for (const lts::AcceptanceId id : normal_.acceptances->of(lts::State{state})) {
      std::vector<std::string> names;
      for (const lts::Label label : normal_.acceptances->labels(id)) {
        names.push_back(names_[label.value]);
      }
      std::sort(names.begin(), names.end());
      acceptances.insert(names);
    }
    std::string text;
    for (const auto& names : acceptances) {
      text += '{';
      for (const std::string& name : names) text += name + ",";
      text += '}';
    }
    return text;
  }

  // What a divergent process may do later is no part of its failures and divergences.
  Successors successors(std::uint32_t state) const {
    Successors result;
    if (with_failures_ && normal_.divergent[state]) return result;
    for (const lts::Edge& edge : normal_.lts.edges(lts::State{state})) {
      result.emplace(names_[edge.label.value], edge.target.value);
    }
    return result;
  }

  void partition() {
    std::map<std::string, std::size_t> by_mark;
    for (const std::string& mark : marks_) {
      block_.push_back(by_mark.emplace(mark, by_mark.size()).first->second);
    }
    for (std::size_t count = by_mark.size();;) {
      using Signature = std::pair<std::size_t, std::vector<std::pair<std::string, std::size_t>>>;
      std::map<Signature, std::size_t> by_signature;
      std::vector<std::size_t> refined;
      for (std::uint32_t s = 0; s < block_.size(); ++s) {
        Signature signature{block_[s], {}};
        for (const auto& [name, target] : successors(s)) {
          signature.second.emplace_back(name, block_[target]);
        }
        refined.push_back(
            by_signature.emplace(std::move(signature), by_signature.size()).first->second);
      }
      block_ = std::move(refined);
      if (by_signature.size() == count) return;
      count = by_signature.size();
    }
  }

  const lts::NormalLts& normal_;
  bool with_failures_;
  std::vector<std::string> names_;
  std::vector<std::string> marks_;  // by state
  std::vector<std::size_t> block_;  // by state
};

inline CanonicalForm trace_form(const lts::Lts& lts) {
  const auto normalisation = lts::normalise(lts);
  return Canoniser(normalisation.normal, false).run();
}

inline CanonicalForm failure_form(const lts::Lts& lts) {
  const auto normalisation = lts::normalise(lts, {.limits = {}, .acceptances = true});
  return Canoniser(normalisation.normal, true).run();
}

}  // namespace perentie::semantics

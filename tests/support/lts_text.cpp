#include "perentie/test/lts_text.hpp"

#include <algorithm>
#include <memory>
#include <ostream>
#include <set>
#include <sstream>

#include "perentie/base/check.hpp"

namespace perentie::test {

namespace {

std::vector<std::string> words_of(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::vector<std::vector<std::string>> statements_of(std::string_view text) {
  std::vector<std::vector<std::string>> statements;
  std::istringstream in{std::string(text)};
  for (std::string part; std::getline(in, part, ';');) {
    if (auto words = words_of(part); !words.empty()) statements.push_back(std::move(words));
  }
  return statements;
}

std::string canonical_name(const std::string& word) {
  if (word == "tau") return std::string(lts::tau_name);
  if (word == "tick") return std::string(lts::tick_name);
  return word;
}

lts::Label label_of(const lts::LabelNames& names, const std::string& word) {
  const auto found = std::find(names.begin(), names.end(), canonical_name(word));
  PERENTIE_CHECK(found != names.end(), "a test names a label that the LTS does not have");
  return lts::Label{static_cast<std::uint32_t>(found - names.begin())};
}

std::uint32_t number(const std::string& word) {
  return static_cast<std::uint32_t>(std::stoul(word));
}

}  // namespace

lts::Lts lts_from(std::string_view text, const std::vector<std::string>& alphabet) {
  auto statements = statements_of(text);
  std::uint32_t initial = 0;
  if (!statements.empty() && statements[0][0] == "->") {
    initial = number(statements[0].at(1));
    statements.erase(statements.begin());
  }

  lts::LabelNames names{std::string(lts::tau_name), std::string(lts::tick_name)};
  names.insert(names.end(), alphabet.begin(), alphabet.end());
  std::set<std::string> more;
  std::uint32_t last_state = initial;
  for (const auto& words : statements) {
    PERENTIE_CHECK(words.size() == 1 || words.size() == 3, "an edge in a test has three parts");
    last_state = std::max({last_state, number(words.front()), number(words.back())});
    if (words.size() == 3) more.insert(canonical_name(words[1]));
  }
  for (const std::string& name : more) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }

  const auto shared_names = std::make_shared<const lts::LabelNames>(std::move(names));
  lts::LtsBuilder builder(shared_names);
  builder.add_states(last_state + 1);
  for (const auto& words : statements) {
    if (words.size() != 3) continue;
    builder.add_edge(lts::State{number(words[0])}, label_of(*shared_names, words[1]),
                     lts::State{number(words[2])});
  }
  return std::move(builder).finish(lts::State{initial});
}

std::string to_text(const lts::Lts& lts) {
  std::string text;
  const auto add = [&](const std::string& statement) {
    if (!text.empty()) text += "; ";
    text += statement;
  };
  if (lts.initial() != lts::State{0}) add("-> " + std::to_string(lts.initial().value));
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    const auto edges = lts.edges(lts::State{s});
    if (edges.empty()) add(std::to_string(s));
    for (const lts::Edge& edge : edges) {
      add(std::to_string(s) + " " + std::string(lts.name(edge.label)) + " " +
          std::to_string(edge.target.value));
    }
  }
  return text;
}

std::string to_text(const lts::Lts& lts, const std::vector<lts::Label>& labels) {
  std::string text;
  for (const lts::Label label : labels) {
    if (!text.empty()) text += ' ';
    text += lts.name(label);
  }
  return text;
}

std::vector<lts::Label> labels_from(const lts::Lts& lts, std::string_view text) {
  std::vector<lts::Label> labels;
  for (const std::string& word : words_of(text))
    labels.push_back(label_of(lts.label_names(), word));
  return labels;
}

}  // namespace perentie::test

namespace perentie::lts {

void PrintTo(const Lts& lts, std::ostream* out) { *out << test::to_text(lts); }
void showValue(const Lts& lts, std::ostream& out) { out << test::to_text(lts); }

}  // namespace perentie::lts

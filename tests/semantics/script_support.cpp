#include "script_support.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <utility>

#include "perentie/semantics/process_graph.hpp"
#include "perentie/test/lts_text.hpp"

namespace perentie::semantics {

TestScript::TestScript(std::string text, const std::string& path) {
  const auto file = sources_.add(path, std::move(text));
  script_ = Script::load(*file, sources_, diagnostics_);
}

std::unique_ptr<TestScript> TestScript::of_file(const std::filesystem::path& path) {
  base::FileText file = base::read_file(path.generic_string());
  if (!file.text) ADD_FAILURE() << "cannot read " << path;
  return std::make_unique<TestScript>(std::move(file.text).value_or(""), path.generic_string());
}

std::optional<std::string> TestScript::evaluate(const std::string& expression) {
  return script_->evaluate(expression, diagnostics_, expression);
}

std::optional<std::string> TestScript::definitions(const std::string& process) {
  const std::optional<ProcId> term = script_->process(process, diagnostics_, process);
  if (!term) return std::nullopt;
  return script_->definitions(*term, diagnostics_);
}

std::optional<lts::Lts> TestScript::explore(const std::string& process,
                                            const base::Limits& limits) {
  script_->set_limits(limits);
  const std::optional<ProcId> term = script_->process(process, diagnostics_, process);
  if (!term) return std::nullopt;
  TermSystem system = script_->terms(*term, diagnostics_);
  auto exploration = lts::explore(system, {.limits = limits, .progress = {}});
  if (!exploration.complete() || diagnostics_.has_errors()) return std::nullopt;
  return std::move(exploration.lts);
}

bool TestScript::reaches_limit(const std::string& process, const base::Limits& limits) {
  const std::optional<ProcId> term = script_->process(process, diagnostics_, process);
  return term && explore_process(*script_, *term, {.limits = limits}, diagnostics_).limit;
}

std::string TestScript::codes() const {
  std::string text;
  for (const base::Diagnostic& d : diagnostics_.all()) {
    if (!text.empty()) text += ' ';
    text += d.code->id;
  }
  return text;
}

namespace {

// Extends a map of states edge by edge in breadth-first order, and takes steps back where it fails.
class Matcher {
 public:
  Matcher(const lts::Lts& left, const lts::Lts& right)
      : left_(left), right_(right), image_(left.state_count()), is_used_(right.state_count()) {}

  bool run() {
    if (left_.state_count() != right_.state_count()) return false;
    if (left_.edge_count() != right_.edge_count()) return false;
    if (!map(left_.initial(), right_.initial())) return false;
    return match(0, 0);
  }

 private:
  bool map(lts::State from, lts::State to) {
    if (is_used_[to.value] || left_.edges(from).size() != right_.edges(to).size()) return false;
    image_[from.value] = to;
    is_used_[to.value] = true;
    order_.push_back(from);
    return true;
  }

  void unmap(lts::State from) {
    is_used_[image_[from.value].value] = false;
    image_[from.value] = {};
    order_.pop_back();
  }

  // Matches the edges from the given one of the given state in order on.
  bool match(std::size_t state, std::size_t edge) {
    if (state == order_.size()) return true;
    const auto edges = left_.edges(order_[state]);
    if (edge == edges.size()) return match(state + 1, 0);
    const auto [label, target] = edges[edge];
    const auto known = right_.find_label(left_.name(label));
    if (!known) return false;
    for (const lts::Edge& other : right_.edges(image_[order_[state].value], *known)) {
      if (image_[target.value]) {
        if (image_[target.value] == other.target && match(state, edge + 1)) return true;
      } else if (map(target, other.target)) {
        const std::size_t size = order_.size();
        if (match(state, edge + 1)) return true;
        while (order_.size() > size) unmap(order_.back());
        unmap(target);
      }
    }
    return false;
  }

  const lts::Lts& left_;
  const lts::Lts& right_;
  std::vector<lts::State> image_;  // by state of the left
  std::vector<bool> is_used_;      // by state of the right
  std::vector<lts::State> order_;  // the mapped states in order
};

// The labels of expected texts have no spaces.
lts::Lts without_spaces(const lts::Lts& lts) {
  lts::LabelNames names = lts.label_names();
  for (std::string& name : names) std::erase(name, ' ');
  lts::LtsBuilder builder(std::make_shared<const lts::LabelNames>(std::move(names)));
  builder.add_states(static_cast<std::uint32_t>(lts.state_count()));
  for (std::uint32_t s = 0; s < lts.state_count(); ++s) {
    for (const lts::Edge& edge : lts.edges(lts::State{s})) {
      builder.add_edge(lts::State{s}, edge.label, edge.target);
    }
  }
  return std::move(builder).finish(lts.initial());
}

std::string with_channels(const std::string& definitions) {
  return "channel a, b, c, e\nchannel n : {0..1}\nchannel d : {0..1}.Bool\n" + definitions;
}

}  // namespace

bool isomorphic(const lts::Lts& left, const lts::Lts& right) { return Matcher(left, right).run(); }

::testing::AssertionResult has_lts(const std::string& process, const std::string& lts,
                                   const std::string& definitions) {
  TestScript script(with_channels(definitions));
  if (!script.loaded()) return ::testing::AssertionFailure() << script.messages();
  const auto found = script.explore(process);
  if (!found) return ::testing::AssertionFailure() << process << "\n" << script.messages();
  if (isomorphic(without_spaces(*found), test::lts_from(lts))) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << process << "\n  is       " << test::to_text(*found) << "\n  expected " << lts;
}

::testing::AssertionResult same_lts(const std::string& left, const std::string& right,
                                    const std::string& definitions) {
  TestScript script(with_channels(definitions));
  if (!script.loaded()) return ::testing::AssertionFailure() << script.messages();
  const auto a = script.explore(left);
  const auto b = script.explore(right);
  if (!a || !b) return ::testing::AssertionFailure() << script.messages();
  if (isomorphic(*a, *b)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << left << "\n  is " << test::to_text(*a) << "\n"
                                       << right << "\n  is " << test::to_text(*b);
}

std::string with_own_numbers(const std::string& text) {
  const std::regex internal(R"(\bi[0-9]+\b)");
  std::map<std::string, std::size_t> numbers;
  std::string result;
  auto at = text.begin();
  for (auto it = std::sregex_iterator(text.begin(), text.end(), internal);
       it != std::sregex_iterator(); ++it) {
    result.append(at, (*it)[0].first);
    const auto number = numbers.emplace(it->str(), numbers.size()).first->second;
    result.append("i").append(std::to_string(number));
    at = (*it)[0].second;
  }
  return result.append(at, text.end());
}

std::string codes_of_process(const std::string& process, const std::string& definitions) {
  TestScript script(with_channels(definitions));
  if (script.loaded()) script.explore(process);
  return script.codes();
}

std::string value_of(const std::string& expression, const std::string& definitions) {
  TestScript script(definitions);
  if (!script.loaded()) return script.messages();
  const auto value = script.evaluate(expression);
  return value ? *value : script.messages();
}

std::string codes_of_value(const std::string& expression, const std::string& definitions) {
  TestScript script(definitions);
  if (script.loaded()) script.evaluate(expression);
  return script.codes();
}

}  // namespace perentie::semantics

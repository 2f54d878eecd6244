// Models by others in ../shared/data: their normal forms, as an independent explorer on FDR's own
// front end found them, and the evaluator tests of that front end. Skipped where ../shared is
// absent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "perentie/lts/normalise.hpp"
#include "perentie/test/corpus.hpp"
#include "perentie/test/paths.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

namespace fs = std::filesystem;

// --- Normal forms -------------------------------------------------------------------------------

// A normal form, reduced by bisimulation and written down in an order that depends on names alone,
// so that equal hashes mean equal processes of the model.
struct CanonicalForm {
  std::size_t nodes = 0;
  std::string hash;

  friend bool operator==(const CanonicalForm&, const CanonicalForm&) = default;
};

void PrintTo(const CanonicalForm& form, std::ostream* out) {
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

// Larger processes are left to tools: all tests together are to take less than a minute.
constexpr std::size_t most_states = 1'500;

TEST(SharedModelsTest, NormalFormsAreThoseOfAnIndependentExplorer) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  std::ifstream table(data / "peer-normal-forms.tsv");
  ASSERT_TRUE(table);
  std::map<std::string, std::unique_ptr<TestScript>> scripts;
  std::size_t compared = 0;
  std::string line;
  std::getline(table, line);  // the heading
  while (std::getline(table, line)) {
    std::istringstream row(line);
    std::string file, process;
    std::size_t states = 0, transitions = 0;
    CanonicalForm traces, failures;
    std::getline(row, file, '\t');
    std::getline(row, process, '\t');
    row >> states >> transitions >> traces.nodes >> traces.hash >> failures.nodes >> failures.hash;
    ASSERT_TRUE(row) << line;
    if (states > most_states) continue;
    // It has an event `i`, which the recording took for the τ of .aut files.
    if (file == "varanus/evaluation/wcst_10.csp") continue;
    SCOPED_TRACE(file + " " + process);
    auto& script = scripts[file];
    if (!script) script = TestScript::of_file(data / file);
    ASSERT_TRUE(script->loaded()) << script->messages();
    const auto lts = script->explore(process, {.max_states = 20 * most_states});
    if (!lts) {
      ADD_FAILURE() << script->messages();
      continue;
    }
    const auto normalisation = lts::normalise(*lts, {.limits = {}, .acceptances = true});
    EXPECT_EQ(Canoniser(normalisation.normal, false).run(), traces);
    EXPECT_EQ(Canoniser(normalisation.normal, true).run(), failures);
    ++compared;
  }
  EXPECT_GE(compared, 100U);
}

// --- The evaluator tests of FDR's front end -----------------------------------------------------

// Files whose tests do not hold, and why. One that begins to hold is a failure here, too.
const std::map<std::string, std::string>& known_exceptions() {
  static const std::map<std::string, std::string> exceptions{};
  return exceptions;
}

// What is wrong with the tests of a script; empty: nothing.
std::string problems(const fs::path& path, std::size_t& count) {
  const auto script = TestScript::of_file(path);
  if (!script->loaded()) return script->messages();
  script->script().set_limits({.timeout = std::chrono::seconds(10)});
  const std::string text = base::read_file(path.generic_string()).text.value_or("");
  std::string found;
  const std::regex test(R"((^|\n)(test\w*)\s*=)");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), test); it != std::sregex_iterator();
       ++it, ++count) {
    const std::string name = (*it)[2];
    const auto value = script->evaluate(name);
    if (value != "true") found += name + " is " + value.value_or("nothing") + "\n";
  }
  const std::regex process(R"((^|\n)(procTest\w*)\s*=)");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), process);
       it != std::sregex_iterator(); ++it, ++count) {
    const std::string name = (*it)[2];
    if (!script->evaluate(name)) found += name + " has no value\n";
  }
  return found.empty() ? "" : found + script->messages();
}

TEST(SharedModelsTest, EvaluatesTheTestsOfTheFrontEnd) {
  PERENTIE_SHARED_DATA_OR_SKIP(data);
  std::size_t count = 0;
  for (const fs::path& file : test::scripts_in(data / "libcspm-tests/evaluator/should_pass")) {
    SCOPED_TRACE(file.filename().string());
    const std::string found = problems(file, count);
    const auto exception = known_exceptions().find(file.filename().string());
    if (exception == known_exceptions().end()) {
      EXPECT_EQ(found, "");
    } else {
      EXPECT_NE(found, "") << "is no exception any more: " << exception->second;
    }
  }
  EXPECT_GE(count, 100U);
}

}  // namespace
}  // namespace perentie::semantics

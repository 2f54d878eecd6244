#include "refines_output.hpp"

#include <cctype>

#include "run_perentie.hpp"

namespace perentie::test {
namespace {

Json parsed(const Outcome& outcome) {
  if (outcome.exit_code != 0) {
    throw std::runtime_error("refines ended with " + std::to_string(outcome.exit_code) + ": " +
                             outcome.errors);
  }
  return Json::parse(outcome.output);
}

::testing::AssertionResult differs(const std::string& what, const Json& ours, const Json& theirs) {
  return ::testing::AssertionFailure() << what << " is " << ours << " here, " << theirs << " there";
}

::testing::AssertionResult agree_on(const Json& ours, const Json& theirs, const char* key) {
  if (!theirs.contains(key)) return ::testing::AssertionSuccess();
  if (!ours.contains(key)) return ::testing::AssertionFailure() << key << " is missing here";
  return ours[key] == theirs[key] ? ::testing::AssertionSuccess()
                                  : differs(key, ours[key], theirs[key]);
}

// A shortest counterexample may be another one, but not another length.
::testing::AssertionResult behaviours_agree(const Json& ours, const Json& theirs) {
  if (const auto type = agree_on(ours, theirs, "type"); !type) return type;
  if (!theirs.contains("trace") || theirs.at("type") == "irrelevant") {
    return ::testing::AssertionSuccess();
  }
  if (theirs["type"] == "loop") return agree_on(ours, theirs, "loop_start");
  const std::size_t length = theirs["trace"].size();
  return ours.at("trace").size() == length ? ::testing::AssertionSuccess()
                                           : differs("the trace", ours["trace"], theirs["trace"]);
}

}  // namespace

Json our_document(const std::filesystem::path& script, std::size_t max_states,
                  const std::string& leaf_compression) {
  return parsed(
      perentie({"refines", script.string(), "--quiet", "--format", "json", "--divide",
                "--reveal-taus", "--timeout", "60", "--max-states", std::to_string(max_states),
                "--compiler-leaf-compression", leaf_compression}));
}

std::optional<std::string> fdr_program() {
  const Outcome found = run({"sh", "-c", "command -v refines"});
  if (found.exit_code != 0) return std::nullopt;
  const std::string program = found.output.substr(0, found.output.find('\n'));
  const Outcome version = run({program, "--version"});
  const bool is_ours = version.output.find("Perentie") != std::string::npos;
  return is_ours ? std::nullopt : std::optional(program);
}

Json fdr_document(const std::string& program, const std::filesystem::path& script) {
  return parsed(run({program, "--quiet", "--format", "json", "--divide", "--reveal-taus",
                     "--refinement-bfs-workers", "1", script.string()}));
}

std::vector<std::string> names_of(const Json& numbers, const Json& document) {
  std::vector<std::string> names;
  for (const Json& number : numbers) {
    const auto n = number.get<std::size_t>();
    names.push_back(n == 0 ? "" : document.at("event_map").at(std::to_string(n)));
  }
  return names;
}

::testing::AssertionResult agrees(const Json& ours, const Json& theirs) {
  if (!theirs.value("errors", Json::array()).empty()) {
    return ours.at("errors").empty()
               ? ::testing::AssertionFailure() << "an error there, none here: " << theirs["errors"]
               : ::testing::AssertionSuccess();
  }
  if (!ours.at("errors").empty()) {
    return ::testing::AssertionFailure() << "an error here, none there: " << ours["errors"];
  }
  for (const char* key :
       {"is_negated", "result", "visited_states", "visited_transitions", "visited_plys"}) {
    if (const auto same = agree_on(ours, theirs, key); !same) return same;
  }
  if (!theirs.contains("counterexamples")) return ::testing::AssertionSuccess();
  const Json& own = ours.at("counterexamples");
  const Json& others = theirs["counterexamples"];
  if (own.size() != others.size()) return differs("the number of counterexamples", own, others);
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (const auto same = agree_on(own[i], others[i], "type"); !same) return same;
    for (const char* key : {"specification_behaviour", "implementation_behaviour"}) {
      if (!others[i].contains(key)) continue;
      if (!own[i].contains(key)) return ::testing::AssertionFailure() << key << " is missing";
      if (auto same = behaviours_agree(own[i][key], others[i][key]); !same) {
        return same << " in the " << key;
      }
    }
  }
  return ::testing::AssertionSuccess();
}

std::string normal_text(const std::string& assertion) {
  std::string text;
  for (const char c : assertion) {
    const bool is_layout = std::isspace(static_cast<unsigned char>(c)) != 0 || c == '(' || c == ')';
    if (!is_layout) text += c;
  }
  return text;
}

}  // namespace perentie::test

// CheckRun: the assertions of a script, checked side by side and handed over in their order.
//
// Each worker has a script of its own, loaded from the same text, and keeps it from one assertion
// to the next, with the compressed processes that it has made. Which of several shortest
// counterexamples is found depends on the numbers of events, so these are given out beforehand. If
// that cannot be done, the assertions are dealt into groups with a script for each: these depend on
// the assertions alone, so the results are the same for any number of workers in both cases.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "model.hpp"
#include "perentie/semantics/check.hpp"
#include "perentie/semantics/explain.hpp"
#include "perentie/semantics/machine.hpp"

namespace perentie::cli {

struct CheckedAssertion {
  std::size_t number;  ///< from 1
  const semantics::ScriptAssertion* assertion;
  semantics::CheckResult result;
  std::optional<semantics::Explanation> explanation;  ///< if asked for and there is a witness
  base::Diagnostics diagnostics;                      ///< in the sources of the run
};

struct PrintedValue {
  const semantics::ScriptPrint* print;
  std::optional<std::string> value;
  std::optional<base::LimitReached> limit;  ///< the budget that ran out
  base::Diagnostics diagnostics;            ///< in the sources of the run
};

struct CheckOptions {
  base::Limits limits = {};  ///< of each assertion; workers share the memory
  std::size_t jobs = 1;      ///< workers
  bool explain = false;
  bool with_components = false;  ///< in explanations
  /// Of checks; no outcome depends on it, the number of states does (CSPM reference 6.5).
  semantics::LeafCompression leaf_compression = semantics::LeafCompression::sbisim;
  bool show_calls = false;  ///< errors come with the calls that led to them
  /// Told of the assertion that is handed over next; never called twice at the same time.
  std::function<void(const lts::ExploreProgress&)> progress;
};

class CheckRun {
 public:
  /// Loads a script; `-` is standard input. Null: the reasons are in `input`, which must outlive
  /// the run.
  static std::unique_ptr<CheckRun> load(const std::string& path, Input& input);

  const std::vector<semantics::ScriptAssertion>& assertions() const { return assertions_; }
  const std::vector<semantics::ScriptPrint>& prints() const { return prints_; }

  PrintedValue evaluate(const semantics::ScriptPrint& print, const base::Limits& limits);
  /// Checks the assertions of these numbers. `consume` is called in the order of the numbers, and
  /// says whether to go on.
  void check(std::span<const std::size_t> numbers, const CheckOptions& options,
             const std::function<bool(CheckedAssertion)>& consume);
  /// What `Script` says, of all scripts that were used.
  std::vector<std::string> compressions_given_up() const;

 private:
  struct Copy {
    Input input;
    std::unique_ptr<semantics::Script> script;
  };
  /// What a worker works with.
  struct Hand {
    std::unique_ptr<Copy> copy;  // none: `script` is that of the run
    semantics::Script* script =
        nullptr;  // none yet, or memory ran out, so it may know things by half
  };

  explicit CheckRun(Input& input) : input_(input) {}
  std::unique_ptr<Copy> copy() const;
  void take_script(Hand& hand, std::size_t part, const CheckOptions& options);
  void drop_script(Hand& hand);
  CheckedAssertion check_one(semantics::Script& script, std::size_t number,
                             const lts::ExploreOptions& exploration, const CheckOptions& options);
  CheckedAssertion without_memory(std::size_t number) const;

  Input& input_;
  base::FileId root_;
  std::map<std::string, base::FileText> files_;  // what includes were, by path
  std::unique_ptr<semantics::Script> script_;
  std::vector<semantics::ScriptAssertion> assertions_;
  std::vector<semantics::ScriptPrint> prints_;
  std::mutex compressions_mutex_;
  std::set<std::string> compressions_;
  bool has_numbered_events_ = false;  // then no result depends on what was checked before
  bool is_starved_ = false;           // memory ran out; what `script_` knows may be incomplete
};

/// The worst of the outcomes, as an exit code: an error, then a claim that fails, then none known.
ExitCode worse(ExitCode a, ExitCode b);
ExitCode worse(ExitCode code, semantics::CheckResult::Outcome outcome);

}  // namespace perentie::cli

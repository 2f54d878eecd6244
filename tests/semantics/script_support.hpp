// Scripts for tests: a text or file loaded, asked for values and LTSs, with its messages at hand.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/base/source.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::semantics {

class TestScript {
 public:
  explicit TestScript(std::string text, const std::string& path = "test.csp");
  static std::unique_ptr<TestScript> of_file(const std::filesystem::path& path);

  bool loaded() const { return script_ != nullptr; }
  Script& script() { return *script_; }

  /// The value of an expression as text; nothing, and a diagnostic, if it has none.
  std::optional<std::string> evaluate(const std::string& expression);
  /// A process with the definitions that it leads to, as `perentie eval -p` prints them; nothing,
  /// and a diagnostic, if it has no value.
  std::optional<std::string> definitions(const std::string& process);
  /// Everything that a process can reach; nothing, and a diagnostic or a limit, if it cannot be
  /// explored.
  std::optional<lts::Lts> explore(const std::string& process, const base::Limits& limits = {});

  /// Whether a limit ends the exploration of a process by the fastest machine.
  bool reaches_limit(const std::string& process, const base::Limits& limits);

  const base::Diagnostics& diagnostics() const { return diagnostics_; }
  std::string messages() const { return base::render_all(diagnostics_, sources_); }
  /// The codes of all diagnostics, in order.
  std::string codes() const;
  const base::SourceMap& sources() const { return sources_; }

 private:
  base::SourceMap sources_;
  base::Diagnostics diagnostics_;
  std::unique_ptr<Script> script_;
};

/// Whether two LTSs are equal but for the numbers of their states. For small graphs.
bool isomorphic(const lts::Lts& left, const lts::Lts& right);

/// Whether a process has the LTS of a text such as "0 a 1; 1" (see lts_text.hpp), up to the numbers
/// of states and with no spaces in the names of events. `definitions` are put into scope beside
/// `channel a, b, c, e`, `channel n : {0..1}` and `channel d : {0..1}.Bool`.
::testing::AssertionResult has_lts(const std::string& process, const std::string& lts,
                                   const std::string& definitions = "");
/// Whether two processes have the same LTS, up to the numbers of states.
::testing::AssertionResult same_lts(const std::string& left, const std::string& right,
                                    const std::string& definitions = "");
/// The text with internal names such as `P::i1564` numbered from 0 in order: their numbers depend
/// on all that a script defines.
std::string with_own_numbers(const std::string& text);
/// The codes with which a process of such a script is refused; empty if it is not.
std::string codes_of_process(const std::string& process, const std::string& definitions = "");
/// The value of an expression in a script of these definitions alone, or its messages.
std::string value_of(const std::string& expression, const std::string& definitions = "");
/// The codes with which an expression of such a script is refused; empty if it is not.
std::string codes_of_value(const std::string& expression, const std::string& definitions = "");

}  // namespace perentie::semantics

// What `perentie check` found, in the forms that it can be written in.
//
// Text is written assertion by assertion; the other forms are documents about the whole file: JSON
// of our own, and JUnit, SARIF 2.1.0 and Markdown for the tools that run checks automatically.
#pragma once

#include <string>
#include <vector>

#include "check_run.hpp"

namespace perentie::cli {

struct CheckReport {
  const base::SourceMap& sources;
  std::string file;
  base::Diagnostics load_errors = {};  ///< with errors if the script could not be loaded
  std::vector<PrintedValue> prints = {};
  std::vector<CheckedAssertion> assertions = {};
  bool explained = false;
};

std::string print_as_text(const PrintedValue& printed);
/// With the steps, the components and the command that repeats the check if it was explained.
std::string assertion_as_text(const CheckedAssertion& checked, const CheckReport& report);

std::string as_json(const CheckReport& report);
std::string as_junit(const CheckReport& report);
std::string as_sarif(const CheckReport& report);
std::string as_markdown(const CheckReport& report);

/// The command that checks this assertion again, and explains it.
std::string replay_command(const CheckedAssertion& checked, const CheckReport& report);

}  // namespace perentie::cli

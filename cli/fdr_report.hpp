// What `perentie refines` prints: FDR's text, and FDR's document about a file in JSON, YAML or XML
// (CSPM reference 7.2, 7.3).
//
// Events are numbered in a document from 3 on in the order in which they appear there; 0 says that
// a process is not involved, 1 is τ and 2 is ✓.
#pragma once

#include <string>
#include <vector>

#include "fdr_counterexample.hpp"

namespace perentie::cli {

struct FdrReport {
  const base::SourceMap& sources;
  std::string file;
  base::Diagnostics load_diagnostics = {};
  std::vector<CheckedAssertion> assertions = {};
  std::vector<PrintedValue> prints = {};
};

struct FdrLayout {
  bool divide = false;       ///< the behaviours of components, too
  bool reveal_taus = false;  ///< the trace with the events that were hidden
  bool brief = false;        ///< text: one line for each assertion
  bool quiet = false;        ///< text: no log
  bool colour = false;       ///< text
  bool counterexamples = true;
};

enum class FdrDocument { json, yaml, xml };

/// The document with its line end. JSON is on one line.
std::string fdr_document(const FdrReport& report, const FdrLayout& layout, FdrDocument form);

std::string fdr_text(const CheckedAssertion& checked, const FdrLayout& layout,
                     const base::SourceMap& sources);
std::string fdr_text(const PrintedValue& printed, const FdrLayout& layout,
                     const base::SourceMap& sources);

}  // namespace perentie::cli

#include "fdr_options.hpp"

#include <algorithm>
#include <cctype>
#include <regex>

#include <fmt/format.h>

namespace perentie::cli {
namespace {

constexpr const char* group = "Options of FDR";

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::optional<bool> truth(const std::string& text) {
  const std::string word = lower(text);
  if (word == "on" || word == "true" || word == "yes" || word == "1") return true;
  if (word == "off" || word == "false" || word == "no" || word == "0") return false;
  return std::nullopt;
}

// An option without effect here, whose value must be like `form`, in lower case.
struct Ignored {
  const char* name;
  const char* form;
  const char* values;  // for messages
};

constexpr const char* on_off = "on|off|true|false|yes|no|0|1";
constexpr const char* storage = R"(\d+(\.\d+)?(%|b|[kmgt]b?)?)";
constexpr const char* compressors = "default|defaulthigh|lz4|lz4hc|zip|none";

constexpr Ignored ignored[] = {
    {"compiler-check-for-immediate-recursions", on_off, "On or Off"},
    {"compiler-recursive-high-level", on_off, "On or Off"},
    {"compiler-reuse-machines", on_off, "On or Off"},
    {"cspm-evaluator-heap-size", R"(\d+[kmg]?)", "a number, with K, M or G"},
    {"cspm-profiling-active", on_off, "On or Off"},
    {"cspm-profiling-flatten-recursion", on_off, "On or Off"},
    {"gui-close-windows-on-load", on_off, "On or Off"},
    {"gui-console-history-length", R"(0*[1-9]\d*)", "a positive number"},
    {"refinement-cluster-homogeneous", on_off, "true or false"},
    {"refinement-explorer-storage-type", "default|btree|lsmtree", "Default, BTree or LSMTree"},
    {"refinement-storage-compressor", compressors, "Default, DefaultHigh, LZ4, LZ4HC or Zip"},
    {"refinement-storage-file-cache-size", storage, "a number with %, KB, MB, GB or TB"},
    {"refinement-storage-file-checksum", on_off, "On or Off"},
    {"refinement-storage-file-compressor", compressors, "None, LZ4, LZ4HC or Zip"},
    {"refinement-storage-file-path", ".*", "folders with commas between them"},
};

void add_truth(CLI::App& app, const char* name, bool& value, const char* meaning) {
  app.add_option_function<std::string>(
         std::string("--") + name,
         [&value](const std::string& text) { value = truth(text).value_or(true); }, meaning)
      ->check([](const std::string& text) {
        return truth(text) ? std::string() : fmt::format("`{}` is neither On nor Off", text);
      })
      ->type_name("On|Off")
      ->group(group);
}

}  // namespace

void add_fdr_options(CLI::App& app, FdrOptions& options) {
  const CLI::Range positive(std::size_t{1}, std::size_t{1'000'000});
  app.add_option("--refinement-bfs-workers", options.workers,
                 "How many threads check, several assertions side by side or one together")
      ->check(positive)
      ->type_name("N")
      ->group(group);
  app.add_option("--refinement-desired-counterexample-count", options.desired_counterexamples,
                 "Read, but one counterexample is reported")
      ->check(positive)
      ->type_name("N")
      ->group(group);
  add_truth(app, "refinement-track-history", options.track_history,
            "Off: no counterexamples are reported");
  add_truth(app, "cspm-runtime-range-checks", options.range_checks, "Read, but the checks stay on");
  add_truth(app, "cspm-evaluator-record-stack-traces", options.stack_traces,
            "On: errors come with the calls that led to them");
  app.add_option("--compiler-leaf-compression", options.leaf_compression,
                 "none, sbisim or wbisim: no verdict depends on it")
      ->transform(CLI::IsMember({"none", "sbisim", "wbisim"}, CLI::ignore_case))
      ->type_name("VALUE")
      ->group(group);
  for (const Ignored& option : ignored) {
    app.add_option(std::string("--") + option.name, "No effect: no verdict depends on it")
        ->expected(1)
        ->check([option](const std::string& text) {
          if (std::regex_match(lower(text), std::regex(option.form))) return std::string();
          return fmt::format("`{}` is not {}", text, option.values);
        })
        ->type_name("VALUE")
        ->group(group);
  }
}

}  // namespace perentie::cli

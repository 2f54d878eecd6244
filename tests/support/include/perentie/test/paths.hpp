// Where the tests find models and traces.
//
// Tests run in the project's root folder. `corpus()` is ours and always there. `shared_data()` lies
// beside a developer's checkout but not beside a user's clone: a test that reads it must skip
// there.
#pragma once

#include <filesystem>
#include <optional>

namespace perentie::test {

inline std::filesystem::path corpus() { return "corpus"; }

inline std::optional<std::filesystem::path> shared_data() {
  const std::filesystem::path path = "../shared/data";
  if (!std::filesystem::is_directory(path)) return std::nullopt;
  return path;
}

}  // namespace perentie::test

// Ends the test as skipped where ../shared is absent; otherwise defines `name` as its data folder.
#define PERENTIE_SHARED_DATA_OR_SKIP(name)                                         \
  const auto name##_found = ::perentie::test::shared_data();                       \
  if (!name##_found) GTEST_SKIP() << "../shared/data is not beside this checkout"; \
  const std::filesystem::path& name = *name##_found

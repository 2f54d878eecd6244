// What `refines` says about a script, ours and FDR's, and how the two compare.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace perentie::test {

using Json = nlohmann::json;

/// Our document about a script, with components and hidden events. Limits of states keep random
/// scripts small: their assertions then have `errors`.
Json our_document(const std::filesystem::path& script, std::size_t max_states = 100'000,
                  const std::string& leaf_compression = "sbisim");

/// The program `refines` on the PATH, if it is not ours.
std::optional<std::string> fdr_program();
Json fdr_document(const std::string& program, const std::filesystem::path& script);

/// The events of a list of numbers; an empty word is a process that is not involved.
std::vector<std::string> names_of(const Json& numbers, const Json& document);

/// Whether ours agrees with what `theirs` has of the same assertion: verdict, counts, how many
/// counterexamples, and of each its type, its length and how its behaviours end. Keys that `theirs`
/// lacks are not compared.
::testing::AssertionResult agrees(const Json& ours, const Json& theirs);

/// An assertion's text without what depends on the printer: blanks and brackets.
std::string normal_text(const std::string& assertion);

}  // namespace perentie::test

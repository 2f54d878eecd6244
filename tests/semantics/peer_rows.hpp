// The processes of ../shared/data/peer-normal-forms.tsv: models of others, with the normal forms
// that an independent explorer found.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "canonical_form.hpp"
#include "script_support.hpp"

namespace perentie::semantics {

struct PeerRow {
  std::string file;
  std::string process;
  std::size_t states;
  std::size_t transitions;
  CanonicalForm traces;
  CanonicalForm failures;
};

/// Calls `use` with each row and its script, which is loaded once for all its rows. Fails the test
/// where a row cannot be read or a script not be loaded.
void for_each_peer(const std::filesystem::path& data,
                   const std::function<void(const PeerRow&, TestScript&)>& use);

}  // namespace perentie::semantics

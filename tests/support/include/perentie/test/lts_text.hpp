// Small LTSs as readable text: "0 a 1; 1 tau 0; 1 ✓ 2".
//
// One edge is `source label target`; a state number alone declares a state without edges. State 0
// is the initial state unless the text begins with `-> N;`. τ may be written `tau`, ✓ `tick`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "perentie/lts/lts.hpp"

namespace perentie::test {

/// The events of a text become labels in alphabetical order, after those of `alphabet` in its
/// order. A text that is not of the form above aborts the test program.
lts::Lts lts_from(std::string_view text, const std::vector<std::string>& alphabet = {});

/// The edges in order, states without edges as lone numbers: equal texts mean equal graphs.
std::string to_text(const lts::Lts& lts);

/// Label names separated by blanks, such as "a τ b".
std::string to_text(const lts::Lts& lts, const std::vector<lts::Label>& labels);

/// The labels of a text of the same form; τ and ✓ as above.
std::vector<lts::Label> labels_from(const lts::Lts& lts, std::string_view text);

}  // namespace perentie::test

namespace perentie::lts {

/// How GoogleTest and rapidcheck print an Lts.
void PrintTo(const Lts& lts, std::ostream* out);
void showValue(const Lts& lts, std::ostream& out);

}  // namespace perentie::lts

// Counterexamples replayed by the step rules: the implementation can do what they say, the
// specification cannot.
#pragma once

#include <gtest/gtest.h>

#include "perentie/semantics/assertions.hpp"
#include "perentie/semantics/script.hpp"
#include "refines_output.hpp"

namespace perentie::test {

/// Replays the counterexamples of one result of a document.
::testing::AssertionResult replays(semantics::Script& script,
                                   const semantics::ScriptAssertion& assertion, const Json& result,
                                   const Json& document);

}  // namespace perentie::test

// Random CSPM scripts for comparisons with FDR.
//
// A script has a few recursive sequential processes, every operator above them, and assertions. Its
// processes are finite and mostly small. It shrinks to a script that is still one: an operator is
// replaced by an operand or STOP, an assertion is dropped.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include <rapidcheck.h>

namespace perentie::test {

/// An operator with its operands: `%` in the shape stands for the next operand.
struct GenTerm {
  std::string shape;
  std::vector<GenTerm> operands = {};
};

struct GenScript {
  std::vector<GenTerm> definitions;  ///< of P0, P1, ..: recursion goes through events
  std::vector<GenTerm> assertions;
};

/// The script, with the definitions that its assertions lead to.
std::string to_text(const GenScript& script);
void showValue(const GenScript& script, std::ostream& out);

rc::Gen<GenScript> gen_script();
/// Simpler scripts, one step each.
std::vector<GenScript> simpler(const GenScript& script);

}  // namespace perentie::test

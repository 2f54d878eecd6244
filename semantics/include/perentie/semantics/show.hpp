// Values, events and process terms as text, in the notation of FDR (CSPM reference 3.10.5, 3.8.2).
#pragma once

#include <cstddef>
#include <string>

#include "perentie/semantics/event.hpp"
#include "perentie/semantics/process.hpp"
#include "perentie/semantics/symbols.hpp"
#include "perentie/semantics/value.hpp"

namespace perentie::semantics {

/// How functions and processes inside values are named: the evaluator knows their definitions.
class FunctionNames {
 public:
  virtual ~FunctionNames() = default;
  /// Such as `P(1)::f` for a function defined inside P(1), `(\x @ ..)` for a lambda.
  virtual std::string function_name(ValueId function) const = 0;
  /// Whether a call is written with parentheses, if only `f()`.
  virtual bool takes_arguments(ValueId function) const = 0;
};

struct ShowContext {
  const ValueStore& values;
  const EventTable& events;
  const ProcStore& processes;
  const Resolution& resolution;
  const FunctionNames& names;
};

/// What `show` prints: `c.1.true`, `{1, 2}`, `<'a'>`, `"text"`, `(| 1 => 2 |)`.
std::string show_value(const ShowContext& context, ValueId value);

/// A process term down to named calls. Longer texts than `max_length` are cut and end in `...`.
std::string show_process(const ShowContext& context, ProcId process,
                         std::size_t max_length = 10'000);

/// A process term, and `name = body`, whole and broken into lines as FDR's printer does.
std::string lay_out_process(const ShowContext& context, ProcId process);
std::string lay_out_definition(const ShowContext& context, ProcId name, ProcId body);

}  // namespace perentie::semantics

// The built-in functions on evaluated values (CSPM reference 3.10).
#pragma once

#include <span>

#include "../maps.hpp"
#include "data_model.hpp"
#include "perentie/semantics/show.hpp"

namespace perentie::semantics {

struct ValueBuiltins {
  ValueStore& values;
  const Resolution& resolution;
  const DataModel& data;
  ShowContext show;

  /// Applies a function of the table, or gives a constant. Throws EvaluationFailure or NeedFields.
  ValueId apply(Builtin builtin, std::span<const ValueId> arguments) const;

 private:
  ValueId require_set(ValueId value, std::string_view function) const;
  ValueId require_seq(ValueId value, std::string_view function) const;
  ValueId require_map(ValueId value, std::string_view function) const;
  MapEntry require_pair(ValueId value, std::string_view function) const;
  ValueId all_events() const;
  ValueId symmetric_closure(ValueId relation, ValueId elements) const;
};

}  // namespace perentie::semantics

#include "perentie/semantics/process_system.hpp"

#include <fmt/format.h>

#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {

void report_growth(const Script& script, const std::optional<base::LimitReached>& limit,
                   base::Diagnostics& diagnostics) {
  if (!limit || limit->kind == base::LimitKind::depth) return;
  const auto definition = script.most_called();
  if (!definition) return;
  diagnostics.report(codes::growing_arguments, definition->span,
                     fmt::format("`{}` is called with ever other arguments: if they grow without "
                                 "end, so does the process",
                                 definition->name));
}

}  // namespace perentie::semantics

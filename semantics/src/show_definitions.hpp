// A process with the definitions that it refers to, as libcspm prints them.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "perentie/semantics/show.hpp"

namespace perentie::semantics {

/// `name = body` for each named call that the process leads to, what is used before what uses it,
/// with empty lines in between; at the end the process itself. Nothing if `unfold` fails, which
/// gives the body of a call.
std::optional<std::string> show_definitions(
    const ShowContext& context, ProcId process,
    const std::function<std::optional<ProcId>(ProcId call)>& unfold);

}  // namespace perentie::semantics

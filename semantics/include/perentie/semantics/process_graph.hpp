// A process as a graph or its size, whatever transition system computes it (`process_system.hpp`).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/semantics/machine.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::semantics {

/// The size of a process, whatever system it came from. States of a generalised LTS are counted as
/// such, without the stable states that they may be.
struct ProcessSize {
  std::uint64_t states = 0;
  std::uint64_t transitions = 0;  ///< as the system made them, repeated ones included
  MachineStructure structure = {};
  bool failed = false;  ///< some transitions could not be computed; the reason was reported
  std::optional<base::LimitReached> limit = {};
};

/// `lts::count` on the fastest system.
ProcessSize count_process(Script& script, ProcId process, const lts::ExploreOptions& options,
                          base::Diagnostics& diagnostics);

/// A process as a graph, whatever system it came from. What states of a generalised LTS may refuse
/// is told by stable states behind τ.
struct ProcessExploration {
  lts::Lts lts;
  std::function<ProcId(lts::State)> term;  ///< of a state; needs the script
  MachineStructure structure;
  bool complete = false;
  bool failed = false;  ///< some transitions could not be computed; the reason was reported
  std::optional<base::LimitReached> limit = {};
};

/// `lts::explore` on the fastest system.
ProcessExploration explore_process(Script& script, ProcId process,
                                   const lts::ExploreOptions& options,
                                   base::Diagnostics& diagnostics);

}  // namespace perentie::semantics

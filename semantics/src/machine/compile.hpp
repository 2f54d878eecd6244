// compile: a process term to a machine, where the machine is worth it and certainly right.
//
// The static operators on top of the settled term become rules (rules.hpp); the operands below them
// become leaves, explored by the step rules, equal ones once. A leaf that fails or does not end is
// no error: in the whole process it may never come so far, so the step rules are to decide.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "perentie/semantics/machine.hpp"
#include "perentie/semantics/process.hpp"
#include "perentie/semantics/step.hpp"

namespace perentie::semantics {

struct MachineParts {
  CallUnfolder& calls;
  const EventTable& events;
  ProcStore& processes;
  CompressionRules compressions;
  /// Asked for when all leaves are explored.
  std::function<std::shared_ptr<const lts::LabelNames>()> label_names;
  /// What values and terms hold.
  std::function<std::size_t()> memory_bytes;
};

MachineCompilation compile_machine(ProcId process, const MachineParts& parts,
                                   const MachineOptions& options);

/// The packed state of a term; nothing: it is none of the machine, or has terminated.
std::optional<std::vector<std::uint64_t>> machine_state(const CompiledMachine& machine, ProcId term,
                                                        const ProcStore& processes);
/// The term that a packed state stands for; with compressed leaves one of several.
ProcId machine_term(const CompiledMachine& machine, std::span<const std::uint64_t> state,
                    ProcStore& processes);

}  // namespace perentie::semantics

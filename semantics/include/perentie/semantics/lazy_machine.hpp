// LazyMachine: a process as a machine whose formats and leaves are made when they are met.
//
// A state is a format, the operators around the leaves, and one term for each leaf; or a leaf
// alone. Whatever switches formats (`;`, `[]`, `/\`, `[>`, exceptions, recursion through names)
// leads to another format (CSPM reference 6.1). Leaves are computed once, by the step rules, and
// only as far as the whole process goes. States, transitions, their order and their repetitions are
// those of the step rules.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/hash.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/lts/transition_system.hpp"
#include "perentie/semantics/machine.hpp"
#include "perentie/semantics/process.hpp"

namespace perentie::semantics {

struct MachineParts;

/// A `lts::TransitionSystem`. Made by `Script::lazy_machine`; the script must outlive it.
class LazyMachine {
 public:
  /// The number of a leaf term or of a composite state: see the last bit.
  using State = std::uint32_t;

  LazyMachine(ProcId process, const MachineParts& parts, base::Diagnostics& diagnostics);
  ~LazyMachine();
  LazyMachine(LazyMachine&&) noexcept;

  /// Fails like `successors`: then the process itself is the only state.
  State initial() const { return initial_; }
  bool successors(State state, std::vector<lts::Transition<State>>& out);
  std::uint64_t state_hash(State state) const { return base::hash_mix(0, state); }
  std::shared_ptr<const lts::LabelNames> label_names() const;
  std::size_t memory_bytes() const;

  /// The term that a state stands for.
  ProcId term(State state) const;
  /// Which budget ended `successors`, if one did.
  std::optional<base::LimitReached> limit() const;
  /// What was met so far.
  MachineStructure structure() const;

 private:
  struct Impl;

  std::unique_ptr<Impl> impl_;
  State initial_;
};

}  // namespace perentie::semantics

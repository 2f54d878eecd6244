// The operational semantics of process terms, rule by rule (CSPM reference 4.1-4.5).
//
// These rules are the reference for everything faster: a term's transitions are computed from those
// of its operands, and a named call is unfolded to its body. ✓ is treated as FDR treats it: an
// ordinary label that every parallel operator synchronises, after which nothing happens
// (4.1.2, 4.1.3). A compressed process has the transitions of its compressed graph, or those of the
// process itself where the compression cannot be applied; a graph operator such as `deter` has
// those of its graph or none (`compression.hpp`).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/lts/transition_system.hpp"
#include "perentie/semantics/compression.hpp"
#include "perentie/semantics/process.hpp"

namespace perentie::semantics {

/// Gives the body of a named call: the evaluator, seen from the step rules.
class CallUnfolder {
 public:
  virtual ~CallUnfolder() = default;
  /// Nothing: evaluation failed and was reported, or a budget ran out (`limit()`).
  virtual std::optional<ProcId> unfold(ProcId call, base::Diagnostics& diagnostics) = 0;
  virtual std::optional<base::LimitReached> limit() const = 0;
  /// What to call the call in messages, and where its definition is.
  virtual std::string call_name(ProcId call) const = 0;
  virtual base::Span definition_span(ProcId call) const = 0;
  /// Where the script asked for a term of a built-in, if that is known.
  virtual std::optional<base::Span> origin(ProcId term) const = 0;
};

/// How the step rules take compressions.
struct CompressionRules {
  ProcessCompressor& compressor;
  Preserved preserved;  ///< outside of `prioritise`
};

class StepRules {
 public:
  using Step = lts::Transition<ProcId>;
  using Steps = std::vector<Step>;

  StepRules(CallUnfolder& calls, const EventTable& events, ProcStore& processes,
            CompressionRules compressions, base::Diagnostics& diagnostics)
      : calls_(calls),
        events_(events),
        processes_(processes),
        compressions_(compressions),
        diagnostics_(diagnostics) {}

  /// The state that a term is: names that only stand for other names or for operators that stay in
  /// place (parallels, hiding, renaming, ..) are no states of their own (6.2.2). Nothing on
  /// failure.
  std::optional<ProcId> state(ProcId process);
  /// Appends the transitions of a term, with targets that are states. False: they cannot be
  /// computed; the reason was reported, or `limit()` says which budget ran out.
  bool successors(ProcId process, Steps& out);
  /// The same with the targets that the rules give, before names are followed.
  bool unsettled_successors(ProcId process, Steps& out);
  /// The term of `left ; right` as the target of a step: `right` if `left` can only terminate.
  std::optional<ProcId> sequential_target(ProcId left, ProcId right);
  std::optional<base::LimitReached> limit() const { return limit_; }

  /// Whether the terms that come next stand below `prioritise`, which can tell more processes
  /// apart.
  void set_below_priority(bool below) { below_priority_ = below; }
  /// Whether a compression is its graph there, or a budget ran out; otherwise it is the identity.
  bool is_applied(ProcId compression, bool below_priority);

 private:
  std::optional<ProcId> settle(ProcId process);
  std::optional<ProcId> settle_operands(ProcId process);
  std::optional<ProcId> unfold(ProcId call);
  bool step(ProcId process, Steps& out);
  void remember_steps(ProcId process, std::span<const Step> steps);
  bool step_term(ProcId process, Steps& out);
  bool step_call(ProcId process, Steps& out);
  bool external_choice(ProcId process, Steps& out);
  bool sequential(ProcId process, Steps& out);
  bool interrupt(ProcId process, Steps& out);
  bool sliding_choice(ProcId process, Steps& out);
  bool parallel(ProcId process, Steps& out);
  bool link_parallel(ProcId process, Steps& out);
  bool exception(ProcId process, Steps& out);
  bool sync_choice(ProcId process, Steps& out);
  bool sync_interrupt(ProcId process, Steps& out);
  bool hide_or_project(ProcId process, Steps& out);
  bool rename(ProcId process, Steps& out);
  bool prioritise(ProcId process, Steps& out);
  bool prioritise_partial(ProcId process, Steps& out);
  bool compression(ProcId process, Steps& out);
  bool graph_operator(ProcId process, Steps& out);
  bool compressed_state(ProcId process, Steps& out);
  void push(const CompressedProcess& graph, std::uint32_t state, Steps& out);
  Preserved preserved(bool below_priority) const;
  bool step_below_priority(ProcId process, Steps& out);
  bool chase(ProcId process, Steps& out);
  bool refuse_opaque(ProcId process);
  void report(const base::DiagnosticCode& code, ProcId term, std::string message);
  void chaos(ProcId process, Steps& out);

  std::optional<bool> only_terminates(ProcId process);
  ProcId with_operand(ProcId process, std::size_t word, ProcId operand);
  ProcId after(ProcId process, std::size_t word, const Step& step);
  void synchronised(ProcId process, std::span<const std::size_t> places,
                    std::span<const Steps> steps, EventId event, Steps& out);

  CallUnfolder& calls_;
  const EventTable& events_;
  ProcStore& processes_;
  CompressionRules compressions_;
  base::Diagnostics& diagnostics_;
  bool below_priority_ = false;
  std::uint32_t depth_ = 0;
  std::unordered_set<std::uint32_t> unfolding_;        // calls that are being stepped
  std::unordered_map<std::uint32_t, ProcId> settled_;  // by process
  // What operands of earlier states did, as most states differ from another in one operand. All
  // maps of steps are bounded and emptied when they are full.
  struct StepRun {
    std::uint32_t first;
    std::uint32_t count;
  };
  struct Memory {
    std::unordered_map<std::uint32_t, StepRun> steps;         // by operand, of pool
    std::unordered_map<std::uint32_t, bool> only_terminates;  // by process
    Steps pool;
  };
  Memory memory_[2];                                            // the second below `prioritise`
  std::unordered_map<std::uint32_t, ProcId> settled_operands_;  // by process
  std::optional<base::LimitReached> limit_;
};

}  // namespace perentie::semantics

// What the step rules need of compressions: `normal(P)` as the graph that `normal` makes of P.
//
// A compressed process is explored and compressed as a whole when its first transitions are asked
// for; from then on it is that graph. Its states are terms of their own (`compressed_state`). The
// operators `deter` and the watchdogs are graphs, too. But they have a meaning of their own: they
// are never the identity, and the same graph everywhere.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "perentie/base/diagnostic.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/lts/lts.hpp"
#include "perentie/semantics/builtins.hpp"
#include "perentie/semantics/process.hpp"

namespace perentie::semantics {

/// What the compressions of a process must preserve where it stands. Each keeps more than the one
/// before.
enum class Preserved : std::uint8_t {
  failures_divergences,  ///< traces, failures and divergences
  priority,              ///< what `prioritise` can tell: only bisimulations may be applied (4.5.7)
  bisimilarity,          ///< what any model of this program can tell: only `sbisim`
  identity,              ///< nothing is applied
};

/// Whether a compression preserves that. False of built-ins that compress nothing.
bool preserves(Builtin compression, Preserved preserved);

struct CompressedProcess {
  lts::Lts lts;
  std::vector<ProcId> states;  ///< their terms; of the initial one the compression itself
  /// Whether it was made of a generalised LTS, so that τ may only choose acceptances.
  bool is_generalised = false;
};

/// Makes graphs of terms of kind `compression` and `graph_operator`. They stay where they are.
class ProcessCompressor {
 public:
  virtual ~ProcessCompressor() = default;
  /// Nothing: the compression is to be taken as the identity, because it does not preserve what it
  /// must, it has no meaning of its own, or its process is too large or cannot be explored. Or a
  /// budget ran out (`limit()`).
  virtual const CompressedProcess* compressed(ProcId term, Preserved preserved) = 0;
  /// The graph of a graph operator. Nothing: the operand cannot be explored, and it was reported
  /// why, or a budget ran out (`limit()`).
  virtual const CompressedProcess* applied(ProcId term, base::Diagnostics& diagnostics) = 0;
  /// Whether the operand of a graph operator is being explored: it leads to its own graph, so there
  /// is none.
  virtual bool is_being_applied(ProcId term) const = 0;
  virtual std::optional<base::LimitReached> limit() const = 0;
};

}  // namespace perentie::semantics

// Compressor: the compressions and graph operators of a script, applied once each.
//
// The process is explored like any other, by a machine, and the graph is compressed by the function
// of `lts/` that has the name of the built-in. Generalised results are made plain (CSPM reference
// 4.7), so that everything else goes on with ordinary transitions. The operands of graph operators
// are explored with all their own compressions, wherever the operator stands, so that each is one
// process.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>

#include "perentie/semantics/compression.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::semantics {

class Compressor : public ProcessCompressor {
 public:
  /// Keeps references.
  Compressor(Script& script, const EventTable& events, ProcStore& processes)
      : script_(script), events_(events), processes_(processes) {}

  void set_limits(const base::Limits& limits);
  const CompressedProcess* compressed(ProcId term, Preserved preserved) override;
  const CompressedProcess* applied(ProcId term, base::Diagnostics& diagnostics) override;
  bool is_being_applied(ProcId term) const override;
  std::optional<base::LimitReached> limit() const override { return limit_; }
  /// The built-ins that were taken as the identity because their processes are too large.
  const std::set<Builtin>& given_up() const { return given_up_; }

 private:
  using Key = std::pair<std::uint32_t, Preserved>;  // of a term

  std::optional<CompressedProcess> compress(ProcId term, Preserved preserved);
  std::optional<CompressedProcess> apply(ProcId term, base::Diagnostics& diagnostics);
  CompressedProcess with_terms(lts::Lts lts, ProcId term, Preserved preserved);

  Script& script_;
  const EventTable& events_;
  ProcStore& processes_;
  base::Budget budget_{base::Limits{}};
  struct Known {
    bool is_in_work = true;
    std::optional<CompressedProcess> process;  // nothing: the identity
  };
  std::map<Key, Known> known_;
  struct Applied {
    bool is_in_work = true;
    std::optional<CompressedProcess> process;
    std::optional<base::LimitReached> limit;  // why not, until there are other limits
  };
  std::map<std::uint32_t, Applied> applied_;  // by term
  std::set<Builtin> given_up_;
  std::optional<base::LimitReached> limit_;
  std::uint32_t nesting_ = 0;
  std::uint64_t states_in_vain_ = 0;  // explored since limits were set
};

}  // namespace perentie::semantics

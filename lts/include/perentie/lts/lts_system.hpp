// An explicit Lts as a `TransitionSystem`, so that what runs on the fly also runs on finished
// graphs.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "perentie/base/hash.hpp"
#include "perentie/lts/transition_system.hpp"

namespace perentie::lts {

/// Keeps a reference: the Lts must outlive it.
class LtsSystem {
 public:
  using State = lts::State;

  explicit LtsSystem(const Lts& lts) : lts_(&lts) {}

  State initial() const { return lts_->initial(); }
  bool successors(State state, std::vector<Transition<State>>& out) const {
    for (const Edge& edge : lts_->edges(state)) out.push_back({edge.label, edge.target});
    return true;
  }
  std::uint64_t state_hash(State state) const { return base::hash_mix(0, state.value); }
  std::shared_ptr<const LabelNames> label_names() const { return lts_->shared_label_names(); }

 private:
  const Lts* lts_;
};

}  // namespace perentie::lts

// What τ leads to from a set of states, set after set, without a table to clear for each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "perentie/lts/lts.hpp"

namespace perentie::lts {

class TauClosure {
 public:
  /// Keeps a reference: the Lts must outlive it.
  explicit TauClosure(const Lts& lts) : lts_(lts), put_in_(lts.state_count(), 0) {}

  /// Appends to a set, which has each state once, the others that τ leads to from them.
  void close(std::vector<State>& set) {
    if (++closures_ == 0) {  // after 2^32 closures the numbers begin again
      std::ranges::fill(put_in_, 0);
      closures_ = 1;
    }
    for (const State state : set) put_in_[state.value] = closures_;
    for (std::size_t i = 0; i < set.size(); ++i) {
      for (const Edge& edge : lts_.edges(set[i])) {
        if (edge.label != tau) break;
        if (put_in_[edge.target.value] == closures_) continue;
        put_in_[edge.target.value] = closures_;
        set.push_back(edge.target);
      }
    }
  }

  /// Whether a state is in the set that was closed last.
  bool has(State state) const { return put_in_[state.value] == closures_; }

 private:
  const Lts& lts_;
  std::vector<std::uint32_t> put_in_;  // by state: the number of the last closure that it is in
  std::uint32_t closures_ = 0;
};

}  // namespace perentie::lts

#include "perentie/lts/acceptances.hpp"

#include <algorithm>

namespace perentie::lts {

namespace {

/// Keeps those elements of `ids` whose set includes no other's.
void keep_minimal(std::vector<AcceptanceId>& ids, const UniqueRuns<AcceptanceId, Label>& sets) {
  std::ranges::stable_sort(ids, {}, [&](AcceptanceId id) { return sets[id].size(); });
  auto kept_end = ids.begin();
  for (const AcceptanceId id : ids) {
    const bool includes_another = std::any_of(ids.begin(), kept_end, [&](AcceptanceId smaller) {
      return std::ranges::includes(sets[id], sets[smaller]);
    });
    if (!includes_another) *kept_end++ = id;
  }
  ids.erase(kept_end, ids.end());
}

}  // namespace

AcceptanceId AcceptanceBuilder::acceptance(State stable) {
  AcceptanceId& id = initials_[stable.value];
  if (id.is_none()) id = sets_.add(labels_on(lts_.edges(stable)));
  return id;
}

void AcceptanceBuilder::add(std::span<const State> states) {
  found_.clear();
  for (const State state : states) {
    if (lts_.is_stable(state)) found_.push_back(acceptance(state));
  }
  add_found();
}

void AcceptanceBuilder::add(State state, std::span<const State> before) {
  found_.clear();
  if (lts_.is_stable(state)) found_.push_back(acceptance(state));
  for (const State set : before) {
    const auto of_set = minimal_[set.value];
    found_.insert(found_.end(), of_set.begin(), of_set.end());
  }
  add_found();
}

void AcceptanceBuilder::add_found() {
  std::ranges::sort(found_);
  found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
  keep_minimal(found_, sets_);
  std::ranges::sort(found_);
  minimal_.add(found_);
}

Acceptances Acceptances::of_states(std::span<const State> states) && {
  Runs<AcceptanceId> of_state;
  for (const State state : states) of_state.add(of(state));
  return {std::move(sets_), std::move(of_state)};
}

Acceptances AcceptanceBuilder::finish() && {
  return {std::move(sets_).take(), std::move(minimal_)};
}

}  // namespace perentie::lts

#include "perentie/lts/revivals.hpp"

namespace perentie::lts {

StableOffers::StableOffers(const NormalLts& normal, const Lts& original) {
  std::vector<AcceptanceId> found;
  for (std::uint32_t node = 0; node < normal.lts.state_count(); ++node) {
    found.clear();
    for (const State state : normal.members[node]) {
      if (!original.is_stable(state)) continue;
      found.push_back(sets_.add(labels_on(original.edges(state))));
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    of_node_.add(found);
  }
}

bool RevivalSpecification::accepts(State node, std::span<const Label> offered) const {
  bool may_offer_nothing = false;
  std::vector<bool> revived(offered.size());
  for (const AcceptanceId id : offers_->of(node)) {
    const auto labels = offers_->labels(id);
    if (!std::ranges::includes(offered, labels)) continue;
    may_offer_nothing = may_offer_nothing || labels.empty();
    for (const Label label : labels) {
      const auto place = std::ranges::lower_bound(offered, label) - offered.begin();
      revived[static_cast<std::size_t>(place)] = true;
    }
  }
  if (offered.empty()) return may_offer_nothing;
  return std::ranges::all_of(revived, [](bool r) { return r; });
}

}  // namespace perentie::lts

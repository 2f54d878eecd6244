// The operators of a format: the rules of CSPM reference 4.2 for states that are leaves.
//
// Each operator computes the moves of its operands behind those that are there already, and makes
// them its own in place, or puts its own behind them and drops them.
#include <algorithm>

#include "machine/moves.hpp"

namespace perentie::semantics {

// --- Parallel -----------------------------------------------------------------------------------

bool MoveRules::interleave(const FormatNode& node) {
  bool terminates = true;
  for (const Operand& operand : node.operands) {
    const std::size_t begin = moves_.size();
    if (!this->node(operand.node)) return false;
    bool operand_terminates = false;
    std::size_t kept = begin;
    for (std::size_t m = begin; m < moves_.size(); ++m) {
      if (moves_[m].label == lts::tick) {
        operand_terminates = true;
      } else {
        moves_[kept++] = stays(node, operand, moves_[m]);
      }
    }
    moves_.resize(kept);
    terminates = terminates && operand_terminates;
  }
  if (terminates) moves_.push_back({lts::tick, processes_.stop()});
  return true;
}

// An event needs all operands that take part in it; the first of them leads (4.1.3: so does ✓).
bool MoveRules::parallel(const FormatNode& node) {
  std::vector<Range> ranges;
  const std::size_t begin = moves_.size();
  if (!operands(node, ranges)) return false;
  const std::size_t kept = moves_.size();
  const auto count = static_cast<std::uint32_t>(node.operands.size());
  const auto takes_part = [&](std::uint32_t i, std::uint32_t by, EventId event) {
    const EventBits* alphabet = node.operands[i].alphabet;
    if (alphabet != nullptr) return alphabet->contains(event);
    return i == by || node.events->contains(event);
  };
  index(ranges);
  std::vector<std::uint32_t> partners;
  for (std::uint32_t by = 0; by < count; ++by) {
    for (std::size_t m = ranges[by].begin; m < ranges[by].end; ++m) {
      const Move move = moves_[m];
      if (move.label == lts::tick) continue;
      if (move.label == lts::tau) {
        moves_.push_back(stays(node, node.operands[by], move));
        continue;
      }
      if (!takes_part(by, by, move.label)) continue;  // outside its own alphabet: blocked
      partners.clear();
      for (std::uint32_t i = 0; i < count; ++i) {
        if (!takes_part(i, by, move.label)) continue;
        partners.push_back(i);
        if (i < by) break;  // an earlier operand leads
      }
      if (partners[0] != by) continue;
      if (partners.size() == 1) {
        moves_.push_back(stays(node, node.operands[by], move));
        continue;
      }
      // The first move of the event stands for all of them.
      if (first_with(by, move.label) == m) push_synchronised(node, partners, ranges, move.label);
    }
  }
  bool terminates = true;
  for (std::uint32_t i = 0; i < count; ++i) {
    terminates = terminates && first_with(i, lts::tick) != no_move;
  }
  if (terminates) {
    moves_.push_back({lts::tick, processes_.stop()});
  }
  keep_from(begin, kept);
  return true;
}

bool MoveRules::link_parallel(const FormatNode& node) {
  const EventRelationId links{node.words[0]};
  std::vector<Range> ranges;
  const std::size_t begin = moves_.size();
  if (!operands(node, ranges)) return false;
  const std::size_t kept = moves_.size();
  const auto is_right_end = [&](EventId event) {
    const auto pairs = events_.pairs(links);
    return std::any_of(pairs.begin(), pairs.end(),
                       [&](const EventPair& pair) { return pair.to == event; });
  };
  constexpr std::uint32_t both[] = {0, 1};
  for (std::size_t l = ranges[0].begin; l < ranges[0].end; ++l) {
    const Move left = moves_[l];
    if (left.label == lts::tick) continue;
    const auto images = events_.images(links, left.label);
    if (images.empty()) {
      moves_.push_back(stays(node, node.operands[0], left));
      continue;
    }
    for (std::size_t r = ranges[1].begin; r < ranges[1].end; ++r) {
      const Move right = moves_[r];
      if (right.label != images[0].to) continue;
      const Move pair[] = {left, right};
      moves_.push_back(synchronised(node, both, pair, lts::tau));
    }
  }
  for (std::size_t r = ranges[1].begin; r < ranges[1].end; ++r) {
    const Move right = moves_[r];
    if (right.label == lts::tick || is_right_end(right.label)) continue;
    moves_.push_back(stays(node, node.operands[1], right));
  }
  if (can_terminate(ranges[0]) && can_terminate(ranges[1])) {
    moves_.push_back({lts::tick, processes_.stop()});
  }
  keep_from(begin, kept);
  return true;
}

// --- Hiding, renaming, priority -----------------------------------------------------------------

bool MoveRules::in_place(const FormatNode& node) {
  const std::size_t begin = moves_.size();
  const Operand& operand = node.operands[0];
  if (!this->node(operand.node)) return false;
  const bool hides_members = node.kind == ProcKind::hide;
  for (std::size_t m = begin; m < moves_.size(); ++m) {
    Move& move = moves_[m];
    if (move.term) move = stays(node, operand, move);
    if (node.events == nullptr || move.label == lts::tau || move.label == lts::tick) continue;
    if (node.events->contains(move.label) == hides_members) move.label = lts::tau;
  }
  return true;
}

bool MoveRules::rename(const FormatNode& node) {
  const EventRelationId relation{node.words[0]};
  const std::size_t begin = moves_.size();
  const Operand& operand = node.operands[0];
  if (!this->node(operand.node)) return false;
  const std::size_t kept = moves_.size();
  for (std::size_t m = begin; m < kept; ++m) {
    Move move = stays(node, operand, moves_[m]);
    const auto images = events_.images(relation, move.label);
    if (images.empty()) moves_.push_back(move);
    for (const EventPair& pair : images) {
      move.label = pair.to;
      moves_.push_back(move);
    }
  }
  keep_from(begin, kept);
  return true;
}

// τ and ✓ are of the first set, events of no set neither block nor are blocked (4.5.1).
bool MoveRules::prioritise(const FormatNode& node) {
  const auto rank = [&](EventId event) -> std::size_t {
    if (event == lts::tau || event == lts::tick) return 1;
    for (std::size_t i = 1; i < node.words.size(); ++i) {
      if (events_.contains(EventSetId{node.words[i]}, event)) return i;
    }
    return 0;
  };
  const std::size_t begin = moves_.size();
  const Operand& operand = node.operands[0];
  if (!this->node(operand.node)) return false;
  std::size_t highest = node.words.size();
  for (std::size_t m = begin; m < moves_.size(); ++m) {
    if (const std::size_t r = rank(moves_[m].label); r != 0) highest = std::min(highest, r);
  }
  std::size_t kept = begin;
  for (std::size_t m = begin; m < moves_.size(); ++m) {
    if (rank(moves_[m].label) <= highest) moves_[kept++] = stays(node, operand, moves_[m]);
  }
  moves_.resize(kept);
  return true;
}

bool MoveRules::prioritise_partial(const FormatNode& node) {
  const EventSetId below_tau{node.words[0]};
  const EventRelationId blocked_by{node.words[1]};
  const std::size_t begin = moves_.size();
  const Operand& operand = node.operands[0];
  if (!this->node(operand.node)) return false;
  const std::vector<Move> all(moves_.begin() + static_cast<std::ptrdiff_t>(begin), moves_.end());
  moves_.resize(begin);
  const auto offers = [&](EventId event) {
    return std::any_of(all.begin(), all.end(), [&](const Move& m) { return m.label == event; });
  };
  const bool is_urgent = offers(lts::tau) || offers(lts::tick);
  for (const Move& move : all) {
    if (is_urgent && events_.contains(below_tau, move.label)) continue;
    const auto blockers = events_.images(blocked_by, move.label);
    const bool is_blocked = std::any_of(blockers.begin(), blockers.end(),
                                        [&](const EventPair& pair) { return offers(pair.to); });
    if (!is_blocked) moves_.push_back(stays(node, operand, move));
  }
  return true;
}

// --- Choice and sequence ------------------------------------------------------------------------

bool MoveRules::external_choice(const FormatNode& node) {
  for (const Operand& operand : node.operands) {
    const std::size_t begin = moves_.size();
    if (!this->node(operand.node)) return false;
    for (std::size_t m = begin; m < moves_.size(); ++m) {
      const Move move = moves_[m];
      const bool resolves = move.label != lts::tau;
      moves_[m] = resolves ? Move{move.label, after(operand, move)} : stays(node, operand, move);
    }
  }
  return true;
}

// A state `P ; Q` whose P can only terminate is the state Q (6.2.6).
bool MoveRules::sequential(const FormatNode& node) {
  const std::size_t begin = moves_.size();
  const Operand& left = node.operands[0];
  const ProcId right{node.words[1]};
  if (!this->node(left.node)) return false;
  const std::size_t end = moves_.size();
  for (std::size_t m = begin; m < end; ++m) {
    const Move move = moves_[m];
    if (move.label == lts::tick) {
      moves_[m] = {lts::tau, right};
    } else if (move.term) {
      rules_.set_below_priority(node.is_below_priority);
      const auto target = rules_.sequential_target(move.term, right);
      rules_.set_below_priority(false);
      if (!target) return false;
      moves_[m] = {move.label, *target};
    } else {
      const auto is_elided = only_terminates_after(left.node, move);
      if (!is_elided) return false;
      if (*is_elided) moves_[m] = {move.label, right};
    }
  }
  return true;
}

std::optional<bool> MoveRules::only_terminates_after(std::uint32_t number, const Move& move) {
  const FormatNode& node = format_->nodes[number];
  if (node.kind == ProcKind::compression || node.kind == ProcKind::sliding_choice) return false;
  if (node.ends_with_leaves) {  // mostly answers: a leaf that has just moved does not terminate
    for (const LeafChange& change : changes(move)) {
      const auto run = steps_of_leaf(change.term, false, node.is_below_priority);
      if (!run) return std::nullopt;
      if (!run->has_tick) return false;
    }
  }
  std::vector<ProcId> before = leaves_;
  for (const LeafChange& change : changes(move)) leaves_[change.leaf] = change.term;
  const std::size_t begin = moves_.size();
  const std::size_t first_change = changes_.size();
  const bool done = this->node(number);
  leaves_ = std::move(before);
  if (!done) return std::nullopt;
  const bool only = moves_.size() > begin &&
                    std::all_of(moves_.begin() + static_cast<std::ptrdiff_t>(begin), moves_.end(),
                                [](const Move& m) { return m.label == lts::tick; });
  moves_.resize(begin);
  changes_.resize(first_change);
  return only;
}

bool MoveRules::interrupt(const FormatNode& node) {
  const Operand& left = node.operands[0];
  const Operand& right = node.operands[1];
  const std::size_t begin = moves_.size();
  if (!this->node(left.node)) return false;
  for (std::size_t m = begin; m < moves_.size(); ++m) moves_[m] = stays(node, left, moves_[m]);
  const std::size_t middle = moves_.size();
  if (!this->node(right.node)) return false;
  for (std::size_t m = middle; m < moves_.size(); ++m) {
    const Move move = moves_[m];
    const bool resolves = move.label != lts::tau;
    moves_[m] = resolves ? Move{move.label, after(right, move)} : stays(node, right, move);
  }
  return true;
}

bool MoveRules::sliding_choice(const FormatNode& node) {
  const Operand& left = node.operands[0];
  moves_.push_back({lts::tau, ProcId{node.words[1]}});
  const std::size_t begin = moves_.size();
  if (!this->node(left.node)) return false;
  for (std::size_t m = begin; m < moves_.size(); ++m) {
    const Move move = moves_[m];
    const bool resolves = move.label != lts::tau;
    moves_[m] = resolves ? Move{move.label, after(left, move)} : stays(node, left, move);
  }
  return true;
}

bool MoveRules::exception(const FormatNode& node) {
  const Operand& operand = node.operands[0];
  const std::size_t begin = moves_.size();
  if (!this->node(operand.node)) return false;
  for (std::size_t m = begin; m < moves_.size(); ++m) {
    const Move move = moves_[m];
    const bool is_handled = move.label != lts::tick && node.events->contains(move.label);
    moves_[m] = is_handled ? Move{move.label, ProcId{node.words[2]}} : stays(node, operand, move);
  }
  return true;
}

bool MoveRules::sync_choice(const FormatNode& node) {
  std::vector<Range> ranges;
  const std::size_t begin = moves_.size();
  if (!operands(node, ranges)) return false;
  const std::size_t kept = moves_.size();
  index(ranges);
  std::vector<std::uint32_t> all(node.operands.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    for (std::size_t m = ranges[i].begin; m < ranges[i].end; ++m) {
      const Move move = moves_[m];
      if (move.label == lts::tau) {
        moves_.push_back(stays(node, node.operands[i], move));
      } else if (!node.events->contains(move.label)) {
        moves_.push_back({move.label, after(node.operands[i], move)});
      } else if (i == 0 && first_with(0, move.label) == m) {
        push_synchronised(node, all, ranges, move.label);
      }
    }
  }
  keep_from(begin, kept);
  return true;
}

bool MoveRules::sync_interrupt(const FormatNode& node) {
  std::vector<Range> ranges;
  const std::size_t begin = moves_.size();
  if (!operands(node, ranges)) return false;
  const std::size_t kept = moves_.size();
  index(ranges);
  constexpr std::uint32_t both[] = {0, 1};
  for (std::size_t m = ranges[0].begin; m < ranges[0].end; ++m) {
    const Move move = moves_[m];
    if (move.label == lts::tick || !node.events->contains(move.label)) {
      moves_.push_back(stays(node, node.operands[0], move));
    } else if (first_with(0, move.label) == m) {
      push_synchronised(node, both, ranges, move.label);
    }
  }
  for (std::size_t m = ranges[1].begin; m < ranges[1].end; ++m) {
    const Move move = moves_[m];
    if (move.label == lts::tau) {
      moves_.push_back(stays(node, node.operands[1], move));
    } else if (!node.events->contains(move.label)) {
      moves_.push_back({move.label, after(node.operands[1], move)});
    }
  }
  keep_from(begin, kept);
  return true;
}

}  // namespace perentie::semantics

#include "machine/moves.hpp"

#include <algorithm>
#include <utility>

#include "perentie/base/check.hpp"

namespace perentie::semantics {

bool MoveRules::compute(FormatId format, std::span<const ProcId> leaves) {
  format_id_ = format;
  format_ = &formats_[format];
  leaves_.assign(leaves.begin(), leaves.end());
  moves_.clear();
  changes_.clear();
  return node(0);
}

bool MoveRules::node(std::uint32_t number) {
  constexpr std::uint64_t costly_work = 32;
  const FormatNode& node = format_->nodes[number];
  if (node.is_leaf) return leaf(node);
  const std::uint64_t place = (std::uint64_t{format_id_.value} << 32U) | number;
  const bool is_costly = number != 0 && costly_.contains(place);
  std::uint32_t key = 0;
  if (is_costly) {
    key = key_of(number, node);
    if (remembered_[key].first != no_move) {
      recall(remembered_[key]);
      return true;
    }
  }
  const std::uint64_t work = work_;
  const std::uint64_t times_emptied = times_emptied_;
  const std::size_t begin = moves_.size();
  if (!apply(node)) return false;
  if (is_costly) {
    if (times_emptied == times_emptied_) remember(key, begin);
  } else if (number != 0 && work_ - work > costly_work) {
    costly_.insert(place);
  }
  return true;
}

std::uint32_t MoveRules::key_of(std::uint32_t number, const FormatNode& node) {
  constexpr std::size_t max_remembered = 1U << 20U;
  constexpr std::size_t max_moves = 1U << 23U;
  if (remembered_.size() >= max_remembered || known_moves_.size() >= max_moves) {
    keys_ = {};
    remembered_.clear();
    known_moves_.clear();
    known_changes_.clear();
    ++times_emptied_;
  }
  key_.assign({format_id_.value, number});
  for (std::uint32_t i = node.first_leaf; i < node.end_leaf; ++i) key_.push_back(leaves_[i].value);
  const std::uint32_t key = keys_.intern(0, key_);
  if (key == remembered_.size()) remembered_.push_back({no_move, 0, false});
  return key;
}

void MoveRules::recall(const Run& run) {
  for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
    Move move = known_moves_[i];
    const std::uint32_t first = move.first;
    move.first = static_cast<std::uint32_t>(changes_.size());
    for (std::uint32_t c = 0; c < move.count; ++c) changes_.push_back(known_changes_[first + c]);
    moves_.push_back(move);
  }
}

void MoveRules::remember(std::uint32_t key, std::size_t begin) {
  Run& run = remembered_[key];
  run = {static_cast<std::uint32_t>(known_moves_.size()),
         static_cast<std::uint32_t>(moves_.size() - begin), false};
  for (std::size_t m = begin; m < moves_.size(); ++m) {
    Move move = moves_[m];
    const auto own = changes(move);
    move.first = static_cast<std::uint32_t>(known_changes_.size());
    known_changes_.insert(known_changes_.end(), own.begin(), own.end());
    known_moves_.push_back(move);
  }
}

std::size_t MoveRules::memory_bytes() const {
  return step_pool_.capacity() * sizeof(LeafStep) + keys_.memory_bytes() +
         known_moves_.capacity() * sizeof(Move) + known_changes_.capacity() * sizeof(LeafChange) +
         remembered_.capacity() * sizeof(Run);
}

bool MoveRules::apply(const FormatNode& node) {
  switch (node.kind) {
    case ProcKind::interleave:
      return interleave(node);
    case ProcKind::parallel:
    case ProcKind::alphabet_parallel:
      return parallel(node);
    case ProcKind::link_parallel:
      return link_parallel(node);
    case ProcKind::hide:
    case ProcKind::project:
    case ProcKind::compression:
      return in_place(node);
    case ProcKind::rename:
      return rename(node);
    case ProcKind::prioritise:
      return prioritise(node);
    case ProcKind::prioritise_partial:
      return prioritise_partial(node);
    case ProcKind::external_choice:
      return external_choice(node);
    case ProcKind::sequential:
      return sequential(node);
    case ProcKind::interrupt:
      return interrupt(node);
    case ProcKind::sliding_choice:
      return sliding_choice(node);
    case ProcKind::exception:
      return exception(node);
    case ProcKind::sync_choice:
      return sync_choice(node);
    case ProcKind::sync_interrupt:
      return sync_interrupt(node);
    default:
      PERENTIE_CHECK(false, "a format has an operator without rules");
  }
  return false;
}

// --- Leaves -------------------------------------------------------------------------------------

std::optional<MoveRules::Run> MoveRules::steps_of_leaf(ProcId term, bool is_settled) {
  auto& known = known_steps_[is_settled ? 1 : 0];
  const auto found = known.find(term.value);
  if (found != known.end()) return found->second;
  StepRules::Steps steps;
  const bool done =
      is_settled ? rules_.successors(term, steps) : rules_.unsettled_successors(term, steps);
  if (!done) return std::nullopt;
  Run run{static_cast<std::uint32_t>(step_pool_.size()), static_cast<std::uint32_t>(steps.size()),
          false};
  for (const StepRules::Step& step : steps) {
    run.has_tick = run.has_tick || step.label == lts::tick;
    step_pool_.push_back({step.label, step.target, formats_.is_composite(step.target)});
  }
  known.emplace(term.value, run);
  return run;
}

bool MoveRules::leaf(const FormatNode& node) {
  const auto run = steps_of_leaf(leaves_[node.first_leaf], node.is_settled);
  if (!run) return false;
  work_ += run->count;
  for (std::uint32_t i = run->first; i < run->first + run->count; ++i) {
    const LeafStep& step = step_pool_[i];
    if (step.is_composite || step.label == lts::tick) {
      moves_.push_back({step.label, step.target});
    } else {
      moves_.push_back({step.label, {}, static_cast<std::uint32_t>(changes_.size()), 1});
      changes_.push_back({node.first_leaf, step.target});
    }
  }
  return true;
}

// --- What operators share -----------------------------------------------------------------------

bool MoveRules::operands(const FormatNode& node, std::vector<Range>& ranges) {
  for (const Operand& operand : node.operands) {
    const std::size_t begin = moves_.size();
    if (!this->node(operand.node)) return false;
    ranges.push_back({begin, moves_.size()});
  }
  return true;
}

void MoveRules::keep_from(std::size_t begin, std::size_t kept) {
  moves_.erase(moves_.begin() + static_cast<std::ptrdiff_t>(begin),
               moves_.begin() + static_cast<std::ptrdiff_t>(kept));
}

bool MoveRules::can_terminate(Range range) const {
  return std::any_of(moves_.begin() + static_cast<std::ptrdiff_t>(range.begin),
                     moves_.begin() + static_cast<std::ptrdiff_t>(range.end),
                     [](const Move& move) { return move.label == lts::tick; });
}

ProcId MoveRules::now(const Operand& operand) {
  return formats_.join(*format_, operand.node, leaves_);
}

ProcId MoveRules::after(const Operand& operand, const Move& move) {
  if (move.term) return move.term;
  std::vector<ProcId> leaves = leaves_;
  for (const LeafChange& change : changes(move)) leaves[change.leaf] = change.term;
  return formats_.join(*format_, operand.node, leaves);
}

// ✓ ends the whole (4.1.2): its target is a term already, that of a terminated process.
Move MoveRules::stays(const FormatNode& node, const Operand& operand, const Move& move) {
  if (!move.term || move.label == lts::tick) return move;
  std::vector<std::uint32_t> words = node.words;
  for (const Operand& other : node.operands) {
    words[other.word] = (&other == &operand ? move.term : now(other)).value;
  }
  return {move.label, processes_.make(node.kind, words)};
}

Move MoveRules::synchronised(const FormatNode& node, std::span<const std::uint32_t> operands,
                             std::span<const Move> moves, EventId label) {
  const bool stays =
      std::all_of(moves.begin(), moves.end(), [](const Move& move) { return !move.term; });
  if (stays) {
    Move joint{label, {}, static_cast<std::uint32_t>(changes_.size()), 0};
    for (const Move& move : moves) {
      joint.count += move.count;
      for (std::uint32_t i = 0; i < move.count; ++i) {
        const LeafChange change = changes_[move.first + i];
        changes_.push_back(change);
      }
    }
    return joint;
  }
  std::vector<std::uint32_t> words = node.words;
  for (const Operand& operand : node.operands) words[operand.word] = now(operand).value;
  for (std::size_t i = 0; i < operands.size(); ++i) {
    const Operand& operand = node.operands[operands[i]];
    words[operand.word] = after(operand, moves[i]).value;
  }
  return {label, processes_.make(node.kind, words)};
}

void MoveRules::index(std::span<const Range> ranges) {
  ++stamp_;
  if (indices_.size() < ranges.size()) indices_.resize(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    LabelIndex& index = indices_[i];
    const auto begin = static_cast<std::uint32_t>(ranges[i].begin);
    const auto end = static_cast<std::uint32_t>(ranges[i].end);
    index.next.resize(end - begin);
    for (std::uint32_t m = end; m-- > begin;) {
      const std::uint32_t label = moves_[m].label.value;
      if (label >= index.first.size()) {
        index.first.resize(label + 1);
        index.stamp.resize(label + 1);
      }
      index.next[m - begin] = index.stamp[label] == stamp_ ? index.first[label] : no_move;
      index.first[label] = m;
      index.stamp[label] = stamp_;
    }
  }
}

std::uint32_t MoveRules::first_with(std::size_t operand, EventId label) const {
  const LabelIndex& index = indices_[operand];
  const bool is_known = label.value < index.stamp.size() && index.stamp[label.value] == stamp_;
  return is_known ? index.first[label.value] : no_move;
}

// The operands perform the event together, each in every way it can; the first changes fastest.
void MoveRules::push_synchronised(const FormatNode& node, std::span<const std::uint32_t> operands,
                                  std::span<const Range> ranges, EventId label) {
  std::vector<std::uint32_t>& chosen = chosen_;
  chosen.clear();
  for (const std::uint32_t operand : operands) {
    chosen.push_back(first_with(operand, label));
    if (chosen.back() == no_move) return;
  }
  std::vector<Move>& moves = chosen_moves_;
  for (;;) {
    moves.clear();
    for (const std::uint32_t m : chosen) moves.push_back(moves_[m]);
    moves_.push_back(synchronised(node, operands, moves, label));
    std::size_t i = 0;
    for (; i < chosen.size(); ++i) {
      chosen[i] = next_with(operands[i], ranges[operands[i]], chosen[i]);
      if (chosen[i] != no_move) break;
      chosen[i] = first_with(operands[i], label);
    }
    if (i == chosen.size()) return;
  }
}

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
      const auto target = rules_.sequential_target(move.term, right);
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
      const auto run = steps_of_leaf(change.term, false);
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

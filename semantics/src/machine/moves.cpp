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

std::optional<MoveRules::Run> MoveRules::steps_of_leaf(ProcId term, bool is_settled,
                                                       bool is_below_priority) {
  auto& known = known_steps_[(is_settled ? 1 : 0) + (is_below_priority ? 2 : 0)];
  const auto found = known.find(term.value);
  if (found != known.end()) return found->second;
  StepRules::Steps steps;
  rules_.set_below_priority(is_below_priority);
  const bool done =
      is_settled ? rules_.successors(term, steps) : rules_.unsettled_successors(term, steps);
  rules_.set_below_priority(false);
  if (!done) return std::nullopt;
  Run run{static_cast<std::uint32_t>(step_pool_.size()), static_cast<std::uint32_t>(steps.size()),
          false};
  for (const StepRules::Step& step : steps) {
    run.has_tick = run.has_tick || step.label == lts::tick;
    step_pool_.push_back(
        {step.label, step.target, formats_.is_composite(step.target, is_below_priority)});
  }
  known.emplace(term.value, run);
  return run;
}

bool MoveRules::leaf(const FormatNode& node) {
  const auto run = steps_of_leaf(leaves_[node.first_leaf], node.is_settled, node.is_below_priority);
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

}  // namespace perentie::semantics

// Moves: the transitions of a composite state, computed by the operators of its format.
//
// The rules are those of CSPM reference 4.2, as in the step rules and in their order, but most
// moves only change a few leaves of the state, and then no term is made. A move that changes the
// format gives its target as a term.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "machine/formats.hpp"
#include "perentie/semantics/step.hpp"

namespace perentie::semantics {

struct LeafChange {
  std::uint32_t leaf;
  ProcId term;
};

struct Move {
  EventId label;
  ProcId term = {};         ///< the target of the operator; none: it stays, with these changes
  std::uint32_t first = 0;  ///< of the changes
  std::uint32_t count = 0;
};

class MoveRules {
 public:
  MoveRules(const EventTable& events, ProcStore& processes, FormatTable& formats, StepRules& rules)
      : events_(events), processes_(processes), formats_(formats), rules_(rules) {}

  /// Computes the moves of a state. False: see `StepRules::successors`.
  bool compute(FormatId format, std::span<const ProcId> leaves);
  /// What `compute` found; the targets of ✓ are terms.
  std::span<const Move> moves() const { return moves_; }
  std::span<const LeafChange> changes(const Move& move) const {
    return std::span<const LeafChange>(changes_).subspan(move.first, move.count);
  }
  std::size_t memory_bytes() const;
  /// The leaf terms whose steps are known.
  std::size_t leaf_states() const {
    std::size_t count = 0;
    for (const auto& known : known_steps_) count += known.size();
    return count;
  }

 private:
  using Operand = FormatNode::Operand;
  static constexpr std::uint32_t no_move = ~std::uint32_t{0};

  // The moves of an operand, in `moves_`.
  struct Range {
    std::size_t begin;
    std::size_t end;
  };
  struct LeafStep {
    EventId label;
    ProcId target;
    bool is_composite;
  };
  struct Run {
    std::uint32_t first;
    std::uint32_t count;
    bool has_tick;
  };

  // The moves of one operand by label, in their order.
  struct LabelIndex {
    std::vector<std::uint32_t> first;  // by label: in `moves_`
    std::vector<std::uint32_t> stamp;  // by label: when `first` was set
    std::vector<std::uint32_t> next;   // by position in the range: the next with the same label
  };

  // Each appends the moves of a node to `moves_`.
  bool node(std::uint32_t number);
  bool apply(const FormatNode& node);
  bool leaf(const FormatNode& node);
  bool interleave(const FormatNode& node);
  bool parallel(const FormatNode& node);
  bool link_parallel(const FormatNode& node);
  bool in_place(const FormatNode& node);
  bool rename(const FormatNode& node);
  bool prioritise(const FormatNode& node);
  bool prioritise_partial(const FormatNode& node);
  bool external_choice(const FormatNode& node);
  bool sequential(const FormatNode& node);
  bool interrupt(const FormatNode& node);
  bool sliding_choice(const FormatNode& node);
  bool exception(const FormatNode& node);
  bool sync_choice(const FormatNode& node);
  bool sync_interrupt(const FormatNode& node);

  // The moves of nodes that are costly are remembered, as most states differ from another in a few
  // leaves.
  std::uint32_t key_of(std::uint32_t number, const FormatNode& node);
  void recall(const Run& run);
  void remember(std::uint32_t key, std::size_t begin);

  std::optional<Run> steps_of_leaf(ProcId term, bool is_settled, bool is_below_priority);
  bool operands(const FormatNode& node, std::vector<Range>& ranges);
  // Drops the moves of the operands, which those of the node follow.
  void keep_from(std::size_t begin, std::size_t kept);
  bool can_terminate(Range range) const;
  // Whether the state that a move of the node leads to has ✓ and nothing else.
  std::optional<bool> only_terminates_after(std::uint32_t number, const Move& move);

  // The term that an operand is, as it stands or after one of its moves.
  ProcId now(const Operand& operand);
  ProcId after(const Operand& operand, const Move& move);
  // The move of the node when one operand moves and the node stays in place.
  Move stays(const FormatNode& node, const Operand& operand, const Move& move);
  Move synchronised(const FormatNode& node, std::span<const std::uint32_t> operands,
                    std::span<const Move> moves, EventId label);
  void push_synchronised(const FormatNode& node, std::span<const std::uint32_t> operands,
                         std::span<const Range> ranges, EventId label);
  // Indexes the moves of all operands, for `first_with`.
  void index(std::span<const Range> ranges);
  // The first move of an operand with a label, and the one after a move; `no_move` if there is
  // none.
  std::uint32_t first_with(std::size_t operand, EventId label) const;
  std::uint32_t next_with(std::size_t operand, Range range, std::uint32_t move) const {
    return indices_[operand].next[move - range.begin];
  }

  const EventTable& events_;
  ProcStore& processes_;
  FormatTable& formats_;
  StepRules& rules_;

  FormatId format_id_;              // of the state in work
  const Format* format_ = nullptr;  // of the state in work
  std::vector<ProcId> leaves_;      // of the state in work
  std::vector<Move> moves_;
  std::vector<LeafChange> changes_;
  std::vector<LabelIndex> indices_;  // by operand of the node in work
  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> chosen_;  // scratch
  std::vector<Move> chosen_moves_;     // scratch
  std::vector<LeafStep> step_pool_;
  // By leaf term; settled or not, below priority or not.
  std::unordered_map<std::uint32_t, Run> known_steps_[4];

  std::uint64_t work_ = 0;                    // moves of leaves that were looked at
  std::unordered_set<std::uint64_t> costly_;  // nodes: format and number
  base::TermTable keys_;         // of what is remembered: a format, a node and its leaves
  std::vector<Run> remembered_;  // by key; of known_moves_
  std::vector<Move> known_moves_;
  std::vector<LeafChange> known_changes_;
  std::uint64_t times_emptied_ = 0;
  std::vector<std::uint32_t> key_;  // scratch
};

}  // namespace perentie::semantics

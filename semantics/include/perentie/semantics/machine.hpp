// Compiled machines: a process as leaf LTSs and the rules by which they synchronise.
//
// The parallel operators, hiding and renaming above the recursion of a process stay in place while
// it runs, so they are compiled away: a state is one state for each leaf, packed into a few words,
// and a rule says which leaves perform which events together and what the whole then performs.
// Everything else is a leaf, explored by the step rules. Unless leaves are compressed, reachable
// states and transitions are those of the step rules, repetitions included, in another order. FDR
// calls this a supercombinator (CSPM reference 6.1; Gibson-Robinson et al., FDR3, TACAS 2014).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "perentie/base/check.hpp"
#include "perentie/base/hash.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/lts/transition_system.hpp"
#include "perentie/semantics/process.hpp"

namespace perentie::semantics {

/// What is done with each leaf before it is part of a machine (CSPM reference 4.7.10).
enum class LeafCompression : std::uint8_t {
  none,
  sbisim,  ///< the quotient by strong bisimulation, FDR's default
  wbisim,  ///< by divergence-respecting weak bisimulation, where it preserves enough
};

struct MachineOptions {
  /// Time, cancellation and memory; `max_states` does not matter.
  base::Limits limits = {};
  /// Leaves with more states, together, are left to the step rules with the whole process.
  std::uint64_t max_leaf_states = 100'000;
  /// The same for processes with more rules.
  std::size_t max_rules = 1'000'000;
  /// The same for processes with fewer leaves, which a machine does not make faster.
  std::size_t min_leaves = 2;
  /// Of machines with at least two leaves.
  LeafCompression leaf_compression = LeafCompression::none;
  /// Whether states of `normal(..)` and the like are those of a generalised LTS (4.7.1). What they
  /// may refuse is then said by `for_each_stable` alone. Otherwise they have τ.
  bool generalises = false;
};

/// A process that is a leaf, maybe several times.
struct LeafSize {
  ProcId process;
  std::uint64_t explored_states, explored_edges;
  std::uint64_t states, edges;  ///< after compression
};

/// How a process became a machine, for statistics.
struct MachineStructure {
  bool is_compiled = false;     ///< otherwise it is lazy
  bool is_generalised = false;  ///< some leaf is a generalised LTS
  std::size_t formats = 1;      ///< that have several leaves
  /// Of a compiled machine.
  std::vector<LeafSize> leaf_sizes = {};
  std::vector<std::uint32_t> leaf_kinds = {};  ///< by leaf: of `leaf_sizes`
  std::size_t rules = 0;
  std::size_t words = 0;  ///< of 64 bits, of a state
  /// Of a lazy machine: the states of leaves whose transitions were computed.
  std::size_t leaf_states = 0;
};

/// The tables of a machine, laid out for the computation of successors.
struct CompiledMachine {
  /// Where the state of a leaf lies in the words of a packed state, and its first row in the
  /// tables.
  struct Leaf {
    std::uint32_t word;
    std::uint32_t shift;
    std::uint64_t mask;  ///< after shifting to the right
    std::uint32_t first_row;
  };
  /// Something that the leaf that leads rules can do: try each rule of the run.
  struct Lead {
    std::uint64_t change;  ///< of the leaf's word, by exclusive or
    std::uint32_t first_rule;
    std::uint32_t end_rule;
  };
  /// A state of a leaf: where what it can do begins, which ends with the next row.
  struct Row {
    std::uint32_t first_lead;
    std::uint32_t first_follow;
    /// The ports of its follows modulo 64, as bits: most rules that cannot fire are known by them.
    std::uint64_t ports;
  };
  /// Something that a leaf can do when another leaf leads. `port` numbers its events.
  struct Follow {
    std::uint64_t change;
    std::uint32_t port;
  };
  struct Partner {
    std::uint32_t leaf;
    std::uint32_t port;
  };
  struct Rule {
    lts::Label event;  ///< of the whole
    std::uint32_t first_partner;
    std::uint32_t end_partner;
  };

  std::vector<Leaf> leaves;
  std::vector<std::uint32_t> leaders;  ///< leaves that lead some rule
  std::vector<Row> rows;               ///< of the leaves, one after the other, and an end
  std::vector<Lead> leads;
  std::vector<Follow> follows;  ///< of each row, by port
  std::vector<Rule> rules;
  std::vector<Partner> partners;
  /// Changes of the leaf's word that lead from a state of a generalised leaf to the stable states
  /// that it may be, and by row the first of them, with an end. Empty: no leaf is generalised.
  std::vector<std::uint64_t> choices;
  std::vector<std::uint32_t> first_choice;
  std::vector<LeafSize> leaf_sizes;
  std::vector<std::uint32_t> leaf_kinds;  ///< by leaf: of `leaf_sizes`
  /// By kind: of a term, the state that it is.
  std::vector<std::unordered_map<std::uint32_t, std::uint32_t>> states_of_terms;
  std::vector<std::uint64_t> initial;  ///< packed
  ProcId root;                         ///< the initial term
  bool may_diverge = true;             ///< false: no state leads to τ for ever
  bool is_weak = false;                ///< leaves lack τ that their terms have
  std::vector<ProcId> row_terms;       ///< by row; none: terminated
  std::shared_ptr<const lts::LabelNames> label_names;

  /// The words of a packed state.
  std::size_t width() const { return initial.size(); }
  std::uint64_t memory_bytes() const;
};

struct MachineCompilation {
  /// Nothing: the step rules are to be used, or `limit` was reached.
  std::optional<CompiledMachine> machine;
  std::optional<base::LimitReached> limit;  ///< time or cancellation
  bool has_large_leaves = false;            ///< there may be a machine if leaves may be larger
};

/// The row of a leaf's state in the tables.
inline std::size_t machine_row(const CompiledMachine::Leaf& leaf,
                               std::span<const std::uint64_t> state) {
  return leaf.first_row + ((state[leaf.word] >> leaf.shift) & leaf.mask);
}

/// The state of a machine. Compared without a branch for each word: most comparisons of a search
/// are between equal states.
template <std::size_t words>
struct PackedState : std::array<std::uint64_t, words> {
  friend bool operator==(const PackedState& a, const PackedState& b) {
    std::uint64_t difference = 0;
    for (std::size_t i = 0; i < words; ++i) difference |= a[i] ^ b[i];
    return difference == 0;
  }
};

/// A machine with states of `words` words as a `lts::TransitionSystem`. Keeps a reference.
template <std::size_t words>
class MachineSystem {
 public:
  using State = PackedState<words>;
  using Steps = std::vector<lts::Transition<State>>;

  explicit MachineSystem(const CompiledMachine& machine) : machine_(&machine) {}

  State initial() const {
    State state{};
    std::copy(machine_->initial.begin(), machine_->initial.end(), state.begin());
    return state;
  }

  bool successors(const State& state, Steps& out) const {
    for (const std::uint32_t leader : machine_->leaders) {
      const CompiledMachine::Leaf& leaf = machine_->leaves[leader];
      const CompiledMachine::Row* row = &machine_->rows[machine_row(leaf, state)];
      const std::uint32_t end = row[1].first_lead;
      for (std::uint32_t i = row->first_lead; i < end; ++i) {
        const CompiledMachine::Lead& lead = machine_->leads[i];
        State target = state;
        target[leaf.word] ^= lead.change;
        for (std::uint32_t r = lead.first_rule; r < lead.end_rule; ++r) {
          const CompiledMachine::Rule& rule = machine_->rules[r];
          if (may_fire(rule, state)) fire(rule, state, target, out);
        }
      }
    }
    return true;
  }

  /// False: no state leads to τ for ever.
  bool may_diverge() const { return machine_->may_diverge; }

  /// Whether the state of some leaf is one of several stable ones (`lts::GeneralisedSystem`).
  bool is_generalised(const State& state) const {
    return !machine_->first_choice.empty() &&
           std::ranges::any_of(machine_->leaves, [&](const CompiledMachine::Leaf& leaf) {
             return !choices(leaf, state).empty();
           });
  }

  /// Every leaf chooses one of its stable states; those choices are stable together that have no τ
  /// together.
  template <class Use>
  void for_each_stable(const State& state, Use use) const {
    struct Turn {
      std::uint32_t word;
      std::span<const std::uint64_t> changes;
      std::size_t taken = 0;
    };
    std::vector<Turn> turns;
    State stable = state;
    for (const CompiledMachine::Leaf& leaf : machine_->leaves) {
      const auto changes = choices(leaf, state);
      if (changes.empty()) continue;
      turns.push_back({leaf.word, changes});
      stable[leaf.word] ^= changes[0];
    }
    Steps steps;
    std::vector<lts::Label> offered;
    for (;;) {
      steps.clear();
      offered.clear();
      successors(stable, steps);
      for (const auto& step : steps) offered.push_back(step.label);
      std::ranges::sort(offered);
      offered.erase(std::unique(offered.begin(), offered.end()), offered.end());
      const bool is_stable = offered.empty() || offered.front() != lts::tau;
      if (is_stable && !use(stable, offered)) return;
      const bool is_last = std::ranges::all_of(turns, [&](Turn& turn) {
        const std::uint64_t old = turn.changes[turn.taken];
        turn.taken = (turn.taken + 1) % turn.changes.size();
        stable[turn.word] ^= old ^ turn.changes[turn.taken];
        return turn.taken == 0;
      });
      if (is_last) return;
    }
  }

  std::uint64_t state_hash(const State& state) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t word : state) hash = base::hash_mix(hash, word);
    return hash;
  }
  std::shared_ptr<const lts::LabelNames> label_names() const { return machine_->label_names; }
  std::uint64_t memory_bytes() const { return machine_->memory_bytes(); }

 private:
  std::span<const std::uint64_t> choices(const CompiledMachine::Leaf& leaf,
                                         const State& state) const {
    const std::uint32_t* first = &machine_->first_choice[machine_row(leaf, state)];
    return std::span(machine_->choices).subspan(first[0], first[1] - first[0]);
  }

  const CompiledMachine::Row* row_of(const CompiledMachine::Partner& partner,
                                     const State& state) const {
    return &machine_->rows[machine_row(machine_->leaves[partner.leaf], state)];
  }

  /// False: some partner cannot take part.
  bool may_fire(const CompiledMachine::Rule& rule, const State& state) const {
    for (std::uint32_t p = rule.first_partner; p < rule.end_partner; ++p) {
      const CompiledMachine::Partner& partner = machine_->partners[p];
      if ((row_of(partner, state)->ports >> (partner.port % 64) & 1U) == 0) return false;
    }
    return true;
  }

  /// What a partner can do in a rule.
  std::pair<const CompiledMachine::Follow*, const CompiledMachine::Follow*> moves(
      const CompiledMachine::Partner& partner, const State& state) const {
    constexpr std::ptrdiff_t short_row = 8;
    const CompiledMachine::Row* row = row_of(partner, state);
    const CompiledMachine::Follow* first = machine_->follows.data() + row[0].first_follow;
    const CompiledMachine::Follow* last = machine_->follows.data() + row[1].first_follow;
    if (last - first > short_row) {
      first = std::lower_bound(first, last, partner.port,
                               [](const auto& f, std::uint32_t port) { return f.port < port; });
    } else {
      while (first != last && first->port < partner.port) ++first;
    }
    const CompiledMachine::Follow* end = first;
    while (end != last && end->port == partner.port) ++end;
    return {first, end};
  }

  /// The leader has moved already: `target`. Every combination of the partners' moves is a step.
  void fire(const CompiledMachine::Rule& rule, const State& state, const State& target,
            Steps& out) const {
    const std::size_t begin = out.size();
    out.push_back({rule.event, target});
    for (std::uint32_t p = rule.first_partner; p < rule.end_partner; ++p) {
      const CompiledMachine::Partner& partner = machine_->partners[p];
      const auto [first, end] = moves(partner, state);
      if (first == end) {
        out.resize(begin);
        return;
      }
      const std::uint32_t word = machine_->leaves[partner.leaf].word;
      const std::size_t before = out.size();
      for (const CompiledMachine::Follow* move = first + 1; move != end; ++move) {
        for (std::size_t i = begin; i < before; ++i) {
          lts::Transition<State> copy = out[i];
          copy.target[word] ^= move->change;
          out.push_back(copy);
        }
      }
      for (std::size_t i = begin; i < before; ++i) out[i].target[word] ^= first->change;
    }
  }

  const CompiledMachine* machine_;
};

/// The widest packed state that `with_system` can take.
inline constexpr std::size_t max_machine_width = 32;

/// Calls `use` with the number of words, as a `std::integral_constant`, that states are to have.
template <class Use>
auto with_width(const CompiledMachine& machine, Use use) {
  const std::size_t width = machine.width();
  PERENTIE_CHECK(width <= max_machine_width, "a machine is too wide");
  if (width <= 1) return use(std::integral_constant<std::size_t, 1>());
  if (width <= 2) return use(std::integral_constant<std::size_t, 2>());
  if (width <= 4) return use(std::integral_constant<std::size_t, 4>());
  if (width <= 8) return use(std::integral_constant<std::size_t, 8>());
  return use(std::integral_constant<std::size_t, max_machine_width>());
}

/// Calls `use` with the machine as a transition system of the right width.
template <class Use>
auto with_system(const CompiledMachine& machine, Use use) {
  return with_width(machine, [&](auto width) { return use(MachineSystem<width()>(machine)); });
}

}  // namespace perentie::semantics

#include "machine/compile.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "machine/leaf.hpp"
#include "machine/livelock.hpp"
#include "machine/rules.hpp"
#include "machine/tables.hpp"

namespace perentie::semantics {
namespace {

// Operators in operators: a bound on recursion; what lies deeper is a leaf.
constexpr std::uint32_t max_depth = 500;

bool is_leaf(const ProcStore& processes, ProcId term, std::uint32_t depth) {
  return depth >= max_depth || !is_compiled_operator(processes.kind(term));
}

class Compiler {
 public:
  Compiler(const MachineParts& parts, const MachineOptions& options)
      : parts_(parts),
        options_(options),
        compression_(options.leaf_compression),
        budget_(options.limits),
        steps_(parts.calls, parts.events, parts.processes, parts.compressions, unheard_),
        builder_(parts.events, parts.processes, options.max_rules) {
    const bool keeps_weak = parts.compressions.preserved <= Preserved::priority;
    if (compression_ == LeafCompression::wbisim && !keeps_weak) {
      compression_ = LeafCompression::sbisim;
    }
  }

  MachineCompilation run(ProcId process) {
    const std::optional<ProcId> root = steps_.state(process);
    if (!root) return give_up();
    // A generalised LTS is a machine of one leaf.
    const bool is_graph =
        options_.generalises && is_generalised(*root, parts_.processes, parts_.compressions);
    if (!is_graph && !is_compiled_operator(parts_.processes.kind(*root))) return give_up();
    find_leaves(*root, 0);
    if (!is_graph && leaf_terms_.size() < options_.min_leaves) return give_up();
    for (const ProcId term : leaf_terms_) {
      if (!leaf_graphs_.contains(term.value) && !add_leaf(term)) return give_up();
    }
    const auto rules = rules_of(*root, 0);
    if (!rules) return give_up();
    std::vector<const LeafGraph*> leaves;
    for (const ProcId term : leaf_terms_) leaves.push_back(&leaf_graphs_.at(term.value));
    auto machine = make_tables(leaves, builder_, *rules, termination_);
    if (!machine) return give_up();
    machine->may_diverge = may_diverge(leaves, builder_, *rules);
    machine->root = *root;
    machine->is_weak = compression_ == LeafCompression::wbisim;
    for (const ProcId term : leaf_terms_) machine->leaf_kinds.push_back(leaf_kinds_.at(term.value));
    machine->leaf_sizes = std::move(leaf_sizes_);
    for (const auto& size : machine->leaf_sizes) {
      machine->states_of_terms.push_back(std::move(leaf_graphs_.at(size.process.value).numbers));
    }
    machine->label_names = parts_.label_names();
    return {std::move(machine), {}};
  }

 private:
  MachineCompilation give_up() const {
    return {std::nullopt, budget_.check_time(), has_large_leaves_};
  }

  void find_leaves(ProcId term, std::uint32_t depth) {
    if (is_leaf(parts_.processes, term, depth)) {
      leaf_terms_.push_back(term);
      return;
    }
    switch (parts_.processes.kind(term)) {
      case ProcKind::hide:
      case ProcKind::project:
      case ProcKind::rename:
        termination_ = std::max(termination_, Termination::passed_on);
        break;
      default:
        termination_ = Termination::joined;
    }
    for (const ProcId operand : parts_.processes.operands(term)) find_leaves(operand, depth + 1);
  }

  bool add_leaf(ProcId term) {
    LeafResult leaf = explore_leaf(steps_, term, options_.max_leaf_states - leaf_states_, budget_);
    if (!leaf.graph) {
      has_large_leaves_ = leaf.failure == LeafFailure::too_many_states;
      return false;
    }
    leaf_states_ += leaf.graph->state_count();
    if (options_.generalises) {
      find_generalised(*leaf.graph, parts_.processes, parts_.compressions);
    }
    LeafSize size{term, leaf.graph->state_count(), leaf.graph->edge_count(), 0, 0};
    if (compression_ != LeafCompression::none && leaf_terms_.size() > 1) {
      leaf.graph = compress_leaf(std::move(*leaf.graph), compression_, budget_.rest());
    }
    size.states = leaf.graph->state_count();
    size.edges = leaf.graph->edge_count();
    leaf_kinds_.emplace(term.value, static_cast<std::uint32_t>(leaf_sizes_.size()));
    leaf_sizes_.push_back(size);
    leaf_graphs_.emplace(term.value, std::move(*leaf.graph));
    return true;
  }

  // The leaves come in the order of `find_leaves`.
  std::optional<RuleBuilder::Rules> rules_of(ProcId term, std::uint32_t depth) {
    if (is_leaf(parts_.processes, term, depth)) {
      std::vector<EventId> events = leaf_graphs_.at(term.value).labels();
      if (termination_ != Termination::of_leaf) std::erase(events, lts::tick);
      return builder_.leaf(next_leaf_++, events);
    }
    std::vector<RuleBuilder::Rules> found;
    for (const ProcId operand : parts_.processes.operands(term)) {
      auto rules = rules_of(operand, depth + 1);
      if (!rules) return std::nullopt;
      found.push_back(std::move(*rules));
    }
    return builder_.combine(term, std::move(found));
  }

  const MachineParts& parts_;
  const MachineOptions& options_;
  LeafCompression compression_;
  base::Budget budget_;
  base::Diagnostics unheard_;  // what leaves report: the step rules say it again if it matters
  StepRules steps_;
  RuleBuilder builder_;
  std::vector<ProcId> leaf_terms_;                               // in order, equal ones repeated
  std::unordered_map<std::uint32_t, LeafGraph> leaf_graphs_;     // by term
  std::unordered_map<std::uint32_t, std::uint32_t> leaf_kinds_;  // by term: of leaf_sizes_
  std::vector<LeafSize> leaf_sizes_;
  std::uint64_t leaf_states_ = 0;  // of all of them
  bool has_large_leaves_ = false;
  Termination termination_ = Termination::of_leaf;
  std::uint32_t next_leaf_ = 0;
};

// Puts the terms of the leaves, one after the other, into the place of those in `term`.
class TermMaker {
 public:
  TermMaker(const CompiledMachine& machine, std::span<const std::uint64_t> state,
            ProcStore& processes)
      : machine_(machine), state_(state), processes_(processes) {}

  ProcId make(ProcId term, std::uint32_t depth) {
    if (is_leaf(processes_, term, depth)) return leaf();
    const auto places = *process_operands(processes_.kind(term));
    const auto stored = processes_.words(term);
    std::vector<std::uint32_t> words(stored.begin(), stored.end());
    for (std::size_t i = places.first; i < words.size(); i += places.stride) {
      words[i] = make(ProcId{words[i]}, depth + 1).value;
    }
    return has_terminated_ ? processes_.stop() : processes_.rebuild(term, words);
  }

 private:
  ProcId leaf() {
    const CompiledMachine::Leaf& leaf = machine_.leaves[next_++];
    const ProcId term = machine_.row_terms[machine_row(leaf, state_)];
    has_terminated_ = !term;  // then all leaves have
    return has_terminated_ ? processes_.stop() : term;
  }

  const CompiledMachine& machine_;
  std::span<const std::uint64_t> state_;
  ProcStore& processes_;
  std::size_t next_ = 0;  // leaf
  bool has_terminated_ = false;
};

// The leaves of a term beside those of the machine's root, one after the other.
class StateMaker {
 public:
  StateMaker(const CompiledMachine& machine, const ProcStore& processes)
      : machine_(machine), processes_(processes), state_(machine.width()) {}

  // False: the term is none of the machine.
  bool add(ProcId root, ProcId term, std::uint32_t depth) {
    if (is_leaf(processes_, root, depth)) return add_leaf(term);
    const std::vector<ProcId> expected = processes_.operands(root);
    const std::vector<ProcId> found = processes_.operands(term);
    if (processes_.kind(root) != processes_.kind(term) || expected.size() != found.size()) {
      return false;
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!add(expected[i], found[i], depth + 1)) return false;
    }
    return true;
  }

  std::vector<std::uint64_t> take() && { return std::move(state_); }

 private:
  bool add_leaf(ProcId term) {
    const auto& states = machine_.states_of_terms[machine_.leaf_kinds[next_]];
    const CompiledMachine::Leaf& leaf = machine_.leaves[next_++];
    const auto found = states.find(term.value);
    if (found == states.end()) return false;
    state_[leaf.word] |= std::uint64_t{found->second} << leaf.shift;
    return true;
  }

  const CompiledMachine& machine_;
  const ProcStore& processes_;
  std::vector<std::uint64_t> state_;
  std::size_t next_ = 0;  // leaf
};

}  // namespace

std::optional<std::vector<std::uint64_t>> machine_state(const CompiledMachine& machine, ProcId term,
                                                        const ProcStore& processes) {
  StateMaker maker(machine, processes);
  if (!maker.add(machine.root, term, 0)) return std::nullopt;
  return std::move(maker).take();
}

ProcId machine_term(const CompiledMachine& machine, std::span<const std::uint64_t> state,
                    ProcStore& processes) {
  return TermMaker(machine, state, processes).make(machine.root, 0);
}

MachineCompilation compile_machine(ProcId process, const MachineParts& parts,
                                   const MachineOptions& options) {
  return Compiler(parts, options).run(process);
}

}  // namespace perentie::semantics

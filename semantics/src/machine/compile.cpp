#include "machine/compile.hpp"

#include <chrono>
#include <unordered_map>
#include <utility>
#include <vector>

#include "machine/rules.hpp"
#include "machine/tables.hpp"
#include "perentie/lts/explore.hpp"

namespace perentie::semantics {
namespace {

// Operators in operators: a bound on recursion; what lies deeper is a leaf.
constexpr std::uint32_t max_depth = 500;

// One leaf as a `lts::TransitionSystem`. Its labels are events, whose names nobody asks a leaf for.
class LeafSystem {
 public:
  using State = ProcId;

  LeafSystem(StepRules& rules, const EventTable& events, ProcId initial)
      : rules_(rules), events_(events), initial_(initial) {}

  State initial() const { return initial_; }
  bool successors(State state, StepRules::Steps& out) { return rules_.successors(state, out); }
  std::uint64_t state_hash(State state) const { return base::hash_mix(0, state.value); }
  std::shared_ptr<const lts::LabelNames> label_names() const {
    auto names = std::make_shared<lts::LabelNames>(events_.size());
    (*names)[lts::tau.value] = lts::tau_name;
    (*names)[lts::tick.value] = lts::tick_name;
    return names;
  }

 private:
  StepRules& rules_;
  const EventTable& events_;
  ProcId initial_;
};

class Compiler {
 public:
  Compiler(const MachineParts& parts, const MachineOptions& options)
      : parts_(parts),
        options_(options),
        budget_(options.limits),
        steps_(parts.calls, parts.events, parts.processes, unheard_),
        builder_(parts.events, parts.processes, options.max_rules) {}

  MachineCompilation run(ProcId process) {
    const std::optional<ProcId> root = steps_.state(process);
    if (!root || !is_compiled_operator(parts_.processes.kind(*root))) return give_up();
    find_leaves(*root, 0);
    if (leaf_terms_.size() < options_.min_leaves) return give_up();
    for (const ProcId term : leaf_terms_) {
      if (!leaf_graphs_.contains(term.value) && !explore_leaf(term)) return give_up();
    }
    const auto rules = rules_of(*root, 0);
    if (!rules) return give_up();
    std::vector<const lts::Lts*> leaves;
    for (const ProcId term : leaf_terms_) leaves.push_back(&leaf_graphs_.at(term.value));
    auto machine = make_tables(leaves, builder_, *rules);
    if (!machine) return give_up();
    machine->label_names = parts_.label_names();
    return {std::move(machine), {}};
  }

 private:
  MachineCompilation give_up() const { return {std::nullopt, budget_.check_time()}; }

  bool is_leaf(ProcId term, std::uint32_t depth) const {
    return depth >= max_depth || !is_compiled_operator(parts_.processes.kind(term));
  }

  std::vector<ProcId> operands(ProcId term) const {
    const auto places = process_operands(parts_.processes.kind(term));
    const auto words = parts_.processes.words(term);
    std::vector<ProcId> found;
    for (std::size_t i = places->first; i < words.size(); i += places->stride) {
      found.push_back(ProcId{words[i]});
    }
    return found;
  }

  void find_leaves(ProcId term, std::uint32_t depth) {
    if (is_leaf(term, depth)) {
      leaf_terms_.push_back(term);
      return;
    }
    for (const ProcId operand : operands(term)) find_leaves(operand, depth + 1);
  }

  bool explore_leaf(ProcId term) {
    base::Limits limits = options_.limits;
    limits.max_states =
        std::min(options_.max_leaf_states, limits.max_states.value_or(options_.max_leaf_states));
    if (limits.timeout) {
      const auto used =
          std::chrono::milliseconds(static_cast<std::int64_t>(budget_.elapsed_seconds() * 1000.0));
      limits.timeout = std::max(*limits.timeout - used, std::chrono::milliseconds(1));
    }
    LeafSystem system(steps_, parts_.events, term);
    auto exploration = lts::explore(system, {.limits = limits, .progress = {}});
    if (!exploration.complete()) return false;
    leaf_graphs_.emplace(term.value, std::move(exploration.lts));
    return true;
  }

  // The leaves come in the order of `find_leaves`.
  std::optional<RuleBuilder::Rules> rules_of(ProcId term, std::uint32_t depth) {
    if (is_leaf(term, depth)) {
      std::vector<EventId> events = leaf_graphs_.at(term.value).alphabet();
      events.insert(events.begin(), lts::tau);
      return builder_.leaf(next_leaf_++, events);
    }
    std::vector<RuleBuilder::Rules> found;
    for (const ProcId operand : operands(term)) {
      auto rules = rules_of(operand, depth + 1);
      if (!rules) return std::nullopt;
      found.push_back(std::move(*rules));
    }
    return builder_.combine(term, std::move(found));
  }

  const MachineParts& parts_;
  const MachineOptions& options_;
  base::Budget budget_;
  base::Diagnostics unheard_;  // what leaves report: the step rules say it again if it matters
  StepRules steps_;
  RuleBuilder builder_;
  std::vector<ProcId> leaf_terms_;                           // in order, equal ones repeated
  std::unordered_map<std::uint32_t, lts::Lts> leaf_graphs_;  // by term
  std::uint32_t next_leaf_ = 0;
};

}  // namespace

MachineCompilation compile_machine(ProcId process, const MachineParts& parts,
                                   const MachineOptions& options) {
  return Compiler(parts, options).run(process);
}

}  // namespace perentie::semantics

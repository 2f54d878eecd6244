#include "machine/tables.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <utility>

namespace perentie::semantics {
namespace {

constexpr std::uint32_t word_bits = 64;
// Offsets into the tables are 32 bits wide.
constexpr std::size_t max_entries = std::numeric_limits<std::uint32_t>::max();

// By label: how many states of a leaf have an edge with it.
std::vector<std::uint32_t> states_by_label(const LeafGraph& leaf) {
  std::vector<std::uint32_t> counts;
  std::vector<std::uint32_t> last_state;  // by label: that was counted, and one
  for (std::uint32_t s = 0; s < leaf.state_count(); ++s) {
    for (const lts::Edge& edge : leaf.edges(s)) {
      const std::uint32_t label = edge.label.value;
      if (label >= counts.size()) {
        counts.resize(label + 1);
        last_state.resize(label + 1);
      }
      if (last_state[label] == s + 1) continue;
      last_state[label] = s + 1;
      ++counts[label];
    }
  }
  return counts;
}

class TableMaker {
 public:
  TableMaker(const std::vector<const LeafGraph*>& leaves, const RuleBuilder& builder,
             Termination termination)
      : leaves_(leaves), builder_(builder), termination_(termination), plans_(leaves.size()) {}

  std::optional<CompiledMachine> make(const RuleBuilder::Rules& rules) {
    for (const LeafGraph* leaf : leaves_) {
      if (!counts_.contains(leaf)) counts_.emplace(leaf, states_by_label(*leaf));
    }
    terminates_ = termination_ != Termination::of_leaf &&
                  std::all_of(leaves_.begin(), leaves_.end(), [&](const LeafGraph* leaf) {
                    const auto& counts = counts_.at(leaf);
                    return counts.size() > lts::tick.value && counts[lts::tick.value] > 0;
                  });
    if (!place_leaves()) return std::nullopt;
    for (const SyncRule& rule : rules) plan(rule.event, builder_.parts(rule));
    if (terminates_) {
      std::vector<RulePart> all;
      for (std::uint32_t l = 0; l < leaves_.size(); ++l) all.push_back({l, lts::tick});
      plan(lts::tick, all);
    }
    add_rules();
    if (!add_rows()) return std::nullopt;
    return std::move(machine_);
  }

 private:
  struct PlannedRule {
    EventId event;
    std::vector<RulePart> partners;
  };
  struct RuleRun {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
  };
  // What a leaf is needed for, by its events.
  struct LeafPlan {
    std::map<EventId, std::vector<PlannedRule>> led;
    std::map<EventId, RuleRun> runs;  // of `led`, once the rules have numbers
    std::map<EventId, std::uint32_t> ports;
  };

  // A leaf's terminated state is the one after its own.
  std::uint32_t state_count(std::size_t leaf) const {
    return leaves_[leaf]->state_count() + (terminates_ ? 1 : 0);
  }

  bool place_leaves() {
    std::uint32_t word = 0;
    std::uint32_t used = 0;
    std::uint64_t row = 0;
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
      const auto bits = static_cast<std::uint32_t>(std::bit_width(state_count(l) - 1));
      if (used + bits > word_bits) {
        ++word;
        used = 0;
      }
      if (word >= max_machine_width) return false;
      machine_.initial.resize(word + 1);
      // A leaf of no bits may come after a full word.
      const std::uint32_t shift = bits == 0 ? 0 : used;
      machine_.leaves.push_back(
          {word, shift, (std::uint64_t{1} << bits) - 1, static_cast<std::uint32_t>(row)});
      used += bits;
      row += state_count(l);
      if (row >= max_entries) return false;
    }
    return true;
  }

  // How much of a leaf's states can take a part, in parts of 2^32.
  std::uint64_t share(const RulePart& part) const {
    const auto& counts = counts_.at(leaves_[part.leaf]);
    const std::uint64_t having = part.event.value < counts.size() ? counts[part.event.value] : 0;
    return (having << 32U) / leaves_[part.leaf]->state_count();
  }

  void plan(EventId event, std::span<const RulePart> parts) {
    std::vector<RulePart> order(parts.begin(), parts.end());
    std::stable_sort(order.begin(), order.end(),
                     [&](const RulePart& a, const RulePart& b) { return share(a) < share(b); });
    const RulePart leader = order.front();
    order.erase(order.begin());
    for (const RulePart& partner : order) {
      auto& ports = plans_[partner.leaf].ports;
      ports.emplace(partner.event, static_cast<std::uint32_t>(ports.size()));
    }
    plans_[leader.leaf].led[leader.event].push_back({event, std::move(order)});
  }

  // The rules that a leaf leads with one event are neighbours.
  void add_rules() {
    for (LeafPlan& plan : plans_) {
      for (const auto& [own, rules] : plan.led) {
        RuleRun& run = plan.runs[own];
        run.first = static_cast<std::uint32_t>(machine_.rules.size());
        for (const PlannedRule& rule : rules) {
          const auto first = static_cast<std::uint32_t>(machine_.partners.size());
          for (const RulePart& p : rule.partners) {
            machine_.partners.push_back({p.leaf, plans_[p.leaf].ports.at(p.event)});
          }
          const auto end = static_cast<std::uint32_t>(machine_.partners.size());
          machine_.rules.push_back({rule.event, first, end});
        }
        run.end = static_cast<std::uint32_t>(machine_.rules.size());
      }
    }
  }

  bool add_rows() {
    const bool has_choices = std::ranges::any_of(leaves_, &LeafGraph::is_generalised);
    for (std::uint32_t l = 0; l < leaves_.size(); ++l) {
      if (!plans_[l].led.empty()) machine_.leaders.push_back(l);
      for (std::uint32_t s = 0; s < state_count(l); ++s) {
        begin_row();
        machine_.row_terms.push_back(s < leaves_[l]->state_count() ? leaves_[l]->states[s]
                                                                   : ProcId{});
        if (has_choices) begin_choices();
        if (s < leaves_[l]->state_count()) add_row(l, s);
        if (std::max(machine_.leads.size(), machine_.follows.size()) > max_entries) return false;
      }
    }
    begin_row();
    if (has_choices) begin_choices();
    return true;
  }

  void begin_choices() {
    machine_.first_choice.push_back(static_cast<std::uint32_t>(machine_.choices.size()));
  }

  void begin_row() {
    machine_.rows.push_back({static_cast<std::uint32_t>(machine_.leads.size()),
                             static_cast<std::uint32_t>(machine_.follows.size()), 0});
  }

  void add_row(std::uint32_t l, std::uint32_t state) {
    const LeafPlan& plan = plans_[l];
    const std::size_t first_follow = machine_.follows.size();
    const auto omega = leaves_[l]->state_count();
    const bool joins = termination_ == Termination::joined;
    bool has_ticked = false;
    for (const lts::Edge& edge : leaves_[l]->edges(state)) {
      // Parallel operators terminate once, in however many ways their operands do.
      if (edge.label == lts::tick && joins && std::exchange(has_ticked, true)) continue;
      const std::uint32_t target =
          edge.label == lts::tick && terminates_ ? omega : edge.target.value;
      const std::uint64_t change = std::uint64_t{state ^ target} << machine_.leaves[l].shift;
      if (leaves_[l]->is_choice(state, edge)) {
        machine_.choices.push_back(change);
        continue;
      }
      if (const auto run = plan.runs.find(edge.label); run != plan.runs.end()) {
        machine_.leads.push_back({change, run->second.first, run->second.end});
      }
      if (const auto port = plan.ports.find(edge.label); port != plan.ports.end()) {
        machine_.follows.push_back({change, port->second});
        machine_.rows.back().ports |= std::uint64_t{1} << (port->second % 64);
      }
    }
    std::stable_sort(machine_.follows.begin() + static_cast<std::ptrdiff_t>(first_follow),
                     machine_.follows.end(),
                     [](const auto& a, const auto& b) { return a.port < b.port; });
  }

  const std::vector<const LeafGraph*>& leaves_;
  const RuleBuilder& builder_;
  Termination termination_;
  std::vector<LeafPlan> plans_;                                    // by leaf
  std::map<const LeafGraph*, std::vector<std::uint32_t>> counts_;  // by label
  bool terminates_ = false;
  CompiledMachine machine_;
};

}  // namespace

std::optional<CompiledMachine> make_tables(const std::vector<const LeafGraph*>& leaves,
                                           const RuleBuilder& builder,
                                           const RuleBuilder::Rules& rules,
                                           Termination termination) {
  return TableMaker(leaves, builder, termination).make(rules);
}

std::uint64_t CompiledMachine::memory_bytes() const {
  const auto bytes = [](const auto& vector) { return vector.capacity() * sizeof(vector[0]); };
  return bytes(leaves) + bytes(leaders) + bytes(rows) + bytes(leads) + bytes(follows) +
         bytes(rules) + bytes(partners) + bytes(choices) + bytes(first_choice) + bytes(row_terms);
}

}  // namespace perentie::semantics

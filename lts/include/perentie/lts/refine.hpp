// refine: does everything that an implementation does lie within a specification?
//
// Breadth first over pairs of a node of the specification and a state of the implementation, level
// by level, so the counterexample is a shortest one, counting τ, and the same on every run (CSPM
// reference 5.2). The implementation is computed on the fly. Counts are those that FDR reports
// (6.3). A budget that runs out leaves the question open.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "perentie/base/check.hpp"
#include "perentie/base/growing_array.hpp"
#include "perentie/base/hash.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/base/unique_index.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/lts/memory.hpp"
#include "perentie/lts/runs.hpp"
#include "perentie/lts/specifications.hpp"
#include "perentie/lts/successor_block.hpp"
#include "perentie/lts/visited_states.hpp"
#include "perentie/lts/watch.hpp"

namespace perentie::lts {

/// Traces; stable failures; failures-divergences (CSPM reference 5.1).
enum class SemanticModel : std::uint8_t { traces, failures, failures_divergences };

struct RefineCounts {
  std::uint64_t states = 0;       ///< pairs visited, all those of the last level among them
  std::uint64_t transitions = 1;  ///< of these pairs, and one
  std::uint64_t plys = 0;         ///< levels completed
};

/// Why an implementation is no refinement.
template <class S>
struct Counterexample {
  enum class Kind : std::uint8_t { event, acceptance, divergence };

  Kind kind;
  std::vector<Label> trace;  ///< with τ
  /// Those passed, the initial one first: one more than the trace, and, where the last one is that
  /// of a generalised system, the stable state that it may be.
  std::vector<S> states;
  Label event = {};              ///< of kind `event`: performed after the trace
  std::vector<Label> offered{};  ///< of kind `acceptance`: what is offered, ascending
  State node = {};               ///< of the specification, after the trace
};

template <class S>
struct RefineResult {
  RefineCounts counts;
  std::optional<Counterexample<S>> counterexample;  ///< none, and complete: it holds
  std::optional<base::LimitReached> limit;
  bool failed = false;  ///< the system could not compute a state's transitions and reported why

  bool complete() const { return !limit && !failed; }
};

template <TransitionSystem System, class Specification>
class RefinementSearch {
 public:
  using S = typename System::State;

  RefinementSearch(System& system, const Specification& specification, SemanticModel model,
                   const ExploreOptions& options)
      : system_(system),
        specification_(specification),
        model_(model),
        options_(options),
        max_pairs_(options.limits.max_states.value_or(State::none_value)),
        watch_(options.limits),
        states_(system),
        block_(system, states_, options.limits.workers),
        ahead_(system, states_, 1) {
    if constexpr (requires { system.may_diverge(); }) {
      looks_for_divergence_ = looks_for_divergence_ && system.may_diverge();
    }
  }

  RefineResult<S> run() && {
    states_.add(system_.initial());
    add({State{0}, State{0}}, 0, {});
    std::size_t level_end = 1;
    while (visited_ < pairs_.size() && goes_on()) {
      if (visited_ == level_end) {
        // The level of a counterexample is counted to its end, deeper ones are not.
        if (result_.counterexample) return finish(level_end);
        ++result_.counts.plys;
        level_end = pairs_.size();
      }
      visit_block(level_end);
    }
    if (!result_.counterexample && goes_on()) ++result_.counts.plys;
    return finish(result_.counterexample ? level_end : pairs_.size());
  }

 private:
  struct Pair {
    State node;
    State state;

    friend bool operator==(const Pair&, const Pair&) = default;
  };
  struct Arrival {
    std::uint32_t from;
    Label label;
  };
  enum class Divergence : std::uint8_t { unknown, open, no, yes };

  bool goes_on() const { return !result_.limit && !result_.failed; }

  RefineResult<S> finish(std::size_t visited) {
    result_.counts.states = visited;
    return std::move(result_);
  }

  void add(Pair pair, std::uint32_t from, Label label) {
    if (!is_new(pair)) return;
    pairs_.push_back(pair);
    arrivals_.push_back({from, label});
    if (pairs_.size() > max_pairs_) {
      result_.limit = base::LimitReached{base::LimitKind::states, max_pairs_};
    }
  }

  // Remembers the pair. Most states are met with one node only, so that one lies beside the state;
  // others are looked up. As long as there is one node, not even that is needed.
  bool is_new(Pair pair) {
    if (have_same_numbers_) {
      if (pair.node == State{0}) {
        PERENTIE_CHECK(pair.state.value <= pairs_.size(), "a state is met before its number is");
        return pair.state.value == pairs_.size();
      }
      part_numbers();
    }
    if (first_node_.size() <= pair.state.value) first_node_.resize(states_.size());
    State& first = first_node_[pair.state.value];
    if (first == pair.node) return false;
    if (!first) {
      first = pair.node;
      return true;
    }
    const std::uint64_t hash =
        base::hash_mix(0, (std::uint64_t{pair.node.value} << 32U) | pair.state.value);
    const auto further = static_cast<std::uint32_t>(further_pairs_.size());
    const auto is_pair = [&](std::uint32_t other) { return further_pairs_[other] == pair; };
    if (!further_index_.find_or_insert(hash, further, is_pair).inserted) return false;
    further_pairs_.push_back(pair);
    return true;
  }

  // From now on pairs may be met in another order than their states.
  void part_numbers() {
    have_same_numbers_ = false;
    first_node_.resize(pairs_.size(), State{0});
  }

  using Row = typename SuccessorBlock<System>::Row;

  // Numbers the targets of a block. False if there are too many states.
  bool number_targets(SuccessorBlock<System>& block) {
    const bool done = block.number_targets();
    if (!done) result_.limit = base::LimitReached{base::LimitKind::states, State::none_value};
    return done;
  }

  // Looks at the clock and at the memory now and then.
  bool is_within_budget() {
    if (!watch_.due()) return true;
    result_.limit = watch_.look();
    if (!result_.limit) {
      std::uint64_t bytes = states_.peak_bytes(1) + lts::peak_bytes(pairs_, 1) +
                            lts::peak_bytes(arrivals_, 1) + lts::peak_bytes(first_node_, 1) +
                            lts::peak_bytes(further_pairs_, 1) + further_index_.peak_bytes(1) +
                            lts::peak_bytes(divergence_, 1) + lts::peak_bytes(row_of_, 1) +
                            rows_.peak_bytes(0);
      if constexpr (requires { system_.memory_bytes(); }) bytes += system_.memory_bytes();
      result_.limit = watch_.budget().check_memory(bytes);
      if (options_.progress && watch_.report_due()) {
        options_.progress({std::max(pairs_.size(), rows_.size()), result_.counts.transitions,
                           result_.counts.plys, pairs_.size() - visited_, bytes,
                           watch_.budget().elapsed_seconds()});
      }
    }
    return !result_.limit;
  }

  // Visits pairs of this level.
  void visit_block(std::size_t level_end) {
    const std::size_t first = visited_;
    block_.compute(
        block_.size(level_end - first),
        [&](std::size_t i) {
          const State state = pairs_[first + i].state;
          return has_row(state) ? State{} : state;
        },
        [&] { return is_within_budget(); });
    if (result_.limit) return;
    if (!result_.counterexample && !number_targets(block_)) return;
    fetch(first);
    block_.for_each_row([&](const Row& row) {
      visit(row);
      return goes_on();
    });
    if (goes_on()) result_.failed = block_.failed();
  }

  // Begins to fetch what visits of the pairs of the block, the first of which is given, will read.
  void fetch(std::size_t first) {
    if (have_same_numbers_) return;  // no row is known, and no node will be looked up
    const auto fetch_nodes = [&](std::span<const Edge> edges) {
      for (const Edge& edge : edges) {
        if (edge.target.value >= first_node_.size()) continue;
        __builtin_prefetch(&first_node_[edge.target.value]);
      }
    };
    known_rows_.clear();
    block_.for_each_row([&](const Row& row) {
      fetch_nodes(row.edges);
      const State state = pairs_[first++].state;
      if (!has_row(state)) return true;
      known_rows_.push_back(rows_[row_of_[state.value]]);
      __builtin_prefetch(known_rows_.back().data());
      return true;
    });
    for (const std::span<const Edge> row : known_rows_) fetch_nodes(row);
  }

  // The next pair, which has this row if that of its state is not known.
  void visit(const Row& row) {
    const std::size_t p = visited_++;
    const auto [node, state] = pairs_[p];
    const bool is_known = has_row(state);
    edges_ = is_known ? rows_[row_of_[state.value]] : row.edges;
    result_.counts.transitions += is_known ? edges_.size() : row.size;
    if (result_.counterexample) return;  // only counted
    const bool divergences = model_ == SemanticModel::failures_divergences;
    // After a divergence of the specification everything is allowed (5.2.3).
    if (divergences && specification_.allows_divergence(node)) return;
    if (const auto error = follow(node)) {
      refute(Counterexample<S>::Kind::event, p).event = *error;
      return;
    }
    if (model_ != SemanticModel::traces && refutes_failures(p)) return;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      add({nodes_[i], edges_[i].target}, static_cast<std::uint32_t>(p), edges_[i].label);
      if (result_.limit) return;
    }
  }

  // Finds the nodes that labels lead to, or the first label that leads to none.
  std::optional<Label> follow(State node) {
    nodes_.clear();
    for (const Edge& edge : edges_) {
      const State next = edge.label == tau ? node : specification_.next(node, edge.label);
      if (!next) return edge.label;
      nodes_.push_back(next);
    }
    return std::nullopt;
  }

  // Whether the pair is a counterexample by an acceptance or a divergence, or a limit was reached.
  bool refutes_failures(std::size_t p) {
    using Kind = typename Counterexample<S>::Kind;
    const Pair pair = pairs_[p];
    offered_.clear();
    for (const Edge& edge : edges_) offered_.push_back(edge.label);
    std::ranges::sort(offered_);
    const bool is_stable = offered_.empty() || offered_.front() != tau;
    if (is_generalised(pair.state)) {
      if (refutes_stable_states(p)) return true;
    } else if (is_stable) {
      offered_.erase(std::unique(offered_.begin(), offered_.end()), offered_.end());
      if (specification_.accepts(pair.node, offered_)) return false;
      refute(Kind::acceptance, p).offered = offered_;
      return true;
    }
    if (is_stable || !looks_for_divergence_) return false;
    const bool is_divergent = diverges(pair.state);
    if (is_divergent) refute(Kind::divergence, p);
    return is_divergent || !goes_on();
  }

  bool is_generalised(State state) const {
    if constexpr (GeneralisedSystem<System>) {
      return system_.is_generalised(states_[state.value]);
    } else {
      return false;
    }
  }

  // The same for the acceptances of a generalised state.
  bool refutes_stable_states(std::size_t p) {
    if constexpr (GeneralisedSystem<System>) {
      const S state = states_[pairs_[p].state.value];
      system_.for_each_stable(state, [&](const S& stable, const std::vector<Label>& offered) {
        if (!is_within_budget()) return false;
        if (specification_.accepts(pairs_[p].node, offered)) return true;
        auto& found = refute(Counterexample<S>::Kind::acceptance, p);
        found.offered = offered;
        found.states.push_back(stable);
        return false;
      });
    }
    return result_.counterexample || !goes_on();
  }

  Counterexample<S>& refute(typename Counterexample<S>::Kind kind, std::size_t p) {
    Counterexample<S> found{.kind = kind, .trace = {}, .states = {}, .node = pairs_[p].node};
    found.states.push_back(states_[pairs_[p].state.value]);
    while (p != 0) {
      found.trace.push_back(arrivals_[p].label);
      p = arrivals_[p].from;
      found.states.push_back(states_[pairs_[p].state.value]);
    }
    std::ranges::reverse(found.trace);
    std::ranges::reverse(found.states);
    return result_.counterexample.emplace(std::move(found));
  }

  // --- Divergence: whether τ leads from a state to a cycle of τ (5.2.11) -----------------------

  struct Step {
    State state;
    std::size_t first_target;  // of `tau_targets_`: those that are left to be followed end there
  };

  // A depth-first search that remembers.
  bool diverges(State start) {
    if (divergence_of(start) != Divergence::unknown) return divergence_of(start) == Divergence::yes;
    enter(start, edges_);
    while (!path_.empty()) {
      if (tau_targets_.size() == path_.back().first_target) {
        divergence_[path_.back().state.value] = Divergence::no;
        path_.pop_back();
        continue;
      }
      const State target = tau_targets_.back();
      tau_targets_.pop_back();
      switch (divergence_of(target)) {
        case Divergence::no:
          break;
        case Divergence::unknown:
          if (!has_row(target) && !compute_rows(target)) return false;
          enter(target, rows_[row_of_[target.value]]);
          break;
        case Divergence::open:
        case Divergence::yes:
          for (const Step& step : path_) divergence_[step.state.value] = Divergence::yes;
          path_.clear();
          tau_targets_.clear();
          return true;
      }
    }
    return false;
  }

  Divergence divergence_of(State state) const {
    return state.value < divergence_.size() ? divergence_[state.value] : Divergence::unknown;
  }

  // Puts a state on the path.
  void enter(State state, std::span<const Edge> edges) {
    path_.push_back({state, tau_targets_.size()});
    for (const Edge& edge : edges) {
      if (edge.label == tau) tau_targets_.push_back(edge.target);
    }
    if (divergence_.size() < states_.size()) {
      divergence_.resize(states_.size(), Divergence::unknown);
    }
    divergence_[state.value] = Divergence::open;
  }

  bool has_row(State state) const {
    return state.value < row_of_.size() && row_of_[state.value] != no_row;
  }

  // What is computed here before its state is visited is kept for the visit. The targets that will
  // be entered next, unless there is a divergence, come along: their look-ups can wait for memory
  // at the same time. Not so where a computation may fail.
  bool compute_rows(State state) {
    if (!is_within_budget()) return false;
    if (rows_.size() >= max_pairs_) {  // each would be a pair, too
      result_.limit = base::LimitReached{base::LimitKind::states, max_pairs_};
      return false;
    }
    states_ahead_.clear();
    plan_row(state);
    if constexpr (SharedTransitionSystem<System>) {
      for (std::size_t i = path_.back().first_target; i < tau_targets_.size(); ++i) {
        const State next = tau_targets_[i];
        if (!has_row(next) && divergence_of(next) == Divergence::unknown) plan_row(next);
      }
    }
    ahead_.compute(
        states_ahead_.size(), [&](std::size_t i) { return states_ahead_[i]; }, [] { return true; });
    result_.failed = ahead_.failed();
    if (have_same_numbers_) part_numbers();
    if (result_.failed || !number_targets(ahead_)) return false;
    const std::size_t first_row = rows_.size();
    ahead_.for_each_row([&](const Row& row) {
      rows_.add(row.edges);
      return true;
    });
    for (std::size_t i = rows_.size() - first_row; i < states_ahead_.size(); ++i) {
      row_of_[states_ahead_[i].value] = no_row;  // the block has ended early
    }
    return true;
  }

  void plan_row(State state) {
    if (row_of_.size() < states_.size()) row_of_.resize(states_.size(), no_row);
    row_of_[state.value] = static_cast<std::uint32_t>(rows_.size() + states_ahead_.size());
    states_ahead_.push_back(state);
  }

  static constexpr std::uint32_t no_row = State::none_value;

  System& system_;
  const Specification& specification_;
  SemanticModel model_;
  bool looks_for_divergence_ = model_ == SemanticModel::failures_divergences;
  const ExploreOptions& options_;
  std::uint64_t max_pairs_;
  Watch watch_;
  VisitedStates<System> states_;
  base::GrowingArray<Pair> pairs_;        // the queue, too
  base::GrowingArray<Arrival> arrivals_;  // by pair
  // Whether each state was met with node 0 only, and pairs have the numbers of their states.
  bool have_same_numbers_ = true;
  base::GrowingArray<State> first_node_;    // by state: of the first pair with it, if there is one
  base::GrowingArray<Pair> further_pairs_;  // the others
  base::UniqueIndex further_index_;         // of these
  std::size_t visited_ = 0;                 // pairs

  SuccessorBlock<System> block_;  // of the pairs in work
  std::span<const Edge> edges_;   // of the pair in work
  std::vector<State> nodes_;      // that these lead to
  std::vector<Label> offered_;    // by the pair in work

  base::GrowingArray<Divergence> divergence_;  // by state
  std::vector<Step> path_;
  std::vector<State> tau_targets_;
  Runs<Edge> rows_;                                // of states that a search has passed
  base::GrowingArray<std::uint32_t> row_of_;       // by state
  std::vector<std::span<const Edge>> known_rows_;  // of a block
  std::vector<State> states_ahead_;                // whose rows a search computes
  SuccessorBlock<System> ahead_;                   // of the state in work of a search

  RefineResult<S> result_;
};

/// Whether `system` refines the specification in a model. `max_states` counts pairs.
template <TransitionSystem System, class Specification>
RefineResult<typename System::State> refine(const Specification& specification, System& system,
                                            SemanticModel model,
                                            const ExploreOptions& options = {}) {
  return RefinementSearch<System, Specification>(system, specification, model, options).run();
}

}  // namespace perentie::lts

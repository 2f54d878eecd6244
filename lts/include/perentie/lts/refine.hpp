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
#include <utility>
#include <vector>

#include "perentie/base/hash.hpp"
#include "perentie/base/limits.hpp"
#include "perentie/base/unique_index.hpp"
#include "perentie/lts/explore.hpp"
#include "perentie/lts/lazy_graph.hpp"
#include "perentie/lts/specifications.hpp"
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
  std::vector<Label> trace;      ///< with τ
  std::vector<S> states;         ///< those passed, the initial one first: one more than the trace
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
      : graph_(system),
        specification_(specification),
        model_(model),
        options_(options),
        watch_(options.limits) {}

  RefineResult<S> run() && {
    add({State{0}, graph_.initial()}, 0, {});
    std::size_t level_end = 1;
    for (std::size_t p = 0; p < pairs_.size() && goes_on(); ++p) {
      if (p == level_end) {
        // The level of a counterexample is counted to its end, deeper ones are not.
        if (result_.counterexample) return finish(level_end);
        ++result_.counts.plys;
        level_end = pairs_.size();
      }
      visit(p);
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
    const auto hash = [](const Pair& p) {
      return base::hash_mix(0, (std::uint64_t{p.node.value} << 32U) | p.state.value);
    };
    const auto number = static_cast<std::uint32_t>(pairs_.size());
    const auto [found, inserted] = index_.find_or_insert(
        hash(pair), number, [&](std::uint32_t other) { return pairs_[other] == pair; },
        [&](std::uint32_t other) { return hash(pairs_[other]); });
    if (!inserted) return;
    pairs_.push_back(pair);
    arrivals_.push_back({from, label});
  }

  // Looks at the budgets: now and then at the clock, and at the number of pairs.
  bool is_within_budget() {
    if (options_.limits.max_states && pairs_.size() > *options_.limits.max_states) {
      result_.limit = base::LimitReached{base::LimitKind::states, *options_.limits.max_states};
      return false;
    }
    if (!watch_.due()) return true;
    result_.limit = watch_.look();
    if (!result_.limit) {
      const std::uint64_t bytes = graph_.peak_bytes() + lts::peak_bytes(pairs_, 1) +
                                  lts::peak_bytes(arrivals_, 1) + lts::peak_bytes(index_, 1);
      result_.limit = watch_.budget().check_memory(bytes);
      report(bytes);
    }
    return !result_.limit;
  }

  void report(std::uint64_t bytes) {
    constexpr double seconds_between_reports = 0.1;
    const double now = watch_.budget().elapsed_seconds();
    if (!options_.progress || now - last_report_ < seconds_between_reports) return;
    last_report_ = now;
    options_.progress({pairs_.size(), result_.counts.transitions, result_.counts.plys,
                       pairs_.size() - visited_, bytes, now});
  }

  void visit(std::size_t p) {
    if (!is_within_budget()) return;
    visited_ = p + 1;
    const Pair pair = pairs_[p];
    const auto row = graph_.row(pair.state);
    if (!row) {
      result_.failed = true;
      return;
    }
    const std::vector<Edge> edges(row->begin(), row->end());
    result_.counts.transitions += edges.size();
    if (result_.counterexample) return;  // only counted
    const bool divergences = model_ == SemanticModel::failures_divergences;
    // After a divergence of the specification everything is allowed (5.2.3).
    if (divergences && specification_.allows_divergence(pair.node)) return;
    if (check(p, edges) || !goes_on()) return;
    for (const Edge& edge : edges) {
      const State node =
          edge.label == tau ? pair.node : *specification_.next(pair.node, edge.label);
      add({node, edge.target}, static_cast<std::uint32_t>(p), edge.label);
    }
  }

  // Whether the pair is a counterexample: by an event, an acceptance, a divergence, in this order.
  bool check(std::size_t p, const std::vector<Edge>& edges) {
    using Kind = typename Counterexample<S>::Kind;
    const Pair pair = pairs_[p];
    bool stable = true;
    std::vector<Label> offered;
    for (const Edge& edge : edges) {
      if (edge.label == tau) {
        stable = false;
      } else if (!specification_.next(pair.node, edge.label)) {
        refute(Kind::event, p).event = edge.label;
        return true;
      } else {
        offered.push_back(edge.label);
      }
    }
    if (model_ == SemanticModel::traces) return false;
    if (stable) {
      std::ranges::sort(offered);
      offered.erase(std::unique(offered.begin(), offered.end()), offered.end());
      if (specification_.accepts(pair.node, offered)) return false;
      refute(Kind::acceptance, p).offered = std::move(offered);
      return true;
    }
    if (model_ == SemanticModel::failures || !diverges(pair.state)) return false;
    refute(Kind::divergence, p);
    return true;
  }

  Counterexample<S>& refute(typename Counterexample<S>::Kind kind, std::size_t p) {
    Counterexample<S> found{.kind = kind, .trace = {}, .states = {}, .node = pairs_[p].node};
    found.states.push_back(graph_.state(pairs_[p].state));
    while (p != 0) {
      found.trace.push_back(arrivals_[p].label);
      p = arrivals_[p].from;
      found.states.push_back(graph_.state(pairs_[p].state));
    }
    std::ranges::reverse(found.trace);
    std::ranges::reverse(found.states);
    return result_.counterexample.emplace(std::move(found));
  }

  // Whether τ leads from a state to a cycle of τ: a depth-first search that remembers (5.2.11).
  bool diverges(State start) {
    struct Step {
      State state;
      std::size_t next;  // of its row
    };
    std::vector<Step> path;
    const auto enter = [&](State state) {
      if (divergence_.size() < graph_.size()) {
        divergence_.resize(graph_.size(), Divergence::unknown);
      }
      divergence_[state.value] = Divergence::open;
      path.push_back({state, 0});
    };
    if (start.value < divergence_.size() && divergence_[start.value] != Divergence::unknown) {
      return divergence_[start.value] == Divergence::yes;
    }
    enter(start);
    while (!path.empty()) {
      if (watch_.due()) result_.limit = watch_.look();
      const auto row = result_.limit ? std::nullopt : graph_.row(path.back().state);
      if (!row) {
        result_.failed = !result_.limit;
        for (const Step& step : path) divergence_[step.state.value] = Divergence::unknown;
        return false;
      }
      std::size_t& next = path.back().next;
      while (next < row->size() && (*row)[next].label != tau) ++next;
      if (next == row->size()) {
        divergence_[path.back().state.value] = Divergence::no;
        path.pop_back();
        continue;
      }
      const State target = (*row)[next++].target;
      const Divergence known =
          target.value < divergence_.size() ? divergence_[target.value] : Divergence::unknown;
      if (known == Divergence::no) continue;
      if (known == Divergence::unknown) {
        enter(target);
        continue;
      }
      for (const Step& step : path) divergence_[step.state.value] = Divergence::yes;
      return true;
    }
    return false;
  }

  LazyGraph<System> graph_;
  const Specification& specification_;
  SemanticModel model_;
  const ExploreOptions& options_;
  Watch watch_;
  std::vector<Pair> pairs_;             // the queue, too
  std::vector<Arrival> arrivals_;       // by pair
  base::UniqueIndex index_;             // of pairs
  std::vector<Divergence> divergence_;  // by state
  std::size_t visited_ = 0;
  double last_report_ = 0;
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

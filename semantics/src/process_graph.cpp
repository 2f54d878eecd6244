#include "perentie/semantics/process_graph.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "perentie/lts/count.hpp"
#include "perentie/semantics/process_system.hpp"

namespace perentie::semantics {
namespace {

// A generalised system as one whose transitions say everything: τ leads to the stable states that a
// state may be.
template <class System>
class PlainSystem {
 public:
  using State = typename System::State;

  explicit PlainSystem(System& system) : system_(system) {}

  State initial() const { return system_.initial(); }
  bool successors(const State& state, std::vector<lts::Transition<State>>& out) const {
    const bool done = std::as_const(system_).successors(state, out);
    if (done && system_.is_generalised(state)) {
      system_.for_each_stable(state, [&](const State& stable, const auto&) {
        out.push_back({lts::tau, stable});
        return true;
      });
    }
    return done;
  }
  std::uint64_t state_hash(const State& state) const { return system_.state_hash(state); }
  std::shared_ptr<const lts::LabelNames> label_names() const { return system_.label_names(); }
  std::uint64_t memory_bytes() const { return system_.memory_bytes(); }

 private:
  System& system_;
};

// Calls `use` with a system whose transitions say everything.
template <class System, class Use>
auto with_plain_system(System& system, Use use) {
  if constexpr (lts::GeneralisedSystem<System>) {
    if (system.structure().is_generalised) {
      PlainSystem<System> plain(system);
      return use(plain);
    }
  }
  return use(system);
}

// The terms are asked for when the search is over: what they are made from is kept.
template <class System>
std::function<ProcId(lts::State)> terms_of(System& system,
                                           std::vector<typename System::State> states) {
  const auto kept = std::make_shared<const System>(std::move(system));
  return [kept, states = std::move(states)](lts::State s) { return kept->term(states[s.value]); };
}

}  // namespace

ProcessSize count_process(Script& script, ProcId process, const lts::ExploreOptions& options,
                          base::Diagnostics& diagnostics) {
  auto result = with_process_system(
      script, process, options, diagnostics, [](auto& system, const lts::ExploreOptions& bounds) {
        const lts::Count found =
            with_plain_system(system, [&](auto& plain) { return lts::count(plain, bounds); });
        return ProcessSize{found.states, found.transitions, system.structure(), found.failed,
                           found.limit ? found.limit : system.limit()};
      });
  report_growth(script, result.limit, diagnostics);
  return result;
}

ProcessExploration explore_process(Script& script, ProcId process,
                                   const lts::ExploreOptions& options,
                                   base::Diagnostics& diagnostics) {
  auto result = with_process_system(
      script, process, options, diagnostics, [](auto& system, const lts::ExploreOptions& bounds) {
        auto found =
            with_plain_system(system, [&](auto& plain) { return lts::explore(plain, bounds); });
        ProcessExploration graph{.lts = std::move(found.lts),
                                 .term = {},
                                 .structure = system.structure(),
                                 .complete = found.complete(),
                                 .failed = found.failed,
                                 .limit = found.limit ? found.limit : system.limit()};
        graph.term = terms_of(system, std::move(found.states));
        return graph;
      });
  report_growth(script, result.limit, diagnostics);
  return result;
}

}  // namespace perentie::semantics

#include "machine_support.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace perentie::semantics {
namespace {

// The classes of strong bisimilarity of the states of both, those of `left` first: partitions
// refined by signatures until nothing changes.
std::vector<std::size_t> bisimilarity_classes(const lts::Lts& left, const lts::Lts& right) {
  const std::size_t first_right = left.state_count();
  std::vector<std::size_t> classes(first_right + right.state_count(), 0);
  for (std::size_t count = 1;;) {
    using Signature = std::vector<std::pair<std::string, std::size_t>>;
    std::map<std::pair<std::size_t, Signature>, std::size_t> known;
    std::vector<std::size_t> refined;
    for (std::size_t s = 0; s < classes.size(); ++s) {
      const bool is_left = s < first_right;
      const lts::Lts& graph = is_left ? left : right;
      const std::size_t base = is_left ? 0 : first_right;
      Signature signature;
      for (const lts::Edge& e : graph.edges(lts::State{static_cast<std::uint32_t>(s - base)})) {
        signature.emplace_back(graph.name(e.label), classes[base + e.target.value]);
      }
      std::sort(signature.begin(), signature.end());
      signature.erase(std::unique(signature.begin(), signature.end()), signature.end());
      refined.push_back(
          known.emplace(std::pair(classes[s], signature), known.size()).first->second);
    }
    classes = std::move(refined);
    if (known.size() == count) return classes;
    count = known.size();
  }
}

}  // namespace

BothWays explore_both_ways(TestScript& script, const std::string& process, std::size_t min_leaves,
                           std::uint64_t max_states) {
  BothWays result;
  const base::Limits limits{.max_states = max_states};
  base::Diagnostics unheard;
  const auto term = script.script().process(process, unheard, process);
  if (!term) return result;
  const MachineCompilation compilation =
      script.script().machine(*term, {.limits = limits, .min_leaves = min_leaves});
  if (compilation.machine) {
    auto exploration = with_system(*compilation.machine, [&](auto system) {
      auto found = lts::explore(system, {.limits = limits});
      return std::pair(found.complete(), std::move(found.lts));
    });
    if (exploration.first) result.machine = std::move(exploration.second);
  }
  result.steps = script.explore(process, limits);
  return result;
}

::testing::AssertionResult same_graph(const lts::Lts& steps, const lts::Lts& machine) {
  if (steps.state_count() != machine.state_count() || steps.edge_count() != machine.edge_count()) {
    return ::testing::AssertionFailure()
           << "the step rules give " << steps.state_count() << " states and " << steps.edge_count()
           << " edges, the machine " << machine.state_count() << " and " << machine.edge_count();
  }
  const auto classes = bisimilarity_classes(steps, machine);
  const std::size_t first = steps.state_count();
  if (classes[steps.initial().value] != classes[first + machine.initial().value]) {
    return ::testing::AssertionFailure() << "the initial states are not bisimilar";
  }
  std::map<std::size_t, std::ptrdiff_t> balance;  // of states in each class
  for (std::size_t s = 0; s < classes.size(); ++s) balance[classes[s]] += s < first ? 1 : -1;
  for (const auto& [unused, difference] : balance) {
    if (difference == 0) continue;
    return ::testing::AssertionFailure() << "a class of bisimilar states has other sizes";
  }
  return ::testing::AssertionSuccess();
}

}  // namespace perentie::semantics

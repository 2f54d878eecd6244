#include "components.hpp"

#include <algorithm>

namespace perentie::semantics {

RunningOperands Components::places(ProcId term) const {
  return running_operands(processes_.kind(term), processes_.words(term).size());
}

std::vector<ProcId> Components::of(ProcId state) {
  const RunningOperands place = places(state);
  std::vector<ProcId> components;
  for (std::size_t i = 0; i < place.count; ++i) {
    const auto component = rules_.state(processes_.operand(state, place.first + i * place.stride));
    if (!component) return {};
    components.push_back(*component);
  }
  return components;
}

bool Components::belongs_to_same_operator(ProcId from, ProcId to,
                                          const RunningOperands& place) const {
  const auto before = processes_.words(from);
  const auto after = processes_.words(to);
  if (processes_.kind(from) != processes_.kind(to) || before.size() != after.size()) return false;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool is_component = i >= place.first && (i - place.first) % place.stride == 0 &&
                              (i - place.first) / place.stride < place.count;
    if (!is_component && before[i] != after[i]) return false;
  }
  return true;
}

// Whether the operator lets `outer` be seen where a component performs `inner`.
bool Components::becomes(ProcId term, lts::Label inner, lts::Label outer) const {
  const bool is_event = inner != lts::tau && inner != lts::tick;
  const ProcKind kind = processes_.kind(term);
  if (kind == ProcKind::hide || kind == ProcKind::project) {
    const bool is_member = events_.contains(EventSetId{processes_.word(term, 0)}, inner);
    const bool hidden = is_event && is_member == (kind == ProcKind::hide);
    return outer == (hidden ? lts::tau : inner);
  }
  if (kind == ProcKind::rename) {
    const auto images = events_.images(EventRelationId{processes_.word(term, 0)}, inner);
    if (images.empty()) return inner == outer;
    return std::ranges::any_of(images, [&](const EventPair& pair) { return pair.to == outer; });
  }
  return inner == outer;
}

std::vector<std::size_t> Components::partners(ProcId state, std::size_t ready,
                                              lts::Label event) const {
  const RunningOperands place = places(state);
  const ProcKind kind = processes_.kind(state);
  const auto takes_part = [&](std::size_t i) {
    if (event == lts::tau) return i == ready;
    if (event == lts::tick) return i == ready || is_parallel(kind);
    switch (kind) {
      case ProcKind::parallel:
      case ProcKind::sync_choice:
      case ProcKind::sync_interrupt:
        return i == ready || events_.contains(EventSetId{processes_.word(state, 0)}, event);
      case ProcKind::alphabet_parallel:
        return events_.contains(EventSetId{processes_.word(state, 2 * i)}, event);
      default:
        return i == ready;
    }
  };
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < place.count; ++i) {
    if (takes_part(i)) found.push_back(i);
  }
  return found;
}

std::optional<TransitionShare> Components::share(ProcId from, std::size_t component,
                                                 const Steps& steps, lts::Label label,
                                                 std::optional<ProcId> target) const {
  for (const StepRules::Step& step : steps) {
    if ((!target || step.target == *target) && becomes(from, step.label, label)) {
      return TransitionShare{component, step.label, step.target};
    }
  }
  return std::nullopt;
}

// Two linked events make a τ.
std::optional<std::vector<TransitionShare>> Components::linked(
    ProcId from, std::span<const Steps> steps, std::span<const ProcId> targets) const {
  for (const StepRules::Step& left : steps[0]) {
    if (left.target != targets[0] || left.label == lts::tau || left.label == lts::tick) continue;
    const auto images = events_.images(EventRelationId{processes_.word(from, 0)}, left.label);
    if (images.empty()) continue;
    const auto right = share(from, 1, steps[1], images[0].to, targets[1]);
    if (right) return std::vector{TransitionShare{0, left.label, left.target}, *right};
  }
  return std::nullopt;
}

std::optional<std::vector<TransitionShare>> Components::shares(ProcId from, lts::Label label,
                                                               ProcId to) {
  const std::vector<ProcId> components = of(from);
  if (components.empty()) return std::nullopt;
  std::vector<Steps> steps(components.size());
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (!rules_.successors(components[i], steps[i])) return std::nullopt;
  }
  // After ✓ nothing is left of the operator.
  const bool ends = label == lts::tick;
  const RunningOperands place = places(from);
  if (!ends && !belongs_to_same_operator(from, to, place)) return std::nullopt;
  const std::vector<ProcId> targets = ends ? std::vector<ProcId>{} : of(to);
  if (!ends && targets.size() != components.size()) return std::nullopt;

  // Whoever leads, its partners must move with it and all others stay.
  for (std::size_t leader = 0; leader < components.size(); ++leader) {
    const std::vector<std::size_t> moving = partners(from, leader, label);
    if (!std::ranges::binary_search(moving, leader)) continue;  // outside its own alphabet
    std::vector<TransitionShare> shares;
    bool fits = true;
    for (std::size_t i = 0; i < components.size() && fits; ++i) {
      if (!std::ranges::binary_search(moving, i)) {
        fits = ends || targets[i] == components[i];
        continue;
      }
      const auto own =
          share(from, i, steps[i], label, ends ? std::nullopt : std::optional(targets[i]));
      fits = own.has_value();
      if (own) shares.push_back(*own);
    }
    if (fits) return shares;
  }
  if (processes_.kind(from) == ProcKind::link_parallel && label == lts::tau) {
    return linked(from, steps, targets);
  }
  return std::nullopt;
}

}  // namespace perentie::semantics

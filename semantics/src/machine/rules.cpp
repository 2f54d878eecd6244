#include "machine/rules.hpp"

#include <algorithm>
#include <utility>

namespace perentie::semantics {

bool is_compiled_operator(ProcKind kind) {
  switch (kind) {
    case ProcKind::interleave:
    case ProcKind::parallel:
    case ProcKind::alphabet_parallel:
    case ProcKind::link_parallel:
    case ProcKind::hide:
    case ProcKind::project:
    case ProcKind::rename:
      return true;
    default:
      return false;
  }
}

namespace {

// Rules with the same event become neighbours.
void sort_by_event(RuleBuilder::Rules& rules) {
  std::stable_sort(rules.begin(), rules.end(),
                   [](const SyncRule& a, const SyncRule& b) { return a.event < b.event; });
}

std::span<const SyncRule> with_event(const RuleBuilder::Rules& sorted, EventId event) {
  const auto first =
      std::lower_bound(sorted.begin(), sorted.end(), event,
                       [](const SyncRule& rule, EventId e) { return rule.event < e; });
  auto last = first;
  while (last != sorted.end() && last->event == event) ++last;
  return {first, last};
}

}  // namespace

RuleBuilder::Rules RuleBuilder::leaf(std::uint32_t leaf, std::span<const EventId> alphabet) {
  Rules rules;
  for (const EventId event : alphabet) {
    rules.push_back({event, static_cast<std::uint32_t>(parts_.size()), 1});
    parts_.push_back({leaf, event});
  }
  return rules;
}

bool RuleBuilder::unite(Rules& left, const Rules& right) {
  if (left.size() + right.size() > max_rules_) return false;
  left.insert(left.end(), right.begin(), right.end());
  return true;
}

// Appends the rules in which a rule of each side fires; both sides are of one event.
bool RuleBuilder::join(const Rules& left, const Rules& right, std::optional<EventId> result,
                       Rules& out) {
  if (out.size() + left.size() * right.size() > max_rules_) return false;
  for (const SyncRule& l : left) {
    for (const SyncRule& r : right) {
      if (parts_.size() + l.count + r.count > 16 * max_rules_) return false;
      const auto first = static_cast<std::uint32_t>(parts_.size());
      for (const SyncRule& side : {l, r}) {
        for (std::uint32_t i = 0; i < side.count; ++i) {
          const RulePart part = parts_[side.first + i];
          parts_.push_back(part);
        }
      }
      out.push_back({result.value_or(l.event), first, l.count + r.count});
    }
  }
  return true;
}

// Shared events need both sides, the others one.
std::optional<RuleBuilder::Rules> RuleBuilder::synchronise(Rules left, Rules right,
                                                           const EventBits& shared) {
  Rules out;
  Rules left_shared, right_shared;
  for (const SyncRule& rule : left) {
    (shared.contains(rule.event) ? left_shared : out).push_back(rule);
  }
  for (const SyncRule& rule : right) {
    (shared.contains(rule.event) ? right_shared : out).push_back(rule);
  }
  sort_by_event(left_shared);
  sort_by_event(right_shared);
  for (std::size_t i = 0; i < left_shared.size();) {
    const auto run = with_event(left_shared, left_shared[i].event);
    const auto partners = with_event(right_shared, left_shared[i].event);
    if (!join({run.begin(), run.end()}, {partners.begin(), partners.end()}, {}, out)) {
      return std::nullopt;
    }
    i += run.size();
  }
  if (out.size() > max_rules_) return std::nullopt;
  return out;
}

// An event needs every operand whose alphabet contains it; nothing else is possible.
std::optional<RuleBuilder::Rules> RuleBuilder::alphabetised(ProcId term,
                                                            std::vector<Rules> operands) {
  Rules rules;
  EventBits known;  // the events in the alphabets so far
  for (std::size_t i = 0; i < operands.size(); ++i) {
    const EventSetId set{processes_.word(term, 2 * i)};
    const EventBits alphabet(events_, set);
    std::erase_if(operands[i], [&](const SyncRule& rule) {
      return rule.event != lts::tau && !alphabet.contains(rule.event);
    });
    EventBits shared;
    for (const EventId event : events_.events(set)) {
      if (known.contains(event)) shared.add(event);
    }
    auto both = synchronise(std::move(rules), std::move(operands[i]), shared);
    if (!both) return std::nullopt;
    rules = std::move(*both);
    for (const EventId event : events_.events(set)) known.add(event);
  }
  return rules;
}

// Linked events happen together, as τ, and never alone.
std::optional<RuleBuilder::Rules> RuleBuilder::linked(EventRelationId links, const Rules& left,
                                                      const Rules& right) {
  EventBits right_ends;
  for (const EventPair& pair : events_.pairs(links)) right_ends.add(pair.to);
  Rules out;
  Rules right_linked;
  for (const SyncRule& rule : right) {
    (right_ends.contains(rule.event) ? right_linked : out).push_back(rule);
  }
  sort_by_event(right_linked);
  for (const SyncRule& rule : left) {
    const auto images = events_.images(links, rule.event);
    if (images.empty()) {
      out.push_back(rule);
      continue;
    }
    const auto partners = with_event(right_linked, images[0].to);
    if (!join({rule}, {partners.begin(), partners.end()}, lts::tau, out)) return std::nullopt;
  }
  return out;
}

std::optional<RuleBuilder::Rules> RuleBuilder::renamed(EventRelationId relation,
                                                       const Rules& operand) {
  Rules out;
  for (const SyncRule& rule : operand) {
    const auto images = events_.images(relation, rule.event);
    if (out.size() + images.size() + 1 > max_rules_) return std::nullopt;
    for (const EventPair& pair : images) out.push_back({pair.to, rule.first, rule.count});
    if (images.empty()) out.push_back(rule);
  }
  return out;
}

std::optional<RuleBuilder::Rules> RuleBuilder::combine(ProcId term, std::vector<Rules> operands) {
  const ProcKind kind = processes_.kind(term);
  switch (kind) {
    case ProcKind::interleave: {
      Rules rules = std::move(operands[0]);
      for (std::size_t i = 1; i < operands.size(); ++i) {
        if (!unite(rules, operands[i])) return std::nullopt;
      }
      return rules;
    }
    case ProcKind::parallel: {
      const EventBits shared(events_, EventSetId{processes_.word(term, 0)});
      std::optional<Rules> rules = std::move(operands[0]);
      for (std::size_t i = 1; rules && i < operands.size(); ++i) {
        rules = synchronise(std::move(*rules), std::move(operands[i]), shared);
      }
      return rules;
    }
    case ProcKind::alphabet_parallel:
      return alphabetised(term, std::move(operands));
    case ProcKind::link_parallel:
      return linked(EventRelationId{processes_.word(term, 0)}, operands[0], operands[1]);
    case ProcKind::hide:
    case ProcKind::project: {
      const EventBits set(events_, EventSetId{processes_.word(term, 0)});
      for (SyncRule& rule : operands[0]) {
        if (set.contains(rule.event) == (kind == ProcKind::hide)) rule.event = lts::tau;
      }
      return std::move(operands[0]);
    }
    default:
      return renamed(EventRelationId{processes_.word(term, 0)}, operands[0]);
  }
}

}  // namespace perentie::semantics

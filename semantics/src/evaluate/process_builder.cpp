#include "process_builder.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <unordered_set>

#include <fmt/format.h>

#include "brief.hpp"
#include "failure.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"
#include "sets.hpp"

namespace perentie::semantics {

std::string ProcessBuilder::show_event(EventId event) const {
  return brief(values_, resolution_, events_.value(event));
}

EventId ProcessBuilder::event(ValueId value) {
  if (const EventId known = events_.find(value)) return known;
  if (!data_.is_event(value)) {
    const std::string text = brief(values_, resolution_, value);
    const bool is_partial = !data_.is_complete(value);
    fail(codes::not_an_event, is_partial
                                  ? fmt::format("`{}` lacks fields, so it is not an event", text)
                                  : fmt::format("`{}` is not an event", text));
  }
  return events_.intern(value);
}

EventSetId ProcessBuilder::event_set(ValueId set) {
  if (!values_.is_set(set)) {
    fail(codes::wrong_type, fmt::format("a set of events is needed, but this is `{}`",
                                        brief(values_, resolution_, set)));
  }
  if (const auto known = event_sets_.find(set.bits); known != event_sets_.end()) {
    return known->second;
  }
  std::vector<EventId> events;
  for (const ValueId element : elements_of(values_, set, "use the events of")) {
    events.push_back(event(element));
  }
  return event_sets_[set.bits] = events_.make_set(std::move(events));
}

ProcId ProcessBuilder::event_set_prefix(ValueId set, ProcId body) {
  const EventSetId events = event_set(set);
  const auto all = events_.events(events);
  return all.size() == 1 ? processes_.prefix(all[0], body)
                         : processes_.event_set_prefix(events, body);
}

// Choices in a choice are one, without operands that are the constant STOP.
ProcId ProcessBuilder::external_choice(std::span<const ProcId> operands) {
  std::vector<ProcId> all;
  for (const ProcId operand : operands) {
    if (operand == processes_.stop()) continue;
    if (processes_.kind(operand) == ProcKind::external_choice) {
      for (const std::uint32_t word : processes_.words(operand)) all.push_back(ProcId{word});
    } else {
      all.push_back(operand);
    }
  }
  return processes_.external_choice(all);
}

ProcId ProcessBuilder::binary(ProcKind kind, ProcId left, ProcId right) {
  const ProcId operands[] = {left, right};
  if (kind == ProcKind::external_choice) return external_choice(operands);
  if (kind == ProcKind::internal_choice) return processes_.internal_choice(operands);
  if (kind == ProcKind::interleave) return processes_.interleave(operands);
  return processes_.binary(kind, left, right);
}

ProcId ProcessBuilder::with_alphabet(ProcKind kind, ProcId left, ValueId set, ProcId right) {
  const EventSetId alphabet = event_set(set);
  const ProcId operands[] = {left, right};
  if (kind == ProcKind::parallel) return processes_.parallel(alphabet, operands);
  if (kind == ProcKind::sync_choice) return processes_.sync_choice(alphabet, operands);
  return processes_.binary(kind, alphabet.value, left, right);
}

ProcId ProcessBuilder::alphabet_parallel(ProcId left, ValueId left_set, ValueId right_set,
                                         ProcId right) {
  const std::uint32_t words[] = {event_set(left_set).value, left.value, event_set(right_set).value,
                                 right.value};
  return processes_.alphabet_parallel(words);
}

ProcId ProcessBuilder::hide(ProcKind kind, ProcId operand, ValueId set) {
  const EventSetId events = event_set(set);
  if (kind == ProcKind::hide && events == events_.empty_set()) return operand;
  return processes_.unary(kind, events.value, operand);
}

// --- Renaming and links -------------------------------------------------------------------------

// `c <- d` for incomplete c stands for all pairs `c.x <- d.x` (3.6).
std::vector<EventPair> ProcessBuilder::event_pairs(std::span<const Tie> ties) {
  std::vector<EventPair> pairs;
  for (const auto& [from, to] : ties) {
    if (data_.is_complete(from)) {
      pairs.push_back({event(from), event(to)});
      continue;
    }
    for (const DataModel::Extension& extension : data_.extensions(from, true)) {
      pairs.push_back({event(extension.value), event(data_.append(to, extension.component))});
    }
  }
  return pairs;
}

ProcId ProcessBuilder::rename(ProcId operand, std::span<const Tie> ties) {
  std::vector<EventPair> pairs = event_pairs(ties);
  if (pairs.empty()) return operand;
  return processes_.unary(ProcKind::rename, events_.make_relation(std::move(pairs)).value, operand);
}

ProcId ProcessBuilder::link_parallel(ProcId left, std::span<const Tie> ties, ProcId right) {
  const EventRelationId links = events_.make_relation(event_pairs(ties));
  std::set<EventId> lefts;
  std::set<EventId> rights;
  for (const EventPair& pair : events_.pairs(links)) {
    for (const auto& [seen, event] : {std::pair(&lefts, pair.from), std::pair(&rights, pair.to)}) {
      if (seen->insert(event).second) continue;
      fail(codes::bad_link, fmt::format("the event `{}` is linked more than once on the {}",
                                        show_event(event), seen == &lefts ? "left" : "right"));
    }
  }
  return processes_.binary(ProcKind::link_parallel, links.value, left, right);
}

ProcId ProcessBuilder::replicated(ProcKind kind, std::span<const ProcId> operands, ValueId set,
                                  bool is_choice_of_fields) {
  switch (kind) {
    case ProcKind::external_choice:
      return processes_.external_choice(operands);
    case ProcKind::interleave:
      return processes_.interleave(operands);
    case ProcKind::parallel:
      return processes_.parallel(event_set(set), operands);
    case ProcKind::sync_choice:
      return processes_.sync_choice(event_set(set), operands);
    case ProcKind::internal_choice:
      if (operands.empty()) {
        fail(codes::empty_choice, is_choice_of_fields
                                      ? "a `$` field has no value to choose from"
                                      : "a replicated internal choice over an empty set");
      }
      if (operands.size() == 1 && is_choice_of_fields) return operands[0];
      return processes_.internal_choice(operands);
    default:
      break;
  }
  PERENTIE_CHECK(kind == ProcKind::sequential, "an operator that cannot be replicated");
  if (operands.empty()) return processes_.skip();
  ProcId result = operands.back();
  for (std::size_t i = operands.size() - 1; i > 0; --i) {
    result = processes_.binary(ProcKind::sequential, operands[i - 1], result);
  }
  return result;
}

ProcId ProcessBuilder::replicated_link(
    std::span<const std::pair<std::vector<Tie>, ProcId>> operands) {
  if (operands.empty()) {
    fail(codes::empty_choice, "a replicated linked parallel over an empty sequence");
  }
  ProcId result = operands.back().second;
  for (std::size_t i = operands.size() - 1; i > 0; --i) {
    result = link_parallel(operands[i - 1].second, operands[i - 1].first, result);
  }
  return result;
}

// --- Buffers ------------------------------------------------------------------------------------

void ProcessBuilder::check_buffer(std::span<const ValueId> arguments) {
  const std::int64_t capacity = values_.as_int(arguments.front());
  if (capacity < 1) {
    fail(codes::user_error, fmt::format("The supplied buffer capacity {} was insufficient; it must "
                                        "be at least 1.",
                                        capacity));
  }
  std::vector<ValueId> events(arguments.begin() + 1, arguments.end() - 1);
  for (const ValueId pair : elements_of(values_, arguments.back(), "make a buffer of")) {
    const auto items = values_.items(pair);
    events.insert(events.end(), items.begin(), items.end());
  }
  std::unordered_set<std::uint32_t> seen;
  for (const ValueId value : events) {
    if (!seen.insert(event(value).value).second) {
      fail(codes::user_error, fmt::format("The events of a buffer must differ from each other, but "
                                          "`{}` is there twice.",
                                          show_event(event(value))));
    }
  }
}

// --- Priority -----------------------------------------------------------------------------------

ProcId ProcessBuilder::prioritise(ProcId operand, ValueId order) {
  std::vector<EventSetId> sets;
  for (; values_.kind(order) == ValueKind::cons; order = values_.tail(order)) {
    sets.push_back(event_set(values_.head(order)));
  }
  if (sets.empty()) fail(codes::bad_priority, "prioritise needs a non-empty sequence of sets");
  return processes_.prioritise(operand, sets);
}

ProcId ProcessBuilder::prioritise_partial(ProcId operand, ValueId prioritised, ValueId order,
                                          ValueId maximal) {
  const EventSetId all = event_set(prioritised);
  const EventSetId tops = event_set(maximal);
  const auto require_prioritised = [&](EventId event) {
    if (events_.contains(all, event)) return;
    fail(codes::bad_priority,
         fmt::format("`{}` is in the order or among the maximal events, but not among the "
                     "prioritised events",
                     show_event(event)));
  };
  // The order as (event, event that blocks it), transitively closed.
  std::set<EventPair> blocked_by;
  for (const ValueId pair : elements_of(values_, order, "use the order of")) {
    if (values_.kind(pair) != ValueKind::tuple || values_.items(pair).size() != 2) {
      fail(codes::wrong_type, "the order of prioritisepo is a set of pairs of events");
    }
    const EventId higher = event(values_.items(pair)[0]);
    const EventId lower = event(values_.items(pair)[1]);
    require_prioritised(higher);
    require_prioritised(lower);
    blocked_by.insert({lower, higher});
  }
  for (bool grew = true; grew;) {
    std::vector<EventPair> added;
    for (const EventPair& a : blocked_by) {
      for (auto b = blocked_by.lower_bound({a.to, EventId{0}});
           b != blocked_by.end() && b->from == a.to; ++b) {
        if (!blocked_by.contains({a.from, b->to})) added.push_back({a.from, b->to});
      }
    }
    grew = !added.empty();
    blocked_by.insert(added.begin(), added.end());
  }
  for (const EventPair& pair : blocked_by) {
    if (pair.from == pair.to) {
      fail(codes::bad_priority, fmt::format("the order of prioritisepo has a cycle through `{}`",
                                            show_event(pair.from)));
    }
    if (events_.contains(tops, pair.from)) {
      fail(codes::bad_priority, fmt::format("`{}` is declared maximal, but `{}` is above it",
                                            show_event(pair.from), show_event(pair.to)));
    }
  }
  for (const EventId event : events_.events(tops)) require_prioritised(event);
  std::vector<EventId> below_tau;
  const auto members = events_.events(all);
  const auto maximals = events_.events(tops);
  std::set_difference(members.begin(), members.end(), maximals.begin(), maximals.end(),
                      std::back_inserter(below_tau));
  const EventSetId below = events_.make_set(std::move(below_tau));
  const EventRelationId relation = events_.make_relation({blocked_by.begin(), blocked_by.end()});
  return processes_.prioritise_partial(below, relation, operand);
}

}  // namespace perentie::semantics

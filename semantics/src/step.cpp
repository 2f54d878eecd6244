#include "perentie/semantics/step.hpp"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "perentie/base/check.hpp"
#include "perentie/semantics/diagnostic_codes.hpp"

namespace perentie::semantics {
namespace {

// Operators in operators: a bound on recursion over the structure of a term.
constexpr std::uint32_t max_depth = 1'500;
// Names that stand for names: `P(n) = P(n + 1)` is no state.
constexpr std::uint32_t max_names = 200'000;
// How much is remembered of terms inside of states.
constexpr std::size_t max_known_terms = 1U << 18U;
constexpr std::size_t max_known_steps = 1U << 20U;
// More τ in a row are taken for divergence, which `chase` cannot follow.
constexpr std::size_t max_chased = 1'000'000;

// Whether the steps of a term cost more than to look them up.
bool is_worth_knowing(ProcKind kind) {
  switch (kind) {
    case ProcKind::stop:
    case ProcKind::skip:
    case ProcKind::div:
    case ProcKind::prefix:
    case ProcKind::event_set_prefix:
    case ProcKind::internal_choice:
    case ProcKind::chaos:
    case ProcKind::run:
    case ProcKind::compressed_state:
      return false;
    default:
      return true;
  }
}

}  // namespace

bool StepRules::unsettled_successors(ProcId process, Steps& out) {
  limit_.reset();
  unfolding_.clear();
  depth_ = 0;
  return step(process, out);
}

bool StepRules::successors(ProcId process, Steps& out) {
  const std::size_t first = out.size();
  if (!unsettled_successors(process, out)) return false;
  for (std::size_t i = first; i < out.size(); ++i) {
    const std::optional<ProcId> target = settle(out[i].target);
    if (!target) return false;
    out[i].target = *target;
  }
  return true;
}

std::optional<ProcId> StepRules::state(ProcId process) {
  limit_.reset();
  depth_ = 0;
  return settle(process);
}

// --- States -------------------------------------------------------------------------------------

std::optional<ProcId> StepRules::unfold(ProcId call) {
  const std::optional<ProcId> body = calls_.unfold(call, diagnostics_);
  if (!body) limit_ = calls_.limit();
  return body;
}

std::optional<ProcId> StepRules::settle(ProcId process) {
  std::vector<ProcId> names;
  std::optional<ProcId> state;
  while (!state) {
    if (processes_.kind(process) != ProcKind::call) {
      state = settle_operands(process);
      if (!state) return std::nullopt;
    } else if (const auto known = settled_.find(process.value); known != settled_.end()) {
      state = known->second;
    } else if (names.size() == max_names) {
      limit_ = base::LimitReached{base::LimitKind::depth, max_names};
      return std::nullopt;
    } else {
      names.push_back(process);
      settled_[process.value] = process;  // for a name that stands for itself alone
      const std::optional<ProcId> body = unfold(process);
      if (!body) return std::nullopt;
      const ProcKind kind = processes_.kind(*body);
      // DIV, RUN(A) and CHAOS(A) are names, too.
      const bool is_name = kind == ProcKind::call || kind == ProcKind::div ||
                           kind == ProcKind::run || kind == ProcKind::chaos;
      if (is_name || stays_in_place(kind)) {
        process = *body;
      } else {
        state = process;
      }
    }
  }
  for (const ProcId name : names) settled_[name.value] = *state;
  return state;
}

std::optional<ProcId> StepRules::settle_operands(ProcId process) {
  const ProcKind kind = processes_.kind(process);
  if (!stays_in_place(kind) || depth_ >= max_depth) return process;
  if (const auto known = settled_operands_.find(process.value); known != settled_operands_.end()) {
    return known->second;
  }
  const OperandPlaces places = *process_operands(kind);
  const auto words = processes_.words(process);
  std::vector<std::uint32_t> settled(words.begin(), words.end());
  ++depth_;
  for (std::size_t i = places.first; i < settled.size(); i += places.stride) {
    const std::optional<ProcId> operand = settle(ProcId{settled[i]});
    if (!operand) return std::nullopt;
    settled[i] = operand->value;
  }
  --depth_;
  const ProcId state = processes_.rebuild(process, settled);
  if (settled_operands_.size() >= max_known_terms) settled_operands_.clear();
  settled_operands_[process.value] = state;
  return state;
}

bool StepRules::step(ProcId process, Steps& out) {
  if (++depth_ > max_depth) {
    limit_ = base::LimitReached{base::LimitKind::depth, max_depth};
    return false;
  }
  const bool is_operand = depth_ > 1 && is_worth_knowing(processes_.kind(process));
  const Memory& memory = memory_[below_priority_ ? 1 : 0];
  const auto known = is_operand ? memory.steps.find(process.value) : memory.steps.end();
  bool done = true;
  if (known != memory.steps.end()) {
    const auto first = memory.pool.begin() + known->second.first;
    out.insert(out.end(), first, first + known->second.count);
  } else {
    const std::size_t first = out.size();
    done = step_term(process, out);
    if (done && is_operand) remember_steps(process, std::span<const Step>(out).subspan(first));
  }
  --depth_;
  return done;
}

void StepRules::remember_steps(ProcId process, std::span<const Step> steps) {
  Memory& memory = memory_[below_priority_ ? 1 : 0];
  if (memory.steps.size() >= max_known_terms ||
      memory.pool.size() + steps.size() > max_known_steps) {
    memory.steps.clear();
    memory.pool.clear();
  }
  if (steps.size() > max_known_steps) return;
  memory.steps[process.value] = {static_cast<std::uint32_t>(memory.pool.size()),
                                 static_cast<std::uint32_t>(steps.size())};
  memory.pool.insert(memory.pool.end(), steps.begin(), steps.end());
}

bool StepRules::step_term(ProcId process, Steps& out) {
  const auto word = [&](std::size_t i) { return processes_.word(process, i); };
  switch (processes_.kind(process)) {
    case ProcKind::stop:
      return true;
    case ProcKind::skip:
      out.push_back({lts::tick, processes_.stop()});
      return true;
    case ProcKind::div:
      out.push_back({lts::tau, process});
      return true;
    case ProcKind::prefix:
      out.push_back({EventId{word(0)}, ProcId{word(1)}});
      return true;
    case ProcKind::event_set_prefix:
      for (const EventId event : events_.events(EventSetId{word(0)})) {
        out.push_back({event, ProcId{word(1)}});
      }
      return true;
    case ProcKind::internal_choice:
      for (const std::uint32_t operand : processes_.words(process)) {
        out.push_back({lts::tau, ProcId{operand}});
      }
      return true;
    case ProcKind::external_choice:
      return external_choice(process, out);
    case ProcKind::sequential:
      return sequential(process, out);
    case ProcKind::interrupt:
      return interrupt(process, out);
    case ProcKind::sliding_choice:
      return sliding_choice(process, out);
    case ProcKind::interleave:
    case ProcKind::parallel:
    case ProcKind::alphabet_parallel:
      return parallel(process, out);
    case ProcKind::link_parallel:
      return link_parallel(process, out);
    case ProcKind::exception:
      return exception(process, out);
    case ProcKind::sync_choice:
      return sync_choice(process, out);
    case ProcKind::sync_interrupt:
      return sync_interrupt(process, out);
    case ProcKind::hide:
    case ProcKind::project:
      return hide_or_project(process, out);
    case ProcKind::rename:
      return rename(process, out);
    case ProcKind::chaos:
      chaos(process, out);
      return true;
    case ProcKind::run:
      for (const EventId event : events_.events(EventSetId{word(0)})) {
        out.push_back({event, process});
      }
      return true;
    case ProcKind::prioritise:
      return prioritise(process, out);
    case ProcKind::prioritise_partial:
      return prioritise_partial(process, out);
    case ProcKind::compression:
      return compression(process, out);
    case ProcKind::graph_operator:
      return graph_operator(process, out);
    case ProcKind::compressed_state:
      return compressed_state(process, out);
    case ProcKind::chase:
      return chase(process, out);
    case ProcKind::opaque:
      return refuse_opaque(process);
    case ProcKind::call:
      return step_call(process, out);
  }
  return true;
}

// P(args) behaves as its body. A call that needs its own transitions first has none to begin with.
bool StepRules::step_call(ProcId process, Steps& out) {
  if (!unfolding_.insert(process.value).second) {
    diagnostics_.report(codes::unguarded_recursion, calls_.definition_span(process),
                        fmt::format("`{}` is defined by itself without any event in between",
                                    calls_.call_name(process)));
    return false;
  }
  const std::optional<ProcId> body = unfold(process);
  if (!body) return false;
  const bool done = step(*body, out);
  unfolding_.erase(process.value);
  return done;
}

ProcId StepRules::with_operand(ProcId process, std::size_t word, ProcId operand) {
  const auto words = processes_.words(process);
  std::vector<std::uint32_t> changed(words.begin(), words.end());
  changed[word] = operand.value;
  return processes_.rebuild(process, changed);
}

// Where an operator that stays goes when its operand steps; ✓ ends the whole (4.1.2).
ProcId StepRules::after(ProcId process, std::size_t word, const Step& step) {
  return step.label == lts::tick ? processes_.stop() : with_operand(process, word, step.target);
}

// --- Choice and sequence ------------------------------------------------------------------------

bool StepRules::external_choice(ProcId process, Steps& out) {
  const std::size_t count = processes_.words(process).size();
  Steps steps;
  for (std::size_t i = 0; i < count; ++i) {
    steps.clear();
    if (!step(processes_.operand(process, i), steps)) return false;
    for (const Step& s : steps) {
      out.push_back({s.label, s.label == lts::tau ? with_operand(process, i, s.target) : s.target});
    }
  }
  return true;
}

bool StepRules::sequential(ProcId process, Steps& out) {
  const ProcId right = processes_.operand(process, 1);
  Steps steps;
  if (!step(processes_.operand(process, 0), steps)) return false;
  for (const Step& s : steps) {
    if (s.label == lts::tick) {
      out.push_back({lts::tau, right});
      continue;
    }
    const std::optional<ProcId> target = sequential_target(s.target, right);
    if (!target) return false;
    out.push_back({s.label, *target});
  }
  return true;
}

// A state `P ; Q` whose P can only terminate is the state Q: FDR elides that τ (6.2.6).
std::optional<ProcId> StepRules::sequential_target(ProcId left, ProcId right) {
  const std::optional<bool> elided = only_terminates(left);
  if (!elided) return std::nullopt;
  return *elided ? right : processes_.binary(ProcKind::sequential, left, right);
}

std::optional<bool> StepRules::only_terminates(ProcId process) {
  switch (processes_.kind(process)) {
    case ProcKind::skip:
      return true;
    case ProcKind::stop:
    case ProcKind::div:
    case ProcKind::prefix:
    case ProcKind::event_set_prefix:
    case ProcKind::internal_choice:
    case ProcKind::sliding_choice:
    case ProcKind::chaos:
    case ProcKind::run:
    case ProcKind::chase:
    case ProcKind::opaque:
    case ProcKind::compression:
    case ProcKind::graph_operator:
    case ProcKind::compressed_state:
      return false;
    default:
      break;
  }
  auto& known_answers = memory_[below_priority_ ? 1 : 0].only_terminates;
  if (const auto known = known_answers.find(process.value); known != known_answers.end()) {
    return known->second;
  }
  if (unfolding_.contains(process.value)) return false;  // its transitions are being computed
  Steps steps;
  if (!step(process, steps)) return std::nullopt;
  const bool only = !steps.empty() && std::all_of(steps.begin(), steps.end(), [](const Step& s) {
    return s.label == lts::tick;
  });
  return known_answers[process.value] = only;
}

bool StepRules::interrupt(ProcId process, Steps& out) {
  Steps steps;
  if (!step(processes_.operand(process, 0), steps)) return false;
  for (const Step& s : steps) {
    out.push_back({s.label, after(process, 0, s)});
  }
  steps.clear();
  if (!step(processes_.operand(process, 1), steps)) return false;
  for (const Step& s : steps) {
    out.push_back({s.label, s.label == lts::tau ? with_operand(process, 1, s.target) : s.target});
  }
  return true;
}

bool StepRules::sliding_choice(ProcId process, Steps& out) {
  out.push_back({lts::tau, processes_.operand(process, 1)});
  Steps steps;
  if (!step(processes_.operand(process, 0), steps)) return false;
  for (const Step& s : steps) {
    out.push_back({s.label, s.label == lts::tau ? with_operand(process, 0, s.target) : s.target});
  }
  return true;
}

bool StepRules::exception(ProcId process, Steps& out) {
  const EventSetId alphabet{processes_.word(process, 0)};
  const ProcId handler = processes_.operand(process, 2);
  Steps steps;
  if (!step(processes_.operand(process, 1), steps)) return false;
  for (const Step& s : steps) {
    const bool handled = s.label != lts::tick && events_.contains(alphabet, s.label);
    out.push_back({s.label, handled ? handler : after(process, 1, s)});
  }
  return true;
}

// --- Parallel -----------------------------------------------------------------------------------

// The operands at `places` perform `event` together, each in every way it can.
void StepRules::synchronised(ProcId process, std::span<const std::size_t> places,
                             std::span<const Steps> steps, EventId event, Steps& out) {
  const auto words = processes_.words(process);
  std::vector<std::vector<std::uint32_t>> targets{{words.begin(), words.end()}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::vector<std::vector<std::uint32_t>> extended;
    for (const Step& s : steps[i]) {
      if (s.label != event) continue;
      for (std::vector<std::uint32_t> target : targets) {
        target[places[i]] = s.target.value;
        extended.push_back(std::move(target));
      }
    }
    targets = std::move(extended);
  }
  for (const auto& target : targets) out.push_back({event, processes_.rebuild(process, target)});
}

namespace {

bool offers(const StepRules::Steps& steps, EventId event) {
  return std::any_of(steps.begin(), steps.end(),
                     [&](const StepRules::Step& s) { return s.label == event; });
}

}  // namespace

// Interleaving, generalised and alphabetised parallel differ in who takes part in an event.
bool StepRules::parallel(ProcId process, Steps& out) {
  const ProcKind kind = processes_.kind(process);
  const std::size_t stride = kind == ProcKind::alphabet_parallel ? 2 : 1;
  const std::size_t first = kind == ProcKind::interleave ? 0 : 1;
  std::vector<std::size_t> places;
  for (std::size_t i = first; i < processes_.words(process).size(); i += stride)
    places.push_back(i);
  std::vector<Steps> steps(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!step(processes_.operand(process, places[i]), steps[i])) return false;
  }
  // Whether operand i takes part in an event that operand `by` offers.
  const auto takes_part = [&](std::size_t i, std::size_t by, EventId event) {
    switch (kind) {
      case ProcKind::interleave:
        return i == by;
      case ProcKind::parallel:
        return i == by || events_.contains(EventSetId{processes_.word(process, 0)}, event);
      default:
        return events_.contains(EventSetId{processes_.word(process, places[i] - 1)}, event);
    }
  };
  for (std::size_t by = 0; by < places.size(); ++by) {
    std::vector<EventId> done;  // synchronised events that this operand leads
    for (const Step& s : steps[by]) {
      if (s.label == lts::tick) continue;
      if (s.label == lts::tau) {
        out.push_back({s.label, with_operand(process, places[by], s.target)});
        continue;
      }
      if (!takes_part(by, by, s.label)) continue;  // outside its own alphabet: blocked
      std::vector<std::size_t> partners;
      std::vector<Steps> partner_steps;
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (!takes_part(i, by, s.label)) continue;
        partners.push_back(places[i]);
        if (partners.size() == 1 && i != by) break;  // an earlier operand leads
        partner_steps.push_back(steps[i]);
      }
      if (partners[0] != places[by]) continue;
      if (partners.size() == 1) {
        out.push_back({s.label, with_operand(process, places[by], s.target)});
      } else if (std::find(done.begin(), done.end(), s.label) == done.end()) {
        done.push_back(s.label);
        synchronised(process, partners, partner_steps, s.label, out);
      }
    }
  }
  // ✓ needs all operands (4.1.3).
  if (std::all_of(steps.begin(), steps.end(),
                  [](const Steps& s) { return offers(s, lts::tick); })) {
    out.push_back({lts::tick, processes_.stop()});
  }
  return true;
}

bool StepRules::link_parallel(ProcId process, Steps& out) {
  const EventRelationId links{processes_.word(process, 0)};
  Steps left;
  Steps right;
  if (!step(processes_.operand(process, 1), left)) return false;
  if (!step(processes_.operand(process, 2), right)) return false;
  const auto is_right_end = [&](EventId event) {
    const auto pairs = events_.pairs(links);
    return std::any_of(pairs.begin(), pairs.end(),
                       [&](const EventPair& p) { return p.to == event; });
  };
  for (const Step& l : left) {
    if (l.label == lts::tick) continue;
    const auto images = events_.images(links, l.label);
    if (images.empty()) {
      out.push_back({l.label, with_operand(process, 1, l.target)});
      continue;
    }
    for (const Step& r : right) {
      if (r.label != images[0].to) continue;
      const ProcId moved =
          processes_.binary(ProcKind::link_parallel, links.value, l.target, r.target);
      out.push_back({lts::tau, moved});
    }
  }
  for (const Step& r : right) {
    if (r.label == lts::tick || is_right_end(r.label)) continue;
    out.push_back({r.label, with_operand(process, 2, r.target)});
  }
  if (offers(left, lts::tick) && offers(right, lts::tick)) {
    out.push_back({lts::tick, processes_.stop()});
  }
  return true;
}

bool StepRules::sync_choice(ProcId process, Steps& out) {
  const EventSetId alphabet{processes_.word(process, 0)};
  const std::size_t count = processes_.words(process).size() - 1;
  std::vector<Steps> steps(count);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back(i + 1);
    if (!step(processes_.operand(process, i + 1), steps[i])) return false;
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<EventId> done;
    for (const Step& s : steps[i]) {
      if (s.label == lts::tau) {
        out.push_back({s.label, with_operand(process, i + 1, s.target)});
      } else if (!events_.contains(alphabet, s.label)) {
        out.push_back({s.label, s.target});
      } else if (i == 0 && std::find(done.begin(), done.end(), s.label) == done.end()) {
        done.push_back(s.label);
        synchronised(process, places, steps, s.label, out);
      }
    }
  }
  return true;
}

bool StepRules::sync_interrupt(ProcId process, Steps& out) {
  const EventSetId alphabet{processes_.word(process, 0)};
  std::vector<Steps> steps(2);
  for (std::size_t i = 0; i < 2; ++i) {
    if (!step(processes_.operand(process, i + 1), steps[i])) return false;
  }
  const std::size_t places[] = {1, 2};
  std::vector<EventId> done;
  for (const Step& s : steps[0]) {
    if (s.label == lts::tick || !events_.contains(alphabet, s.label)) {
      out.push_back({s.label, after(process, 1, s)});
    } else if (std::find(done.begin(), done.end(), s.label) == done.end()) {
      done.push_back(s.label);
      synchronised(process, places, steps, s.label, out);
    }
  }
  for (const Step& s : steps[1]) {
    if (s.label == lts::tau) {
      out.push_back({s.label, with_operand(process, 2, s.target)});
    } else if (!events_.contains(alphabet, s.label)) {
      out.push_back({s.label, s.target});
    }
  }
  return true;
}

// --- Hiding, renaming, priority -----------------------------------------------------------------

bool StepRules::hide_or_project(ProcId process, Steps& out) {
  const EventSetId set{processes_.word(process, 0)};
  const bool hides_members = processes_.kind(process) == ProcKind::hide;
  Steps steps;
  if (!step(processes_.operand(process, 1), steps)) return false;
  for (const Step& s : steps) {
    const bool is_event = s.label != lts::tau && s.label != lts::tick;
    const bool hidden = is_event && events_.contains(set, s.label) == hides_members;
    out.push_back({hidden ? lts::tau : s.label, after(process, 1, s)});
  }
  return true;
}

bool StepRules::rename(ProcId process, Steps& out) {
  const EventRelationId relation{processes_.word(process, 0)};
  Steps steps;
  if (!step(processes_.operand(process, 1), steps)) return false;
  for (const Step& s : steps) {
    const ProcId target = after(process, 1, s);
    const auto images = events_.images(relation, s.label);
    for (const EventPair& pair : images) out.push_back({pair.to, target});
    if (images.empty()) out.push_back({s.label, target});
  }
  return true;
}

// An event of the i-th set needs that none of an earlier set is offered; τ and ✓ are in the first
// (4.5.1). Events of no set are neither blocked nor block.
bool StepRules::prioritise(ProcId process, Steps& out) {
  const std::size_t sets = processes_.words(process).size() - 1;
  const auto rank = [&](EventId event) -> std::size_t {
    if (event == lts::tau || event == lts::tick) return 1;
    for (std::size_t i = 1; i <= sets; ++i) {
      if (events_.contains(EventSetId{processes_.word(process, i)}, event)) return i;
    }
    return 0;
  };
  Steps steps;
  if (!step_below_priority(processes_.operand(process, 0), steps)) return false;
  std::size_t highest = sets + 1;
  for (const Step& s : steps) {
    if (const std::size_t r = rank(s.label); r != 0) highest = std::min(highest, r);
  }
  for (const Step& s : steps) {
    if (rank(s.label) > highest) continue;
    out.push_back({s.label, after(process, 0, s)});
  }
  return true;
}

bool StepRules::prioritise_partial(ProcId process, Steps& out) {
  const EventSetId below_tau{processes_.word(process, 0)};
  const EventRelationId blocked_by{processes_.word(process, 1)};
  Steps steps;
  if (!step_below_priority(processes_.operand(process, 2), steps)) return false;
  const bool urgent = offers(steps, lts::tau) || offers(steps, lts::tick);
  for (const Step& s : steps) {
    if (urgent && events_.contains(below_tau, s.label)) continue;
    const auto blockers = events_.images(blocked_by, s.label);
    if (std::any_of(blockers.begin(), blockers.end(),
                    [&](const EventPair& pair) { return offers(steps, pair.to); })) {
      continue;
    }
    out.push_back({s.label, after(process, 2, s)});
  }
  return true;
}

bool StepRules::step_below_priority(ProcId process, Steps& out) {
  const bool before = std::exchange(below_priority_, true);
  const bool done = step(process, out);
  below_priority_ = before;
  return done;
}

// --- Compressions -------------------------------------------------------------------------------

Preserved StepRules::preserved(bool below_priority) const {
  return below_priority ? std::max(compressions_.preserved, Preserved::priority)
                        : compressions_.preserved;
}

bool StepRules::is_applied(ProcId compression, bool below_priority) {
  ProcessCompressor& compressor = compressions_.compressor;
  return compressor.compressed(compression, preserved(below_priority)) != nullptr ||
         compressor.limit();
}

bool StepRules::compression(ProcId process, Steps& out) {
  ProcessCompressor& compressor = compressions_.compressor;
  if (const auto* graph = compressor.compressed(process, preserved(below_priority_))) {
    push(*graph, graph->lts.initial().value, out);
    return true;
  }
  if ((limit_ = compressor.limit())) return false;
  Steps steps;
  if (!step(processes_.operand(process, 1), steps)) return false;
  for (const Step& s : steps) out.push_back({s.label, after(process, 1, s)});
  return true;
}

bool StepRules::graph_operator(ProcId process, Steps& out) {
  ProcessCompressor& compressor = compressions_.compressor;
  if (compressor.is_being_applied(process)) {
    const auto builtin = static_cast<Builtin>(processes_.word(process, 0));
    report(codes::graph_of_itself, process,
           fmt::format("the process that `{0}` is applied to leads to this `{0}` of itself",
                       info(builtin).name));
    return false;
  }
  if (const auto* graph = compressor.applied(process, diagnostics_)) {
    push(*graph, graph->lts.initial().value, out);
    return true;
  }
  limit_ = compressor.limit();
  return false;
}

bool StepRules::compressed_state(ProcId process, Steps& out) {
  ProcessCompressor& compressor = compressions_.compressor;
  const ProcId whole = processes_.operand(process, 0);
  const auto preserved = static_cast<Preserved>(processes_.word(process, 1));
  const std::uint32_t state = processes_.word(process, 2);
  const auto* graph = processes_.kind(whole) == ProcKind::graph_operator
                          ? compressor.applied(whole, diagnostics_)
                          : compressor.compressed(whole, preserved);
  PERENTIE_CHECK(graph != nullptr, "a state of a graph that is not there");
  push(*graph, state, out);
  return true;
}

void StepRules::push(const CompressedProcess& graph, std::uint32_t state, Steps& out) {
  for (const lts::Edge& edge : graph.lts.edges(lts::State{state})) {
    out.push_back({edge.label,
                   edge.label == lts::tick ? processes_.stop() : graph.states[edge.target.value]});
  }
}

// The first τ of each state is followed until there is none (4.6.1).
bool StepRules::chase(ProcId process, Steps& out) {
  ProcId state = processes_.operand(process, 0);
  std::unordered_set<std::uint32_t> chased;
  for (;;) {
    if (!chased.insert(state.value).second || chased.size() > max_chased) {
      report(codes::chase_without_end, process, "`chase` does not end: its process diverges");
      return false;
    }
    Steps steps;
    if (!step(state, steps)) return false;
    const auto tau =
        std::find_if(steps.begin(), steps.end(), [](const Step& s) { return s.label == lts::tau; });
    if (tau == steps.end()) {
      for (const Step& s : steps) out.push_back({s.label, after(process, 0, s)});
      return true;
    }
    const std::optional<ProcId> next = settle(tau->target);
    if (!next) return false;
    state = *next;
  }
}

// At the place where the script asked for the term, if that is known.
void StepRules::report(const base::DiagnosticCode& code, ProcId term, std::string message) {
  if (const auto origin = calls_.origin(term)) {
    diagnostics_.report(code, *origin, std::move(message));
  } else {
    diagnostics_.report(code, std::move(message));
  }
}

bool StepRules::refuse_opaque(ProcId process) {
  const auto builtin = static_cast<Builtin>(processes_.word(process, 0));
  report(codes::not_supported, process,
         fmt::format("the transitions of `{}` are not supported yet", info(builtin).name));
  return false;
}

// CHAOS(A) = STOP |~| ([] x:A @ x -> CHAOS(A)) (3.10.7).
void StepRules::chaos(ProcId process, Steps& out) {
  const EventSetId events{processes_.word(process, 0)};
  out.push_back({lts::tau, processes_.stop()});
  out.push_back({lts::tau, events == events_.empty_set()
                               ? processes_.stop()
                               : processes_.event_set_prefix(events, process)});
}

}  // namespace perentie::semantics

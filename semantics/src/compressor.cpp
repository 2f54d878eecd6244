#include "compressor.hpp"

#include <algorithm>
#include <span>
#include <variant>

#include "perentie/lts/compressions.hpp"
#include "perentie/lts/deterministic_extraction.hpp"
#include "perentie/lts/watchdogs.hpp"
#include "perentie/lts/weak_bisimulation.hpp"
#include "perentie/semantics/process_graph.hpp"
#include "preserved_in_script.hpp"

namespace perentie::semantics {
namespace {

// Larger processes are not compressed: they may be small where they are used. After so many states
// of such processes no more are tried.
constexpr std::uint64_t max_states = 10'000'000;
// Compressions in compressions: a bound on recursion; what lies deeper is not compressed. Graph
// operators that lie deeper have no graph.
constexpr std::uint32_t max_nesting = 100;

using Compression = std::variant<lts::Lts, base::LimitReached>;

Compression plain(lts::QuotientResult result) {
  if (const auto* limit = std::get_if<base::LimitReached>(&result)) return *limit;
  return std::get<lts::Quotient>(std::move(result)).lts;
}

Compression plain(const lts::GeneralisedResult& result) {
  if (const auto* limit = std::get_if<base::LimitReached>(&result)) return *limit;
  return lts::plain_lts(std::get<lts::GeneralisedLts>(result));
}

Compression compress_graph(const lts::Lts& lts, Builtin compression, const base::Limits& limits) {
  switch (compression) {
    case Builtin::sbisim:
      return lts::strong_bisimulation(lts).lts;
    case Builtin::dbisim:
      return plain(lts::delay_bisimulation(lts, limits));
    case Builtin::wbisim:
      return plain(lts::weak_bisimulation(lts, limits));
    case Builtin::tau_loop_factor:
      return lts::tau_loop_factor(lts).lts;
    case Builtin::diamond:
      return plain(lts::diamond(lts, limits));
    default:
      return plain(lts::normal(lts, limits));
  }
}

struct WatchdogAlphabet {
  std::span<const EventId> events;
  EventId bark;
};

Compression apply_to_graph(const lts::Lts& lts, Builtin builtin, const WatchdogAlphabet& alphabet,
                           const base::Limits& limits) {
  switch (builtin) {
    case Builtin::trace_watchdog:
      return lts::trace_watchdog(lts, alphabet.events, alphabet.bark, limits);
    case Builtin::failure_watchdog:
      return lts::failure_watchdog(lts, alphabet.events, alphabet.bark, limits);
    default:
      return lts::deterministic_extraction(lts);
  }
}

// Errors are those of the one who asked. What is said of a budget that ran out will be said of the
// whole.
void pass_on(const base::Diagnostics& heard, base::Diagnostics& diagnostics) {
  for (const base::Diagnostic& d : heard.all()) {
    auto& report = d.span ? diagnostics.report(*d.code, *d.span, d.message)
                          : diagnostics.report(*d.code, d.message);
    report.notes = d.notes;
  }
}

}  // namespace

bool preserves(Builtin compression, Preserved preserved) {
  switch (compression) {
    case Builtin::sbisim:
      return preserved <= Preserved::bisimilarity;
    case Builtin::dbisim:
    case Builtin::wbisim:
      return preserved <= Preserved::priority;
    case Builtin::tau_loop_factor:
    case Builtin::diamond:
    case Builtin::normal:
      return preserved == Preserved::failures_divergences;
    default:
      return false;
  }
}

void Compressor::set_limits(const base::Limits& limits) {
  budget_ = base::Budget(limits);
  states_in_vain_ = 0;
  std::erase_if(applied_, [](const auto& entry) { return entry.second.limit.has_value(); });
  // What was too large may have been so after others in vain; the next check begins anew.
  std::erase_if(
      known_, [](const auto& entry) { return !entry.second.is_in_work && !entry.second.process; });
}

const CompressedProcess* Compressor::compressed(ProcId term, Preserved preserved) {
  limit_.reset();
  if (!preserves(static_cast<Builtin>(processes_.word(term, 0)), preserved)) return nullptr;
  const auto [place, is_new] = known_.try_emplace(Key{term.value, preserved});
  Known& known = place->second;
  if (is_new) {
    ++nesting_;
    if (nesting_ <= max_nesting) known.process = compress(term, preserved);
    --nesting_;
    known.is_in_work = false;
    if (limit_) {
      known_.erase(place);
      return nullptr;
    }
  } else if (known.is_in_work) {
    // Compressed inside of itself: there is no end to it, and no graph, nor of what comes next.
    limit_ = {base::LimitKind::depth, nesting_};
    states_in_vain_ = max_states + 1;
  }
  return known.process ? &*known.process : nullptr;
}

std::optional<CompressedProcess> Compressor::compress(ProcId term, Preserved preserved) {
  const auto builtin = static_cast<Builtin>(processes_.word(term, 0));
  const auto give_up = [&](const std::optional<base::LimitReached>& reached) {
    const bool is_size = reached && (reached->kind == base::LimitKind::states ||
                                     reached->kind == base::LimitKind::depth);
    if (is_size) given_up_.insert(builtin);
    limit_ = is_size ? std::nullopt : reached;
    return std::nullopt;
  };
  base::Limits limits = budget_.rest();
  const std::uint64_t most = std::min(limits.max_states.value_or(max_states), max_states);
  if (states_in_vain_ > most) return give_up(base::LimitReached{base::LimitKind::states, most});
  limits.max_states = most;
  const PreservedInScript scope(script_, preserved);
  base::Diagnostics unheard;  // the step rules say it again if it matters
  const auto found =
      explore_process(script_, processes_.operand(term, 1), {.limits = limits}, unheard);
  if (!found.complete) {
    states_in_vain_ += found.lts.state_count();
    return give_up(found.limit);
  }
  Compression small = compress_graph(found.lts, builtin, limits);
  if (const auto* reached = std::get_if<base::LimitReached>(&small)) return give_up(*reached);
  limit_.reset();
  CompressedProcess result = with_terms(std::get<lts::Lts>(std::move(small)), term, preserved);
  result.is_generalised =
      found.structure.is_generalised || builtin == Builtin::normal || builtin == Builtin::diamond;
  return result;
}

bool Compressor::is_being_applied(ProcId term) const {
  const auto known = applied_.find(term.value);
  return known != applied_.end() && known->second.is_in_work;
}

const CompressedProcess* Compressor::applied(ProcId term, base::Diagnostics& diagnostics) {
  limit_.reset();
  const auto [place, is_new] = applied_.try_emplace(term.value);
  Applied& known = place->second;
  if (!is_new) {
    limit_ = known.limit;
    return known.process ? &*known.process : nullptr;
  }
  if (nesting_ == max_nesting) {
    limit_ = {base::LimitKind::depth, max_nesting};
  } else {
    ++nesting_;
    known.process = apply(term, diagnostics);
    --nesting_;
  }
  known.is_in_work = false;
  known.limit = limit_;
  if (known.process) return &*known.process;
  if (!limit_) applied_.erase(place);  // whoever asks again gets the errors, too
  return nullptr;
}

std::optional<CompressedProcess> Compressor::apply(ProcId term, base::Diagnostics& diagnostics) {
  constexpr auto preserved = Preserved::failures_divergences;
  const auto builtin = static_cast<Builtin>(processes_.word(term, 0));
  const PreservedInScript scope(script_, preserved);
  base::Diagnostics heard;
  const auto found =
      explore_process(script_, processes_.operand(term, 1), {.limits = budget_.rest()}, heard);
  limit_ = found.limit;
  if (!found.complete) {
    if (!limit_) pass_on(heard, diagnostics);
    return std::nullopt;
  }
  WatchdogAlphabet alphabet;
  if (processes_.words(term).size() > 2) {
    alphabet = {events_.events(EventSetId{processes_.word(term, 2)}),
                EventId{processes_.word(term, 3)}};
  }
  Compression graph = apply_to_graph(found.lts, builtin, alphabet, budget_.rest());
  if (const auto* reached = std::get_if<base::LimitReached>(&graph)) {
    limit_ = *reached;
    return std::nullopt;
  }
  return with_terms(std::get<lts::Lts>(std::move(graph)), term, preserved);
}

// A state without transitions is STOP, whatever leads to it; so is what ✓ leads to (4.1.2).
CompressedProcess Compressor::with_terms(lts::Lts lts, ProcId term, Preserved preserved) {
  CompressedProcess result{std::move(lts), {}};
  const auto count = static_cast<std::uint32_t>(result.lts.state_count());
  result.states.reserve(count);
  for (std::uint32_t s = 0; s < count; ++s) {
    if (lts::State{s} == result.lts.initial()) {
      result.states.push_back(term);
    } else if (result.lts.edges(lts::State{s}).empty()) {
      result.states.push_back(processes_.stop());
    } else {
      const std::uint32_t words[] = {term.value, static_cast<std::uint32_t>(preserved), s};
      result.states.push_back(processes_.make(ProcKind::compressed_state, words));
    }
  }
  return result;
}

}  // namespace perentie::semantics

#include "perentie/semantics/process.hpp"

#include <algorithm>

namespace perentie::semantics {

std::optional<OperandPlaces> process_operands(ProcKind kind) {
  constexpr std::size_t only = std::size_t{1} << 32U;  // no second operand
  switch (kind) {
    case ProcKind::stop:
    case ProcKind::skip:
    case ProcKind::div:
    case ProcKind::chaos:
    case ProcKind::run:
    case ProcKind::compressed_state:
    case ProcKind::opaque:
    case ProcKind::call:
      return std::nullopt;
    case ProcKind::external_choice:
    case ProcKind::internal_choice:
    case ProcKind::sequential:
    case ProcKind::interrupt:
    case ProcKind::sliding_choice:
    case ProcKind::interleave:
      return OperandPlaces{0, 1};
    case ProcKind::parallel:
    case ProcKind::link_parallel:
    case ProcKind::exception:
    case ProcKind::sync_choice:
    case ProcKind::sync_interrupt:
      return OperandPlaces{1, 1};
    case ProcKind::alphabet_parallel:
      return OperandPlaces{1, 2};
    case ProcKind::prefix:
    case ProcKind::event_set_prefix:
    case ProcKind::hide:
    case ProcKind::project:
    case ProcKind::rename:
    case ProcKind::compression:
    case ProcKind::graph_operator:
      return OperandPlaces{1, only};
    case ProcKind::chase:
    case ProcKind::prioritise:
      return OperandPlaces{0, only};
    case ProcKind::prioritise_partial:
      return OperandPlaces{2, only};
  }
  return std::nullopt;
}

RunningOperands running_operands(ProcKind kind, std::size_t word_count) {
  switch (kind) {
    case ProcKind::interleave:
    case ProcKind::external_choice:
    case ProcKind::interrupt:
      return {0, 1, word_count};
    case ProcKind::parallel:
    case ProcKind::link_parallel:
    case ProcKind::sync_choice:
    case ProcKind::sync_interrupt:
      return {1, 1, word_count - 1};
    case ProcKind::alphabet_parallel:
      return {1, 2, word_count / 2};
    case ProcKind::sequential:
    case ProcKind::sliding_choice:
    case ProcKind::prioritise:
      return {0, 1, 1};
    case ProcKind::exception:
    case ProcKind::hide:
    case ProcKind::project:
    case ProcKind::rename:
    case ProcKind::compression:
      return {1, 1, 1};
    case ProcKind::prioritise_partial:
      return {2, 1, 1};
    default:
      return {};
  }
}

bool stays_in_place(ProcKind kind) {
  switch (kind) {
    case ProcKind::hide:
    case ProcKind::project:
    case ProcKind::rename:
    case ProcKind::compression:
    case ProcKind::graph_operator:
    case ProcKind::chase:
    case ProcKind::prioritise_partial:
      return true;
    default:
      return is_parallel(kind);
  }
}

ProcStore::ProcStore() {
  stop_ = intern(ProcKind::stop, {});
  skip_ = intern(ProcKind::skip, {});
  div_ = intern(ProcKind::div, {});
}

ProcId ProcStore::prefix(EventId event, ProcId body) {
  return intern(ProcKind::prefix, {event.value, body.value});
}

ProcId ProcStore::event_set_prefix(EventSetId events, ProcId body) {
  return intern(ProcKind::event_set_prefix, {events.value, body.value});
}

ProcId ProcStore::n_ary(ProcKind kind, std::span<const ProcId> operands) {
  return intern(kind, as_words(operands));
}

ProcId ProcStore::external_choice(std::span<const ProcId> operands) {
  if (operands.empty()) return stop_;
  return operands.size() == 1 ? operands[0] : n_ary(ProcKind::external_choice, operands);
}

ProcId ProcStore::internal_choice(std::span<const ProcId> operands) {
  PERENTIE_CHECK(!operands.empty(), "an internal choice needs an operand");
  return n_ary(ProcKind::internal_choice, operands);
}

ProcId ProcStore::interleave(std::span<const ProcId> operands) {
  if (operands.empty()) return skip_;
  return operands.size() == 1 ? operands[0] : n_ary(ProcKind::interleave, operands);
}

ProcId ProcStore::parallel(EventSetId alphabet, std::span<const ProcId> operands) {
  if (operands.empty()) return skip_;
  if (operands.size() == 1) return operands[0];
  std::vector<std::uint32_t> words{alphabet.value};
  const auto rest = as_words(operands);
  words.insert(words.end(), rest.begin(), rest.end());
  return intern(ProcKind::parallel, words);
}

ProcId ProcStore::sync_choice(EventSetId alphabet, std::span<const ProcId> operands) {
  if (operands.empty()) return stop_;
  if (operands.size() == 1) return operands[0];
  std::vector<std::uint32_t> words{alphabet.value};
  const auto rest = as_words(operands);
  words.insert(words.end(), rest.begin(), rest.end());
  return intern(ProcKind::sync_choice, words);
}

ProcId ProcStore::alphabet_parallel(std::span<const std::uint32_t> words) {
  return words.empty() ? skip_ : intern(ProcKind::alphabet_parallel, words);
}

ProcId ProcStore::binary(ProcKind kind, ProcId left, ProcId right) {
  return intern(kind, {left.value, right.value});
}

ProcId ProcStore::binary(ProcKind kind, std::uint32_t word, ProcId left, ProcId right) {
  return intern(kind, {word, left.value, right.value});
}

ProcId ProcStore::unary(ProcKind kind, std::uint32_t word, ProcId operand) {
  return intern(kind, {word, operand.value});
}

ProcId ProcStore::watchdog(Builtin builtin, ProcId specification, EventSetId events, EventId bark) {
  return intern(ProcKind::graph_operator, {static_cast<std::uint32_t>(builtin), specification.value,
                                           events.value, bark.value});
}

ProcId ProcStore::chaos(EventSetId events) { return intern(ProcKind::chaos, {events.value}); }

ProcId ProcStore::run(EventSetId events) { return intern(ProcKind::run, {events.value}); }

ProcId ProcStore::opaque(Builtin builtin, std::span<const ValueId> arguments) {
  std::vector<std::uint32_t> words{static_cast<std::uint32_t>(builtin)};
  for (const ValueId argument : arguments) words.push_back(argument.bits);
  return intern(ProcKind::opaque, words);
}

ProcId ProcStore::call(ValueId function, std::span<const ValueId> arguments) {
  std::vector<std::uint32_t> words{function.bits};
  for (const ValueId argument : arguments) words.push_back(argument.bits);
  return intern(ProcKind::call, words);
}

ProcId ProcStore::prioritise(ProcId operand, std::span<const EventSetId> order) {
  std::vector<std::uint32_t> words{operand.value};
  for (const EventSetId set : order) words.push_back(set.value);
  return intern(ProcKind::prioritise, words);
}

ProcId ProcStore::prioritise_partial(EventSetId below_tau, EventRelationId blocked_by,
                                     ProcId operand) {
  return intern(ProcKind::prioritise_partial, {below_tau.value, blocked_by.value, operand.value});
}

std::vector<ProcId> ProcStore::operands(ProcId process) const {
  std::vector<ProcId> found;
  const auto places = process_operands(kind(process));
  if (!places) return found;
  const auto all = words(process);
  for (std::size_t i = places->first; i < all.size(); i += places->stride) {
    found.push_back(ProcId{all[i]});
  }
  return found;
}

}  // namespace perentie::semantics

// Process terms, hash-consed: what the evaluator makes of process expressions and what the
// operational semantics steps through.
//
// A term is evaluated down to named calls: `call` stands for a definition with its arguments, whose
// body is evaluated when the term is stepped. That is the identity of states that FDR has (CSPM
// reference 3.8): equal terms are equal ids, and recursion through names stays finite.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "perentie/base/term_table.hpp"
#include "perentie/semantics/builtins.hpp"
#include "perentie/semantics/event.hpp"
#include "perentie/semantics/value.hpp"

namespace perentie::semantics {

enum class ProcKind : std::uint8_t {
#define PERENTIE_PROCESS(id, words) id,
#include "perentie/semantics/process_kinds.def"
#undef PERENTIE_PROCESS
};

/// Where the process operands lie among the words of a term: from `first`, every `stride`-th.
struct OperandPlaces {
  std::size_t first;
  std::size_t stride;
};
/// Of kinds without process operands, and of calls, nothing.
std::optional<OperandPlaces> process_operands(ProcKind kind);

/// Where the operands lie that run from the start (CSPM reference 4.1.5), among the words of a
/// term.
struct RunningOperands {
  std::size_t first = 0;
  std::size_t stride = 1;
  std::size_t count = 0;
};
RunningOperands running_operands(ProcKind kind, std::size_t word_count);

/// Whether an operator is there for ever, whatever its operands do. Names in its operands are then
/// no states of their own (6.2.2).
bool stays_in_place(ProcKind kind);

/// Interleaving and the parallel operators: ✓ needs all operands (4.1.3).
constexpr bool is_parallel(ProcKind kind) {
  return kind == ProcKind::interleave || kind == ProcKind::parallel ||
         kind == ProcKind::alphabet_parallel || kind == ProcKind::link_parallel;
}

/// The operators of priority (4.5).
constexpr bool is_priority(ProcKind kind) {
  return kind == ProcKind::prioritise || kind == ProcKind::prioritise_partial;
}

/// Terms as the words that hold them.
inline std::span<const std::uint32_t> as_words(std::span<const ProcId> terms) {
  static_assert(sizeof(ProcId) == sizeof(std::uint32_t));
  return {reinterpret_cast<const std::uint32_t*>(terms.data()), terms.size()};
}

class ProcStore {
 public:
  ProcStore();

  ProcId stop() const { return stop_; }
  ProcId skip() const { return skip_; }
  ProcId div() const { return div_; }
  ProcId prefix(EventId event, ProcId body);
  ProcId event_set_prefix(EventSetId events, ProcId body);
  /// n-ary operators over the operands as given; no operand: STOP for [] and [+A+], SKIP for |||,
  /// [|A|] and || (4.4.7); one operand: the operand itself except for |~| and || (4.4.5).
  ProcId external_choice(std::span<const ProcId> operands);
  ProcId internal_choice(std::span<const ProcId> operands);
  ProcId interleave(std::span<const ProcId> operands);
  ProcId parallel(EventSetId alphabet, std::span<const ProcId> operands);
  ProcId sync_choice(EventSetId alphabet, std::span<const ProcId> operands);
  /// Alphabets and processes in turn, as {A1, P1, A2, P2, ..}.
  ProcId alphabet_parallel(std::span<const std::uint32_t> words);
  ProcId binary(ProcKind kind, ProcId left, ProcId right);
  ProcId binary(ProcKind kind, std::uint32_t word, ProcId left, ProcId right);
  /// hide, project, rename, compression, graph_operator: one word and one process.
  ProcId unary(ProcKind kind, std::uint32_t word, ProcId operand);
  ProcId watchdog(Builtin builtin, ProcId specification, EventSetId events, EventId bark);
  ProcId chaos(EventSetId events);
  ProcId run(EventSetId events);
  ProcId chase(ProcId operand) { return intern(ProcKind::chase, {operand.value}); }
  /// What a built-in makes of values, without its meaning.
  ProcId opaque(Builtin builtin, std::span<const ValueId> arguments);
  ProcId call(ValueId function, std::span<const ValueId> arguments);
  /// The term of the same kind with other words; `words` must not lie in this store.
  ProcId rebuild(ProcId process, std::span<const std::uint32_t> words) {
    return make(kind(process), words);
  }
  /// The term of these words as they are; `words` must not lie in this store.
  ProcId make(ProcKind kind, std::span<const std::uint32_t> words) { return intern(kind, words); }
  /// Events of an earlier set, τ and ✓ block those of later sets (4.5.1).
  ProcId prioritise(ProcId operand, std::span<const EventSetId> order);
  /// τ and ✓ block `below_tau`; an event is blocked by those it is related to (4.5.6). The relation
  /// is transitively closed.
  ProcId prioritise_partial(EventSetId below_tau, EventRelationId blocked_by, ProcId operand);

  ProcKind kind(ProcId process) const { return static_cast<ProcKind>(terms_.tag(process.value)); }
  /// The words of a term in the layout of process_kinds.def. Not valid after the next constructor.
  std::span<const std::uint32_t> words(ProcId process) const { return terms_.words(process.value); }
  std::uint32_t word(ProcId process, std::size_t index) const { return words(process)[index]; }
  ProcId operand(ProcId process, std::size_t index) const { return ProcId{word(process, index)}; }
  /// All process operands in order; none: the kind has none.
  std::vector<ProcId> operands(ProcId process) const;

  std::size_t size() const { return terms_.size(); }
  std::size_t memory_bytes() const { return terms_.memory_bytes(); }

 private:
  ProcId intern(ProcKind kind, std::span<const std::uint32_t> words) {
    return ProcId{terms_.intern(static_cast<std::uint8_t>(kind), words)};
  }
  ProcId intern(ProcKind kind, std::initializer_list<std::uint32_t> words) {
    return intern(kind, std::span<const std::uint32_t>(words.begin(), words.size()));
  }
  ProcId n_ary(ProcKind kind, std::span<const ProcId> operands);

  base::TermTable terms_;
  ProcId stop_, skip_, div_;
};

}  // namespace perentie::semantics

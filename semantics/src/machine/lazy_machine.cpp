#include "perentie/semantics/lazy_machine.hpp"

#include "machine/compile.hpp"
#include "machine/formats.hpp"
#include "machine/moves.hpp"
#include "perentie/base/check.hpp"
#include "perentie/base/term_table.hpp"

namespace perentie::semantics {
namespace {

// States with this bit are composite: the rest is their number. Others are terms.
constexpr std::uint32_t composite_bit = std::uint32_t{1} << 31U;

}  // namespace

struct LazyMachine::Impl {
  Impl(const MachineParts& machine_parts, base::Diagnostics& diagnostics)
      : parts(machine_parts),
        rules(parts.calls, parts.events, parts.processes, parts.compressions, diagnostics),
        formats(parts.events, parts.processes, rules),
        moves(parts.events, parts.processes, formats, rules) {}

  // The state of a term that is settled.
  State state_of(ProcId term) {
    PERENTIE_CHECK(term.value < composite_bit, "there are too many process terms");
    if (!formats.is_composite(term, false)) return term.value;
    leaves.assign(1, ProcId{});
    const FormatId format = formats.split(term, leaves);
    leaves[0] = ProcId{format.value};
    return intern();
  }

  // The state of `leaves`, whose first word is the format.
  State intern() {
    const std::uint32_t number = states.intern(0, as_words(leaves));
    PERENTIE_CHECK(number < composite_bit, "there are too many composite states");
    return number | composite_bit;
  }

  // The format and the leaves of a composite state.
  const Format& format_of(State state) const {
    return formats[FormatId{states.words(state & ~composite_bit)[0]}];
  }
  std::span<const ProcId> leaves_of(State state) const {
    const auto words = states.words(state & ~composite_bit).subspan(1);
    return {reinterpret_cast<const ProcId*>(words.data()), words.size()};
  }

  bool successors_of_leaf(ProcId term, std::vector<lts::Transition<State>>& out) {
    steps.clear();
    if (!rules.successors(term, steps)) return false;
    for (const StepRules::Step& step : steps) out.push_back({step.label, state_of(step.target)});
    return true;
  }

  bool successors_of_composite(State state, std::vector<lts::Transition<State>>& out) {
    const auto stored = states.words(state & ~composite_bit);
    std::vector<ProcId>& before = current;
    before.clear();
    for (const std::uint32_t word : stored) before.push_back(ProcId{word});
    const FormatId format{before[0].value};
    if (!moves.compute(format, std::span<const ProcId>(before).subspan(1))) return false;
    for (const Move& move : moves.moves()) {
      if (move.term) {
        const auto target = rules.state(move.term);
        if (!target) return false;
        out.push_back({move.label, state_of(*target)});
      } else {
        leaves = before;
        for (const LeafChange& change : moves.changes(move)) leaves[change.leaf + 1] = change.term;
        out.push_back({move.label, intern()});
      }
    }
    return true;
  }

  MachineParts parts;
  StepRules rules;
  FormatTable formats;
  MoveRules moves;
  base::TermTable states;       // the composite ones: a format and leaves
  std::vector<ProcId> leaves;   // scratch: a composite state in the making
  std::vector<ProcId> current;  // scratch: the state in work
  StepRules::Steps steps;       // scratch
  bool has_initial = true;      // false: it was reported why not
};

LazyMachine::LazyMachine(ProcId process, const MachineParts& parts, base::Diagnostics& diagnostics)
    : impl_(std::make_unique<Impl>(parts, diagnostics)) {
  const std::optional<ProcId> term = impl_->rules.state(process);
  impl_->has_initial = term.has_value();
  initial_ = impl_->state_of(term.value_or(process));
}
LazyMachine::LazyMachine(LazyMachine&&) noexcept = default;
LazyMachine::~LazyMachine() = default;

bool LazyMachine::successors(State state, std::vector<lts::Transition<State>>& out) {
  if (!impl_->has_initial) return false;
  return (state & composite_bit) == 0 ? impl_->successors_of_leaf(ProcId{state}, out)
                                      : impl_->successors_of_composite(state, out);
}

ProcId LazyMachine::term(State state) const {
  if ((state & composite_bit) == 0) return ProcId{state};
  return impl_->formats.join(impl_->format_of(state), 0, impl_->leaves_of(state));
}

std::shared_ptr<const lts::LabelNames> LazyMachine::label_names() const {
  return impl_->parts.label_names();
}

std::size_t LazyMachine::memory_bytes() const {
  return impl_->parts.memory_bytes() + impl_->states.memory_bytes() + impl_->moves.memory_bytes();
}

std::optional<base::LimitReached> LazyMachine::limit() const { return impl_->rules.limit(); }

MachineStructure LazyMachine::structure() const {
  return {.formats = impl_->formats.size(), .leaf_states = impl_->moves.leaf_states()};
}

}  // namespace perentie::semantics
